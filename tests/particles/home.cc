#include "../setup.h"

#include <cstring>

using namespace Test;
using namespace dealii;

namespace
{
  /** A model on any grid, before its first step. */
  template <int dim>
  struct OnGrid : Text, Model<dim>
  {
    explicit OnGrid(const std::string &text) : Text(text), Model<dim>(this->parameters, MPI_COMM_WORLD)
    {
      this->parameters.parse();
      this->create();
    }
  };

  /** A block of density 3 from .1 to .9 of the unit square or cube, n cells along each axis. */
  template <int dim>
  std::string block(const unsigned int n, const std::string &type)
  {
    return section("Grid", set("Type", type) + set("Cells", coordinates<dim>({{1. * n, 1. * n, 1. * n}})) +
                             set("Upper corner", coordinates<dim>({{1, 1, 1}}))) +
           section("Kernel", type == "mesh" ? set("Type", "P1") : "") +
           body_text(set("Lower corner", coordinates<dim>({{0.1, 0.1, 0.1}})) +
                     set("Upper corner", coordinates<dim>({{0.9, 0.9, 0.9}})));
  }

  /** Everything that the working set of this rank holds, in its order. */
  template <int dim>
  std::vector<double> state(const WorkingSet<dim> &set)
  {
    std::vector<double> all(set.id.begin(), set.id.end());
    all.insert(all.end(), set.body.begin(), set.body.end());
    all.insert(all.end(), set.place.begin(), set.place.end());
    all.insert(all.end(), set.material_begin.begin(), set.material_begin.end());
    for (unsigned int c = 0; c < set.n_columns(); ++c)
      all.insert(all.end(), set.column(c), set.column(c) + set.size());
    return all;
  }

  bool are_same(const std::vector<double> &a, const std::vector<double> &b)
  {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
  }

  template <int dim>
  void round_trip(const std::string &type, const unsigned int n, const double n_least)
  {
    OnGrid<dim> run(block<dim>(n, type));
    auto       &set = run.particles;
    check_true(type + ": that many particles", set.n_global >= n_least);
    for (unsigned int f = 0; f < set.fields.size(); ++f)
      if (f != set.position && f != set.mass)
        for (unsigned int c = 0; c < set.fields[f].n_components; ++c)
          for (unsigned int p = 0; p < set.size(); ++p)
            set.component(f, c)[p] = hashed_jitter(f, set.id[p], c);
    // v = x_1 (1, 2, 3), and all go on by .3 of a cell: some into other ranks' cells.
    for (unsigned int p = 0; p < set.size(); ++p)
    {
      set.component(set.position, 0)[p] += 0.3 / n;
      for (unsigned int d = 0; d < dim; ++d)
        set.component(set.velocity, d)[p] = (d + 1) * set.component(set.position, 0)[p];
    }
    set.relocate();
    set.synchronise();
    const auto before = state(set);

    const auto &handler = set.home();
    check_true(type + ": one of both is empty", set.size() == 0 && handler.n_global_particles() == set.n_global);
    const unsigned int m_column = set.fields[set.mass].first, v_column = set.fields[set.velocity].first;
    double             mass = 0, n_walked = 0;
    Tensor<1, dim>     momentum;
    bool               are_inside = true;
    for (const auto &cell : run.grid.triangulation.active_cell_iterators())
      if (cell->is_locally_owned())
        for (const auto &particle : handler.particles_in_cell(cell))
        {
          const auto properties = particle.get_properties();
          mass += properties[m_column];
          for (unsigned int d = 0; d < dim; ++d)
            momentum[d] += properties[m_column] * properties[v_column + d];
          are_inside = are_inside && cell->bounding_box().point_inside(particle.get_location(), 1e-9);
          ++n_walked;
        }
    check(type + ": particles in cells less all", sum(n_walked) - set.n_global, 0.5);
    check_true(type + ": in the cells that hold them", are_inside);
    const double M = 3 * std::pow(0.8, dim);
    check(type + ": mass", sum(mass) / M - 1, 1e-11);
    for (unsigned int d = 0; d < dim; ++d)
      check(type + ": momentum", sum(momentum[d]) / (M * (d + 1) * (0.5 + 0.3 / n)) - 1, 1e-11);

    set.take_back();
    check_true(type + ": bit for bit", are_same(before, state(set)));
    check_true(type + ": nothing left there", handler.n_locally_owned_particles() == 0);
  }

  /** What is changed there comes back. */
  template <int dim>
  void changes(const std::string &type)
  {
    OnGrid<dim>        run(block<dim>(10, type));
    auto              &set = run.particles;
    const unsigned int v = set.fields[set.velocity].first, x = set.fields[set.position].first;
    const auto         n       = set.n_global;
    auto              &handler = set.home();
    for (auto particle = handler.begin(); particle != handler.end(); ++particle)
      particle->get_properties()[v] = 7. + particle->get_id();
    double n_taken = 0;
    if (handler.n_locally_owned_particles() > 0)
    {
      handler.remove_particle(handler.begin());
      n_taken = 1;
    }
    set.take_back();
    bool holds = true;
    for (unsigned int p = 0; p < set.size(); ++p)
      holds = holds && set.component(set.velocity, 0)[p] == 7. + set.id[p];
    check_true(type + ": velocities as they were set", holds);
    check(type + ": a particle less for each rank", n - sum(n_taken) - sum(set.size()), 0.5);
    check_true(type + ": counted", set.n_global == n - sum(n_taken));

    if (type == "mesh")
      return;
    auto &again = set.home();
    again.begin()->get_properties()[x] += 0.3; // on every rank: all must stop
    check_error<RunError>("moved", {"was moved while", "Particle "}, [&] { set.take_back(); });
  }
} // namespace

/** All particles into deal.II's ParticleHandler, through its cells as deal.II's own programs walk, and back. */
template <int dim>
void home()
{
  round_trip<dim>("box", dim == 2 ? 200 : 30, 1e5);
  round_trip<dim>("mesh", dim == 2 ? 40 : 10, 4e3);
  changes<dim>("box");
  changes<dim>("mesh");
}

template void home<2>();
template void home<3>();

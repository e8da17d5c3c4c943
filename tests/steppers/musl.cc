#include "../run.h"

#include <map>

using namespace Test;
using namespace dealii;

namespace
{
  template <int dim>
  std::string grid_text()
  {
    return section("Grid", set("Cells", coordinates<dim>({{8, 8, 8}})));
  }

  template <int dim>
  std::string run_text(const std::string &kernel, const std::string &transfer, const std::string &more,
                       const std::array<double, 3> &lower, const std::array<double, 3> &upper,
                       const std::string &treatment = "")
  {
    return grid_text<dim>() +
           section("Kernel", set("Type", kernel) + (treatment.empty() ? "" : set("Boundary treatment", treatment))) +
           section("Transfer", set("Type", transfer)) + section("Run", more) +
           body_text(set("Lower corner", coordinates<dim>(lower)) + set("Upper corner", coordinates<dim>(upper)) +
                     set("Jitter", "0.3"));
  }

  /**
   * Sums of all ranks at nodes, which their places in the grid tell apart: mass, momentum. Nodes beyond no-slip walls
   * are those before them with the other sign, on both ways.
   */
  template <int dim>
  class NodeSums
  {
  public:
    using Key = std::array<long, dim>;

    static Key key(const Point<dim> &x, const Stencil<dim> &stencil, const unsigned int k)
    {
      Key result;
      for (unsigned int d = 0; d < dim; ++d)
        result[d] = std::lround(8 * (x[d] + stencil.offset[d][k])); // the spacing is 1/8
      return result;
    }

    void add(const Key &key, const double mass, const Tensor<1, dim> &momentum)
    {
      const auto [inside, sign] = mirrored(key);
      sums[inside].first += mass;
      sums[inside].second += sign * momentum;
    }

    void collect()
    {
      const auto all = Utilities::MPI::all_gather(MPI_COMM_WORLD, sums);
      sums.clear();
      for (const auto &part : all)
        for (const auto &[key, value] : part)
          add(key, value.first, value.second);
    }

    Tensor<1, dim> velocity(const Key &key, const bool has_walls) const
    {
      for (const long k : key)
        if (has_walls && (k == 0 || k == 8))
          return {};
      const auto [inside, sign] = mirrored(key);
      const auto &[m, p]        = sums.at(inside);
      return m > 0 ? sign * p / m : Tensor<1, dim>();
    }

  private:
    static std::pair<Key, double> mirrored(Key key)
    {
      double sign = 1;
      for (long &k : key)
        if (k < 0 || k > 8)
        {
          k    = k < 0 ? -k : 16 - k;
          sign = -sign;
        }
      return {key, sign};
    }

    std::map<Key, std::pair<double, Tensor<1, dim>>> sums;
  };

  template <int dim>
  void set_random_velocities(Run<dim> &run)
  {
    auto &set = run.model.particles;
    for (unsigned int d = 0; d < dim; ++d)
      for (unsigned int p = 0; p < set.size(); ++p)
        set.component(set.velocity, d)[p] = hashed_jitter(3, set.id[p], d);
  }

  /** What a step with MUSL leaves as it is without. */
  template <int dim>
  void check_motion(const std::string &name, const Run<dim> &once, const Run<dim> &twice)
  {
    const auto &particles = twice.model.particles;
    double      same      = 0;
    for (const unsigned int field : {particles.position, particles.velocity})
      for (unsigned int c = 0; c < dim; ++c)
        for (unsigned int p = 0; p < particles.size(); ++p)
          raise(same, once.columns(field)[c][p] - twice.columns(field)[c][p]);
    check(name + ": positions and velocities", same, 1e-15);
    if (!once.model.boundary.conditions.empty())
    {
      const auto &a = *once.model.boundary.conditions[0], &b = *twice.model.boundary.conditions[0];
      check(name + ": reaction", (a.reaction - b.reaction).norm() + (a.nodal_force - b.nodal_force).norm(),
            1e-13 * a.reaction.norm());
      check(name + ": work", a.work - b.work, 1e-15);
    }
  }

  /** grad v against the sums over the stencils of the particles' places. */
  template <int dim>
  void check_gradient(const std::string &name, Run<dim> &run, const bool has_walls)
  {
    const auto   &particles = run.model.particles;
    NodeSums<dim> sums;
    const auto    for_entries = [&](const unsigned int p, const auto &visit) {
      const Point<dim> x_p(particles.vector(particles.position, p));
      Stencil<dim>     stencil;
      run.model.kernel->evaluate(particles, p, p + 1, &stencil);
      for (unsigned int k = 0; k < stencil.size; ++k)
        visit(sums.key(x_p, stencil, k), stencil, k);
    };
    for (unsigned int p = 0; p < particles.size(); ++p)
      for_entries(p, [&](const auto &key, const Stencil<dim> &stencil, const unsigned int k) {
        const double m = stencil.weight[k] * particles.component(particles.mass, 0)[p];
        sums.add(key, m, m * particles.vector(particles.velocity, p));
      });
    sums.collect();
    double error = 0, size = 0;
    for (unsigned int p = 0; p < particles.size(); ++p)
    {
      Tensor<2, dim> grad_v;
      for_entries(p, [&](const auto &key, const Stencil<dim> &stencil, const unsigned int k) {
        for (unsigned int e = 0; e < dim; ++e)
          for (unsigned int d = 0; d < dim; ++d)
            grad_v[d][e] += sums.velocity(key, has_walls)[d] * stencil.gradient[e][k];
      });
      raise(error, (grad_v - particles.matrix(particles.grad_v, p)).norm());
      raise(size, grad_v.norm());
    }
    check(name + ": grad v", error / size, 1e-12);
  }
} // namespace

/**
 * grad v after a step is that of v_i = sum m phi v^{n+1} / m_i with the stencils before it, summed here over lists; at
 * no-slip walls v_i = 0. Everything else is what a step without MUSL makes of the first state, which has no stress.
 */
template <int dim>
void musl_definition()
{
  using Choice = std::pair<std::string, std::string>;
  for (const auto &[kernel, treatment] :
       {Choice("quadratic B-spline", "WLS"), Choice("quadratic B-spline", "ghost nodes"), Choice("CPDI", "")})
    for (const bool has_walls : {false, true})
    {
      if (has_walls && kernel == "CPDI") // its domains must not reach beyond the grid
        continue;
      const double      end  = has_walls ? 1. : 0.75;
      const std::string text = run_text<dim>(kernel, "FLIP", "", {{0.25, 0.25, 0.25}}, {{end, 0.7, 0.6}}, treatment) +
                               walls_text<dim>(has_walls ? "no-slip" : "free");
      Run<dim> once(text), twice(text + section("Run", set("MUSL", "true")));
      set_random_velocities(once);
      set_random_velocities(twice);
      const auto  &particles = twice.model.particles;
      const auto   x = twice.columns(particles.position), F = twice.columns(particles.F);
      const double dt = 1e-3;
      once.step(dt);
      twice.step(dt);
      const std::string name = kernel + (treatment.empty() ? "" : ", " + treatment) + (has_walls ? ", walls" : "");
      check_motion(name, once, twice);
      twice.set_columns(particles.position, x);
      twice.set_columns(particles.F, F);
      check_gradient(name, twice, has_walls);
    }
}

/** A free body of random velocities keeps its momentum; with a cutoff it changes by what is counted as lost. */
template <int dim>
void musl_momentum()
{
  for (const std::string transfer : {"FLIP", "TPIC", "APIC"})
  {
    Run<dim> run(
      run_text<dim>("quadratic B-spline", transfer, set("MUSL", "true"), {{0.2, 0.25, 0.3}}, {{0.77, 0.7, 0.6}}));
    auto  &set  = run.model.particles;
    double size = 0;
    for (unsigned int p = 0; p < set.size(); ++p)
    {
      for (unsigned int d = 0; d < dim; ++d)
        set.component(set.velocity, d)[p] = 0.1 + 0.2 * hashed_jitter(4, set.id[p], d);
      size += set.component(set.mass, 0)[p] * set.vector(set.velocity, p).norm();
    }
    const auto before = run.momentum();
    for (unsigned int n = 0; n < 40; ++n)
      run.step(2e-3);
    check(transfer + ": momentum", (run.momentum() - before).norm() / sum(size), 1e-13);
  }

  Run<dim> run(run_text<dim>("quadratic B-spline", "PIC", set("MUSL", "true") + set("Mass cutoff", "0.05"),
                             {{0.2, 0.25, 0.3}}, {{0.77, 0.7, 0.6}}));
  auto    &set = run.model.particles;
  for (unsigned int d = 0; d < dim; ++d)
    std::fill_n(set.component(set.velocity, d), set.size(), 1. + d);
  double error = 0, lost = 0;
  for (unsigned int n = 0; n < 10; ++n)
  {
    const auto before = run.momentum();
    run.step(2e-3);
    error = std::max(error, (run.momentum() - before + run.model.grid.lost_momentum).norm());
    lost  = std::max(lost, run.model.grid.lost_momentum.norm());
  }
  check("cutoff: momentum less what is lost", error / run.momentum().norm(), 1e-13);
  check_range("cutoff: something is lost", lost / run.momentum().norm(), 1e-6, 1e-2);
}

/**
 * The energy of a bar after a period, that stretches by a tenth and crosses cells with its free end: with linear
 * functions the nodes there take a quarter of it, and with MUSL next to nothing.
 */
template <int dim>
void musl_energy()
{
  const std::array<double, 3>   cells{{28, 1, 1}};
  std::map<std::string, double> loss;
  for (const std::string is_musl : {"false", "true"})
  {
    Run<dim> run(
      section("Grid", set("Upper corner", coordinates<dim>(cells)) + set("Cells", coordinates<dim>(cells))) +
      section("Kernel", set("Type", "linear")) + section("Transfer", set("Type", "FLIP")) +
      section("Run", set("MUSL", is_musl)) +
      section("Materials", set("Names", "rubber") +
                             section("rubber", set("Type", "neo-Hookean") + set("Density", "1") +
                                                 set("Young's modulus", "100") + set("Poisson's ratio", "0"))) +
      section("Bodies", set("Names", "bar") + section("bar", set("Upper corner", coordinates<dim>({{25, 1, 1}})) +
                                                               set("Velocity", std::string("0.75 * sin(pi*x/50); 0") +
                                                                                 (dim == 3 ? "; 0" : "")))) +
      section("Conditions",
              set("Names", "walls") +
                section("walls", set("Type", "slip") + set("Boundary ids", dim == 2 ? "0, 2, 3" : "0, 2, 3, 4, 5"))));
    const double start = run.report.kinetic_energy;
    for (unsigned int n = 0; n < 2500; ++n)
      run.step(4e-3);
    auto               &particles = run.model.particles;
    std::vector<double> densities(particles.size());
    double              strain = 0;
    run.model.materials[0]->strain_energy_densities(material_range(particles, 0, 0.), densities.data());
    for (unsigned int p = 0; p < particles.size(); ++p)
      strain += densities[p] * particles.component(particles.volume, 0)[p];
    loss[is_musl] = 1 - (run.report.kinetic_energy + sum(strain)) / start;
  }
  check_range("once", loss["false"], 0.2, 0.3);
  check("twice", loss["true"], 0.02);
}

template void musl_energy<2>();
template void musl_energy<3>();
template void musl_definition<2>();
template void musl_definition<3>();
template void musl_momentum<2>();
template void musl_momentum<3>();

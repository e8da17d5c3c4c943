#include "../check.h"
#include "meshes.h"

#include <talus/core/exceptions.h>
#include <talus/grid/mesh_partition.h>
#include <talus/kernels/mesh/c1_umls.h>

#include <map>
#include <set>

using namespace Talus;

namespace
{
  using namespace Test;

  template <int dim>
  std::unique_ptr<MeshPartition<dim>> partition_of(const MPI_Comm communicator)
  {
    auto partition = std::make_unique<MeshPartition<dim>>(communicator);
    partition->create([] { return gmsh<dim>(); });
    return partition;
  }

  template <class Number>
  Number sum(const Number x)
  {
    return dealii::Utilities::MPI::sum(x, MPI_COMM_WORLD);
  }

  /** What a kernel gives at x, by the positions of nodes. */
  template <int dim>
  std::map<Coordinates<dim>, double> weights(const Mesh<dim> &mesh, const unsigned int cell, const Coordinates<dim> &x)
  {
    Stencil<dim>         list;
    const MeshPoint<dim> point{cell, x};
    c1_umls<CubicWeight>(mesh, 1, &point, {}, &list);
    std::map<Coordinates<dim>, double> weights;
    for (unsigned int k = 0; k < list.size; ++k)
      weights[mesh.position[list.place[k]]] = list.weight[k];
    return weights;
  }
} // namespace

/** The parts together are the whole; a rank's own cells have the rings, sizes and kernels that they have in the whole.
 */
template <int dim>
void parts()
{
  const auto            parts = partition_of<dim>(MPI_COMM_WORLD);
  const Mesh<dim>      &mesh  = parts->mesh;
  const Mesh<dim>       whole = mesh_of(gmsh<dim>());
  const CellFinder<dim> finder(whole);
  const unsigned int    n_ranks = dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
  const double          share   = static_cast<double>(whole.n_cells()) / n_ranks;
  check("cells of all ranks", sum<double>(parts->n_owned_cells) - whole.n_cells(), .5);
  check("each has its share", parts->n_owned_cells - share, 1.);
  check("nodes", static_cast<double>(parts->dof_handler.n_dofs()) - whole.n_nodes(), .5);
  check("longest edge", mesh.longest_edge - whole.longest_edge, 1e-14);
  check_true("groups",
             parts->groups.size() == gmsh<dim>().groups.size() && parts->groups[0].name == gmsh<dim>().groups[0].name);

  unsigned int n_wrong    = 0;
  double       size_error = 0, weight_error = 0;
  std::mt19937 random(1);
  for (unsigned int c = 0; c < parts->n_owned_cells; ++c)
  {
    const auto         x = point(mesh, c, barycentric<dim>(random));
    const unsigned int w = finder.find(x.data());
    n_wrong += mesh.rings.size(c) != whole.rings.size(w) || mesh.number[c] != c;
    std::map<Coordinates<dim>, double> sizes;
    for (const unsigned int v : whole.nodes[w])
      sizes[whole.position[v]] = whole.size[v];
    for (const unsigned int v : mesh.nodes[c])
      raise(size_error, mesh.size[v] - sizes.at(mesh.position[v]));
    if (c % 10 == 0)
    {
      auto here = weights(mesh, c, x);
      for (const auto &[position, weight] : weights(whole, w, x))
        raise(weight_error, here.at(position) - weight);
    }
  }
  check_true("rings", n_wrong == 0);
  check("sizes", size_error, 1e-14);
  check("weights", weight_error, 1e-12);
}

namespace
{
  template <int dim>
  struct Particle
  {
    unsigned int     id, cell;
    Coordinates<dim> x;

    template <class Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &id &cell &x;
    }
  };

  /** A random number in [0, 1) that hangs on these alone, not on the rank. */
  double uniform(const unsigned int id, const unsigned int round, const unsigned int axis)
  {
    unsigned long z = (static_cast<unsigned long>(id) * 4096 + round) * 4 + axis + 1;
    z *= 0x9e3779b97f4a7c15; // splitmix64
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return static_cast<double>((z ^ (z >> 31)) >> 11) / (1ul << 53);
  }

  /** Particles that each rank has in its cells; those that move into a cell of another are handed to it. */
  template <int dim>
  class Walkers
  {
  public:
    using List     = std::vector<Particle<dim>>;
    using Location = typename MeshPartition<dim>::Location;

    Walkers(const MeshPartition<dim> &parts, const MPI_Comm communicator, const unsigned int n) :
      parts(parts), communicator(communicator), rank(dealii::Utilities::MPI::this_mpi_process(communicator))
    {
      std::vector<Coordinates<dim>> starts(n);
      for (unsigned int id = 0; id < n; ++id)
        for (unsigned int d = 0; d < dim; ++d)
          starts[id][d] = uniform(id, 0, d);
      const auto first = parts.find(starts); // all ranks ask for all
      for (unsigned int id = 0; id < n; ++id)
        if (first[id].is_found && first[id].rank == rank)
          here.push_back({id, first[id].cell, starts[id]});
      n_all = n_of_all_ranks();
    }

    /** Far enough to leave all that a rank knows; a move out of the mesh is not made. */
    void move(const unsigned int round, const double longest_step)
    {
      std::vector<Coordinates<dim>> moved;
      for (const auto &particle : here)
      {
        moved.push_back(particle.x);
        for (unsigned int d = 0; d < dim; ++d)
          moved.back()[d] += longest_step * (2 * uniform(particle.id, round + 1, d) - 1);
      }
      const auto                   location = find(moved);
      List                         staying;
      std::map<unsigned int, List> leaving;
      for (unsigned int k = 0; k < here.size(); ++k)
        if (!location[k].is_found)
          staying.push_back(here[k]);
        else if (location[k].rank == rank)
          staying.push_back({here[k].id, location[k].cell, moved[k]});
        else
          leaving[location[k].rank].push_back({here[k].id, location[k].cell, moved[k]});
      for (const auto &[from, list] : dealii::Utilities::MPI::some_to_some(communicator, leaving))
      {
        n_handed += list.size();
        staying.insert(staying.end(), list.begin(), list.end());
      }
      here = staying;
      count_wrong();
    }

    /** Places by id. */
    std::map<unsigned int, Coordinates<dim>> places() const
    {
      std::map<unsigned int, Coordinates<dim>> result;
      for (const auto &particle : here)
        result[particle.id] = particle.x;
      return result;
    }

    unsigned int n_wrong = 0, n_handed = 0;

  private:
    /** From their cells, and through all ranks where that does not find them. */
    std::vector<Location> find(const std::vector<Coordinates<dim>> &moved) const
    {
      std::vector<Location>         location;
      std::vector<Coordinates<dim>> lost;
      std::vector<unsigned int>     of_lost;
      for (unsigned int k = 0; k < here.size(); ++k)
      {
        location.push_back(parts.find_from(here[k].cell, moved[k].data()));
        if (!location.back().is_found)
        {
          of_lost.push_back(k);
          lost.push_back(moved[k]);
        }
      }
      const auto found = parts.find(lost);
      for (unsigned int k = 0; k < found.size(); ++k)
        location[of_lost[k]] = found[k];
      return location;
    }

    void count_wrong()
    {
      for (const auto &particle : here)
      {
        const auto B = parts.mesh.barycentric(particle.cell, particle.x.data());
        n_wrong +=
          particle.cell >= parts.n_owned_cells || *std::min_element(B.begin(), B.end()) < -barycentric_tolerance;
      }
      n_wrong += n_of_all_ranks() != n_all;
    }

    unsigned int n_of_all_ranks() const
    {
      return dealii::Utilities::MPI::sum(static_cast<unsigned int>(here.size()), communicator);
    }

    const MeshPartition<dim> &parts;
    const MPI_Comm            communicator;
    const unsigned int        rank;
    unsigned int              n_all;
    List                      here;
  };

  /** On all ranks together, and on each of them alone. */
  template <int dim>
  void check_moves(const unsigned int n, const unsigned int n_rounds, const double longest_step)
  {
    const auto   parts = partition_of<dim>(MPI_COMM_WORLD), whole = partition_of<dim>(MPI_COMM_SELF);
    Walkers<dim> together(*parts, MPI_COMM_WORLD, n), alone(*whole, MPI_COMM_SELF, n);
    for (unsigned int round = 0; round < n_rounds; ++round)
    {
      together.move(round, longest_step);
      alone.move(round, longest_step);
    }
    const auto places = together.places(), expected = alone.places();
    check_true("each is in a cell of its rank, none is lost", together.n_wrong + alone.n_wrong == 0);
    check("number of particles", sum<double>(places.size()) - expected.size(), .5);
    check_true("some change ranks",
               (sum(together.n_handed) > 100) == (dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1) &&
                 alone.n_handed == 0);
    unsigned int n_elsewhere = 0;
    for (const auto &[id, x] : places)
      n_elsewhere += x != expected.at(id);
    check_true("places of one rank, bit for bit", n_elsewhere == 0);
  }
} // namespace

template <int dim>
void moving_between_parts()
{
  check_moves<dim>(2000, 20, .3);
}

void many_moves_between_parts() { check_moves<3>(100000, 1000, .1); }

/** What is wrong with a mesh is found by the root and said by all. */
void parts_errors()
{
  std::string message;
  try
  {
    MeshPartition<2>(MPI_COMM_WORLD).create([] { return read_msh<2>("nowhere.msh"); });
  }
  catch (const InputError &error)
  {
    message = error.message;
  }
  check_true(message, message.find("cannot read the mesh 'nowhere.msh'") != std::string::npos);
}

template void parts<2>();
template void parts<3>();
template void moving_between_parts<2>();
template void moving_between_parts<3>();

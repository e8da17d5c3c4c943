#include <talus/grid/mesh_partition.h>

#include <talus/core/exceptions.h>
#include <talus/grid/mesh_triangulation.h>

#include <deal.II/base/mpi.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria_description.h>

#include <algorithm>
#include <map>
#include <numeric>

namespace Talus
{
  using namespace dealii;

  template <int dim>
  std::vector<unsigned int> partition_by_halves(const MeshInput<dim> &input, const std::vector<double> &weights,
                                                const unsigned int n_parts)
  {
    std::vector<typename Mesh<dim>::Vector> centres(input.cells.size());
    for (unsigned int c = 0; c < centres.size(); ++c)
      for (unsigned int d = 0; d < dim; ++d)
      {
        centres[c][d] = 0;
        for (const unsigned int v : input.cells[c])
          centres[c][d] += input.positions[v][d] / (dim + 1);
      }
    std::vector<unsigned int> part(centres.size(), 0), order(centres.size());
    std::iota(order.begin(), order.end(), 0);
    using Iterator = std::vector<unsigned int>::iterator;
    const std::function<void(Iterator, Iterator, unsigned int, unsigned int)> share =
      [&](const Iterator begin, const Iterator end, const unsigned int first, const unsigned int n) {
        if (n == 1)
        {
          for (auto i = begin; i != end; ++i)
            part[*i] = first;
          return;
        }
        GrowingBox<dim> box;
        double          total = 0;
        for (auto i = begin; i != end; ++i)
        {
          box.add(centres[*i]);
          total += weights[*i];
        }
        unsigned int axis = 0;
        for (unsigned int d = 1; d < dim; ++d)
          if (box.upper[d] - box.lower[d] > box.upper[axis] - box.lower[axis])
            axis = d;
        std::sort(begin, end, [&](const unsigned int a, const unsigned int b) {
          return centres[a][axis] < centres[b][axis] || (centres[a][axis] == centres[b][axis] && a < b);
        });
        // As much of the weight as the lower half of the parts shall have.
        const unsigned int n_lower = n / 2;
        auto               middle  = begin;
        for (double sum = 0; middle != end && sum + .5 * weights[*middle] < total * n_lower / n; ++middle)
          sum += weights[*middle];
        share(begin, middle, first, n_lower);
        share(middle, end, first + n_lower, n - n_lower);
      };
    share(order.begin(), order.end(), 0, n_parts);
    return part;
  }

  namespace
  {
    /** What the root reads, on the others nothing; what is wrong with it all throw. */
    template <int dim>
    MeshInput<dim> read_at_root(const std::function<MeshInput<dim>()> &read, const MPI_Comm communicator)
    {
      MeshInput<dim> input;
      std::string    problem;
      if (Utilities::MPI::this_mpi_process(communicator) == 0)
        try
        {
          input = read();
        }
        catch (const InputError &error)
        {
          problem = error.message;
        }
      problem = Utilities::MPI::broadcast(communicator, problem);
      AssertThrow(problem.empty(), InputError(problem));
      return input;
    }

    template <class Group>
    std::vector<Group> groups_of_root(const std::vector<Group> &of_root, const MPI_Comm communicator)
    {
      std::vector<unsigned int> numbers;
      std::vector<std::string>  names;
      for (const auto &group : of_root)
      {
        numbers.push_back(group.number);
        names.push_back(group.name);
      }
      numbers = Utilities::MPI::broadcast(communicator, numbers);
      names   = Utilities::MPI::broadcast(communicator, names);
      std::vector<Group> groups;
      for (unsigned int g = 0; g < numbers.size(); ++g)
        groups.push_back({numbers[g], names[g]});
      return groups;
    }
  } // namespace

  template <int dim>
  MeshPartition<dim>::MeshPartition(MPI_Comm communicator) :
    triangulation(communicator), fe(1), dof_handler(triangulation), communicator(communicator)
  {
  }

  template <int dim>
  void MeshPartition<dim>::create(const std::function<MeshInput<dim>()> &read, const Weight &weight)
  {
    const unsigned int   n_ranks = Utilities::MPI::n_mpi_processes(communicator);
    const MeshInput<dim> input   = read_at_root(read, communicator);
    groups                       = groups_of_root(input.groups, communicator);
    const auto description =
      TriangulationDescription::Utilities::create_description_from_triangulation_in_groups<dim, dim>(
        [&](Triangulation<dim> &whole) { create_triangulation(input, whole); },
        [&](Triangulation<dim> &whole, const MPI_Comm &, const unsigned int) {
          std::vector<double> weights(input.cells.size(), 1.);
          if (weight && n_ranks > 1)
          {
            mesh.reinit(input.positions, input.cells);
            finder = std::make_unique<CellFinder<dim>>(mesh);
            for (const auto &cell : whole.active_cell_iterators())
              weights[cell->active_cell_index()] = weight(cell);
          }
          const auto part = partition_by_halves(input, weights, n_ranks);
          for (const auto &cell : whole.active_cell_iterators())
            cell->set_subdomain_id(part[cell->active_cell_index()]);
        },
        communicator, n_ranks);
    dof_handler.clear();
    triangulation.clear();
    triangulation.create_triangulation(description);
    dof_handler.reinit(triangulation);
    dof_handler.distribute_dofs(fe);
    fill_tables();
    find_owners();
    finder = std::make_unique<CellFinder<dim>>(mesh);

    GrowingBox<dim> box;
    for (unsigned int c = 0; c < n_owned_cells; ++c)
      for (const unsigned int v : mesh.nodes[c])
        box.add(mesh.position[v]);
    boxes = Utilities::MPI::all_gather(communicator, box);
  }

  template <int dim>
  void MeshPartition<dim>::fill_tables()
  {
    std::map<types::global_dof_index, unsigned int> local;
    std::vector<typename Mesh<dim>::Vector>         positions;
    std::vector<typename Mesh<dim>::Corners>        cells;
    std::vector<types::global_dof_index>            dofs(dim + 1);
    node_numbers.clear();
    for (const bool is_owned : {true, false})
    {
      for (const auto &cell : dof_handler.active_cell_iterators())
        if (is_owned ? cell->is_locally_owned() : cell->is_ghost())
        {
          cell->get_dof_indices(dofs);
          cells.emplace_back();
          for (unsigned int k = 0; k <= dim; ++k)
          {
            const auto [entry, is_new] = local.emplace(dofs[k], positions.size());
            cells.back()[k]            = entry->second;
            if (is_new)
            {
              positions.emplace_back();
              for (unsigned int d = 0; d < dim; ++d)
                positions.back()[d] = cell->vertex(k)[d];
              node_numbers.push_back(dofs[k]);
            }
          }
        }
      if (is_owned)
        n_owned_cells = cells.size();
    }
    mesh.reinit(positions, cells);
    mesh.longest_edge = Utilities::MPI::max(mesh.longest_edge, communicator);
  }

  /** Ghost cells learn their numbers from their owners. */
  template <int dim>
  void MeshPartition<dim>::find_owners()
  {
    std::map<CellId, unsigned int> local;
    unsigned int                   n_owned = 0, n_ghosts = n_owned_cells;
    for (const auto &cell : triangulation.active_cell_iterators())
      if (cell->is_locally_owned() || cell->is_ghost())
      {
        const unsigned int c = cell->is_locally_owned() ? n_owned++ : n_ghosts++;
        local[cell->id()]    = c;
        mesh.owner[c]        = cell->subdomain_id();
        mesh.number[c]       = c;
      }
    using Cell = typename Triangulation<dim>::active_cell_iterator;
    GridTools::exchange_cell_data_to_ghosts<unsigned int, Triangulation<dim>>(
      triangulation, [&](const Cell &cell) { return local.at(cell->id()); },
      [&](const Cell &cell, const unsigned int number) { mesh.number[local.at(cell->id())] = number; });
  }

  template <int dim>
  std::vector<typename MeshPartition<dim>::Location> MeshPartition<dim>::find(
    const std::vector<typename Mesh<dim>::Vector> &points) const
  {
    using Points                          = std::vector<typename Mesh<dim>::Vector>;
    const auto                     here   = Utilities::MPI::this_mpi_process(communicator);
    const double                   margin = 1e-6 * mesh.longest_edge; // more than the tolerance of a cell
    std::vector<Location>          locations;
    std::map<unsigned int, Points> questions;
    std::map<unsigned int, std::vector<unsigned int>> asked; // their places in `points`
    for (unsigned int i = 0; i < points.size(); ++i)
    {
      locations.push_back(locate(finder->find(points[i].data())));
      if (locations[i].is_found)
        continue;
      for (unsigned int rank = 0; rank < boxes.size(); ++rank)
      {
        bool may_hold = rank != here && !boxes[rank].is_empty;
        for (unsigned int d = 0; d < dim; ++d)
          may_hold =
            may_hold && points[i][d] >= boxes[rank].lower[d] - margin && points[i][d] <= boxes[rank].upper[d] + margin;
        if (may_hold)
        {
          questions[rank].push_back(points[i]);
          asked[rank].push_back(i);
        }
      }
    }
    std::map<unsigned int, std::vector<Location>> answers;
    for (const auto &[rank, list] : Utilities::MPI::some_to_some(communicator, questions))
      for (const auto &x : list)
        answers[rank].push_back(locate(finder->find(x.data())));
    // The lowest rank that knows the point is believed.
    for (const auto &[rank, list] : Utilities::MPI::some_to_some(communicator, answers))
      for (unsigned int k = 0; k < list.size(); ++k)
        if (auto &location = locations[asked.at(rank)[k]]; list[k].is_found && !location.is_found)
          location = list[k];
    return locations;
  }

#define TALUS_INSTANTIATE(dim)                                                                                         \
  template std::vector<unsigned int> partition_by_halves(const MeshInput<dim> &, const std::vector<double> &,          \
                                                         const unsigned int);                                          \
  template class MeshPartition<dim>;
  TALUS_INSTANTIATE(2)
  TALUS_INSTANTIATE(3)
} // namespace Talus

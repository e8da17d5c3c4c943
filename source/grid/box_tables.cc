#include <talus/grid/box_grid.h>

#include <deal.II/dofs/dof_tools.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    typename Lattice<dim>::Index to_index(const Lattice<dim> &lattice, const Point<dim> &x, const double shift)
    {
      typename Lattice<dim>::Index index;
      for (unsigned int d = 0; d < dim; ++d)
        index[d] = static_cast<int>(std::floor(lattice.coordinate(x[d], d) + shift));
      return index;
    }

    /** The cells that this rank has, from `first` to before `last`; of a rank without cells none. */
    template <int dim>
    void range_of_cells(const DoFHandler<dim> &dof_handler, const Lattice<dim> &lattice,
                        typename Lattice<dim>::Index &first, typename Lattice<dim>::Index &last)
    {
      first.fill(std::numeric_limits<int>::max());
      last.fill(std::numeric_limits<int>::min());
      for (const auto &cell : dof_handler.active_cell_iterators())
        if (!cell->is_artificial())
        {
          const auto index = to_index(lattice, cell->vertex(0), 0.5);
          for (unsigned int d = 0; d < dim; ++d)
          {
            first[d] = std::min(first[d], index[d]);
            last[d]  = std::max(last[d], index[d] + 1);
          }
        }
      if (first[0] > last[0])
        first.fill(0), last.fill(0);
    }

    /** Calls body(entry) for the n^dim table entries from `distance` before `entry` on, as far as the tables reach. */
    template <int dim, class Body>
    void for_entries_around(const Lattice<dim> &lattice, const int entry, const int distance, const int n,
                            const Body &body)
    {
      auto first = lattice.table_entry(entry);
      for (unsigned int d = 0; d < dim; ++d)
        first[d] -= distance;
      for_each_index(first, n, [&](const auto &index) {
        if (lattice.is_in_table(index))
          body(lattice.table_index(index));
      });
    }

    /** A cell of this rank and the ranks that have it as a ghost: these learn all that this one knows of what is near.
     */
    struct SharedCell
    {
      int                    entry;
      std::set<unsigned int> ranks;
    };

    template <int dim>
    std::vector<SharedCell> shared_cells(const Lattice<dim> &lattice, const unsigned int my_rank)
    {
      std::vector<SharedCell> shared;
      for (unsigned int entry = 0; entry < lattice.owner.size(); ++entry)
        if (lattice.owner[entry] == my_rank)
        {
          std::set<unsigned int> ranks;
          for_entries_around(lattice, entry, 1, 3, [&](const int at) {
            if (lattice.owner[at] != lattice.missing && lattice.owner[at] != my_rank)
              ranks.insert(lattice.owner[at]);
          });
          if (!ranks.empty())
            shared.push_back({static_cast<int>(entry), ranks});
        }
      return shared;
    }

    /**
     * Tells each rank what this one knows of the n^dim table entries from `distance` before each shared cell on, as
     * lattice index and number.
     */
    template <int dim, class Number>
    void share(const Lattice<dim> &lattice, const std::vector<SharedCell> &shared, const int distance, const int n,
               const MPI_Comm communicator, std::vector<Number> &table)
    {
      std::map<unsigned int, std::set<int>> entries;
      for (const SharedCell &cell : shared)
        for (const unsigned int rank : cell.ranks)
          for_entries_around(lattice, cell.entry, distance, n, [&](const int at) { entries[rank].insert(at); });
      std::map<unsigned int, std::vector<types::global_dof_index>> messages;
      for (const auto &[rank, of_rank] : entries)
        for (const int entry : of_rank)
          if (table[entry] + 1 != 0)
          {
            const auto index = lattice.table_entry(entry);
            messages[rank].insert(messages[rank].end(), index.begin(), index.end());
            messages[rank].push_back(table[entry]);
          }
      for (const auto &[rank, message] : Utilities::MPI::some_to_some(communicator, messages))
        for (unsigned int i = 0; i < message.size(); i += dim + 1)
        {
          typename Lattice<dim>::Index index;
          std::copy_n(message.begin() + i, dim, index.begin());
          if (lattice.is_in_table(index))
            table[lattice.table_index(index)] = message[i + dim];
        }
    }
  } // namespace

  template <int dim>
  void BoxGrid<dim>::number_nodes()
  {
    dof_handler.distribute_dofs(this->fe);
  }

  template <int dim>
  void BoxGrid<dim>::fill_tables(const unsigned int n_layers)
  {
    typename Lattice<dim>::Index first, last;
    range_of_cells(dof_handler, lattice, first, last);
    lattice.padding = std::max(3, static_cast<int>(n_layers) + 2);
    lattice.resize_tables(first, last);

    std::vector<types::global_dof_index> dofs(lattice.node.size(), numbers::invalid_dof_index); // of the nodes
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (!cell->is_artificial())
      {
        const auto index     = to_index(lattice, cell->vertex(0), 0.5);
        const int  entry     = lattice.table_index(index);
        lattice.owner[entry] = cell->is_locally_owned() ? my_rank : cell->subdomain_id();
        unsigned int v       = 0;
        for_each_index(index, 2,
                       [&](const auto &corner) { dofs[lattice.table_index(corner)] = cell->vertex_dof_index(v++, 0); });
      }
    IndexSet known;
    DoFTools::extract_locally_relevant_dofs(dof_handler, known);
    learn_layers(n_layers, dofs, known);

    // Local numbers: owned nodes in the order of their places, then the others by deal.II's number.
    const IndexSet owned  = dof_handler.locally_owned_dofs();
    IndexSet       others = known;
    others.subtract_set(owned);
    node_index.resize(known.n_elements());
    std::vector<unsigned int> places(known.n_elements()), number_of(owned.n_elements());
    unsigned int              n_numbered = 0;
    for (unsigned int entry = 0; entry < dofs.size(); ++entry)
      if (dofs[entry] != numbers::invalid_dof_index)
      {
        const bool         is_mine = owned.is_element(dofs[entry]);
        const unsigned int node    = is_mine ? n_numbered++ : owned.n_elements() + others.index_within_set(dofs[entry]);
        if (is_mine)
          number_of[owned.index_within_set(dofs[entry])] = node;
        lattice.node[entry] = node;
        node_index[node]    = lattice.table_entry(entry);
        places[node]        = entry;
      }
    Nodes by_set; // owned nodes numbered as in their set
    by_set.reinit(owned, known, communicator, places, lattice.node.size());
    for (auto &neighbour : by_set.copied_by)
      for (unsigned int &node : neighbour.nodes)
        node = number_of[node];
    nodes.reinit(owned.n_elements(), places, lattice.node.size(), by_set.copied_by, by_set.copied_from, communicator);
    fields.reinit(nodes);
    lattice.find_images();
    this->activate_all();
  }

  template <int dim>
  void BoxGrid<dim>::learn_layers(const unsigned int n_layers, std::vector<types::global_dof_index> &dofs,
                                  IndexSet &known)
  {
    if (Utilities::MPI::n_mpi_processes(communicator) == 1)
      return;
    const auto shared = shared_cells(lattice, my_rank);
    // Who knows what is `layer` cells away from each of its own cells tells its neighbours, who then know one layer
    // more.
    for (int layer = 1; layer < std::max(2, static_cast<int>(n_layers)); ++layer)
    {
      share(lattice, shared, layer, 2 * layer + 1, communicator, lattice.owner);
      if (layer < static_cast<int>(n_layers))
        share(lattice, shared, layer, 2 * layer + 2, communicator, dofs);
    }
    std::vector<types::global_dof_index> all;
    std::copy_if(dofs.begin(), dofs.end(), std::back_inserter(all),
                 [](const auto dof) { return dof != numbers::invalid_dof_index; });
    std::sort(all.begin(), all.end());
    known.add_indices(all.begin(), all.end());
    known.compress();
  }

#define INSTANTIATE(dim)                                                                                               \
  template void BoxGrid<dim>::number_nodes();                                                                          \
  template void BoxGrid<dim>::fill_tables(const unsigned int);                                                         \
  template void BoxGrid<dim>::learn_layers(const unsigned int, std::vector<types::global_dof_index> &, IndexSet &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Talus

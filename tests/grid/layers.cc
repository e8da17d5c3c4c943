#include "skewed_box.h"

using namespace Test;
using namespace dealii;

/** Each rank adds 1 to the nodes of each of its cells: the sum is the number of cells that share a node. */
template <int dim>
void exchange()
{
  auto  s       = setup<dim>();
  auto &grid    = s.grid;
  auto &lattice = grid.lattice;
  for (const bool is_repeated : {false, true}) // clear() must reset the copies as well
  {
    grid.clear();
    for (unsigned int entry = 0; entry < lattice.owner.size(); ++entry)
      if (s.grid.owns_cell(entry))
        for (unsigned int v = 0; v < 1u << dim; ++v)
        {
          unsigned int corner = entry;
          for (unsigned int d = 0; d < dim; ++d)
            corner += (v >> d) % 2 * lattice.stride[d];
          for (unsigned int lane = 0; lane < 8; ++lane)
            grid.fields[lattice.node[corner]][lane] += lane + 1;
        }
    grid.fields.add_copies_to_owners();
    grid.fields.update_copies();
    double error = 0;
    for (unsigned int i = 0; i < grid.fields.n_local(); ++i)
    {
      double n_sharing = 1;
      for (unsigned int d = 0; d < dim; ++d)
        n_sharing *= grid.node_index[i][d] == 0 || grid.node_index[i][d] == cells[d] ? 1 : 2;
      for (unsigned int lane = 0; lane < 8; ++lane)
        raise(error, grid.fields[i][lane] - (lane + 1) * n_sharing);
    }
    check(is_repeated ? "again" : "owners and copies", error, 1e-15);
  }
}

namespace
{
  /** Whether one of this rank's cells lies at most so many cells before and after an index, on every axis. */
  template <int dim>
  bool owns_cell_near(const BoxGrid<dim> &grid, const typename Lattice<dim>::Index &index, const int before,
                      const int after)
  {
    bool found = false;
    for (unsigned int entry = 0; entry < grid.lattice.owner.size(); ++entry)
      if (grid.owns_cell(entry))
      {
        const auto cell    = grid.lattice.table_entry(entry);
        bool       is_near = true;
        for (unsigned int d = 0; d < dim; ++d)
          is_near = is_near && cell[d] >= index[d] - before && cell[d] <= index[d] + after;
        found = found || is_near;
      }
    return found;
  }

  template <int dim>
  void check_known(const std::string &kernel, const BoxGrid<dim> &grid)
  {
    const auto &lattice     = grid.lattice;
    const int   n_layers    = kernel == "cubic B-spline" ? 2 : 1;
    const bool  is_alone    = Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) == 1;
    bool        nodes_agree = true, owners_agree = true;
    for (unsigned int entry = 0; entry < lattice.node.size(); ++entry)
    {
      const auto index   = lattice.table_entry(entry);
      bool       is_node = true, is_cell = true;
      for (unsigned int d = 0; d < dim; ++d)
      {
        is_node = is_node && index[d] >= 0 && index[d] <= lattice.n_cells[d];
        is_cell = is_cell && index[d] >= 0 && index[d] < lattice.n_cells[d];
      }
      const bool is_known  = is_node && owns_cell_near(grid, index, n_layers + 1, n_layers);
      nodes_agree          = nodes_agree && (lattice.node[entry] != lattice.missing) == is_known;
      const bool has_owner = is_cell && owns_cell_near(grid, index, 2, 2);
      owners_agree         = owners_agree && (lattice.owner[entry] != lattice.missing) == has_owner;
    }
    check_true(kernel + ": nodes", nodes_agree);
    check_true(kernel + ": owners of cells", owners_agree || is_alone);
  }

  /** Every rank writes its number into its cells of one global list. */
  template <int dim>
  void check_owners(const std::string &kernel, const BoxGrid<dim> &grid)
  {
    const auto               &lattice = grid.lattice;
    std::vector<unsigned int> owner(9 * 7 * 6, 0), sum_of_owners(owner.size());
    const auto                number = [&](const typename Lattice<dim>::Index &cell) {
      return cell[0] + 9 * (cell[1] + 7 * (dim == 3 ? cell[dim - 1] : 0));
    };
    for (unsigned int entry = 0; entry < lattice.owner.size(); ++entry)
      if (grid.owns_cell(entry))
        owner[number(lattice.table_entry(entry))] = Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
    Utilities::MPI::sum(owner, MPI_COMM_WORLD, sum_of_owners);
    bool is_right = true;
    for (unsigned int entry = 0; entry < lattice.owner.size(); ++entry)
      if (lattice.owner[entry] != lattice.missing)
        is_right = is_right && lattice.owner[entry] == sum_of_owners[number(lattice.table_entry(entry))];
    check_true(kernel + ": each cell's own owner", is_right);
  }

  /** Every node's owner writes where it is; all copies must read where they are. */
  template <int dim>
  void check_copies(const std::string &kernel, BoxGrid<dim> &grid)
  {
    grid.fields.clear();
    for (unsigned int i = 0; i < grid.fields.n_owned(); ++i)
      for (unsigned int d = 0; d < dim; ++d)
        grid.fields[i][d] = grid.node_position(i)[d];
    grid.fields.update_copies();
    double error = 0;
    for (unsigned int i = 0; i < grid.fields.n_local(); ++i)
      for (unsigned int d = 0; d < dim; ++d)
        raise(error, grid.fields[i][d] - grid.node_position(i)[d]);
    check(kernel + ": copies lie where their owners do", error, 1e-14);
  }
} // namespace

/**
 * Which cells' owners and which nodes a rank knows: those around its cells, and one layer more of owners and, for
 * stencils of four nodes, of nodes. By hand from the cells that it owns; and what the owners say arrives there.
 */
template <int dim>
void layers()
{
  for (const std::string kernel : {"quadratic B-spline", "cubic B-spline"})
  {
    Setup<dim> s(section("Grid", set("Cells", coordinates<dim>({{9, 7, 6}}))) + kernel_text(kernel, "WLS"));
    check_known(kernel, s.grid);
    check_owners(kernel, s.grid);
    check_copies(kernel, s.grid);
  }
}

/** A stencil is covered when every node of it that lies in the domain is known; here it is counted by hand. */
template <int dim>
void coverage()
{
  const auto  s       = setup<dim>();
  const auto &lattice = s.grid.lattice;
  for (const int n : {2, 3, 4})
  {
    const auto covered  = lattice.coverage(n);
    bool       is_right = true, own_cells = true;
    const int  shift         = n == 4 ? 1 : 0;
    unsigned   n_stencil     = std::pow(n, dim) + .5;
    unsigned   n_not_covered = 0;
    for (unsigned int entry = 0; entry < covered.size(); ++entry)
    {
      typename Lattice<dim>::Index base;
      for (unsigned int d = 0; d < dim; ++d)
        base[d] = lattice.first[d] + static_cast<int>(entry) / lattice.stride[d] % lattice.extent[d];
      bool is_known = true;
      for (unsigned int k = 0; k < n_stencil; ++k)
      {
        auto index     = base;
        bool is_domain = true;
        for (unsigned int d = 0, rest = k; d < dim; ++d, rest /= n)
        {
          index[d] += rest % n;
          is_domain = is_domain && index[d] >= 0 && index[d] <= cells[d];
        }
        if (is_domain)
          is_known =
            is_known && std::find(s.grid.node_index.begin(), s.grid.node_index.end(), index) != s.grid.node_index.end();
      }
      is_right = is_right && is_known == static_cast<bool>(covered[entry]);
      n_not_covered += !is_known;
    }
    // All stencils of this rank's cells: their first node is that of the cell, or the one before.
    for (unsigned int entry = 0; entry < lattice.owner.size(); ++entry)
      if (s.grid.owns_cell(entry))
        for (unsigned int k = 0; k < 1u << dim; ++k)
        {
          int base = entry;
          for (unsigned int d = 0; d < dim; ++d)
            base -= (n == 2 ? 0 : n == 4 ? shift : (k >> d) % 2) * lattice.stride[d];
          own_cells = own_cells && covered[base];
        }
    const std::string name = std::to_string(n) + " nodes per axis";
    check_true(name + ": known nodes", is_right);
    check_true(name + ": own cells are covered", own_cells);
    if (Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) == 1)
      check_true(name + ": one rank knows all", n_not_covered == 0);
    else
      check_true(name + ": two ranks do not", n_not_covered > 0);
  }
}

#define INSTANTIATE(name)                                                                                              \
  template void name<2>();                                                                                             \
  template void name<3>();
INSTANTIATE(exchange)
INSTANTIATE(layers)
INSTANTIATE(coverage)

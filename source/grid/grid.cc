#include <talus/core/exceptions.h>
#include <talus/grid/grid.h>

#include <deal.II/grid/grid_generator.h>

#include <iostream>
#include <numeric>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    /** The largest power of two that divides all counts; p4est refines this often from the coarse mesh. */
    template <std::size_t dim>
    unsigned int common_refinements(const std::array<int, dim> &counts)
    {
      int common = 0;
      for (const int count : counts)
        common = std::gcd(common, count);
      unsigned int refinements = 0;
      while (common % 2 == 0)
      {
        common /= 2;
        ++refinements;
      }
      return refinements;
    }
  } // namespace

  template <int dim>
  void Grid<dim>::create(const std::function<unsigned int(const CellIterator &)> &weight, const Reach &reach)
  {
    create_triangulation(weight);
    number_nodes();
    fill_tables(reach.layers);
  }

  template <int dim>
  void Grid<dim>::create_triangulation(const std::function<unsigned int(const CellIterator &)> &weight)
  {
    const unsigned int        refinements = common_refinements(lattice.n_cells);
    std::vector<unsigned int> coarse_counts(dim);
    double                    n_coarse = 1;
    for (unsigned int d = 0; d < dim; ++d)
    {
      coarse_counts[d] = lattice.n_cells[d] >> refinements;
      n_coarse *= coarse_counts[d];
    }
    if (n_coarse > 1e5 && Utilities::MPI::this_mpi_process(communicator) == 0)
    {
      std::cerr << "Warning: every rank stores a coarse mesh of " << n_coarse
                << " cells. Cell counts with a large common power of two avoid that, for example";
      for (const int count : lattice.n_cells)
        std::cerr << ' ' << (count + 8) / 16 * 16;
      std::cerr << ".\n";
    }
    GridGenerator::subdivided_hyper_rectangle(triangulation, coarse_counts, lower, upper, true);
    triangulation.refine_global(refinements);

    if (Utilities::MPI::n_mpi_processes(communicator) > 1)
    {
      const auto connection = triangulation.signals.weight.connect(
        // Material rules: cells without it are free but for their share of memory. p4est's weights have 31 bits.
        [&](const auto &cell, const auto) { return 1 + 1000 * std::min(weight(CellIterator(cell)), 1u << 20); });
      triangulation.repartition();
      connection.disconnect();
    }
    cells.assign(triangulation.n_active_cells(), CellIterator());
    for (const auto &cell : triangulation.active_cell_iterators())
      cells[cell->active_cell_index()] = cell;
  }

  template <int dim>
  void Grid<dim>::collect_active_nodes()
  {
    active_nodes.clear();
    for (unsigned int i = 0; i < fields.n_owned(); ++i)
      if (is_active[i])
        active_nodes.push_back(i);
  }

  template <int dim>
  void Grid<dim>::activate(const std::vector<char> &first, const unsigned int n)
  {
    AssertDimension(first.size(), lattice.node.size());
    // One axis after the other: true where an entry from i - n to i + 1 of this line is.
    std::vector<char> reached = first;
    for (unsigned int d = 0; d < dim; ++d)
    {
      const std::vector<char> before = reached;
      const int               stride = lattice.stride[d], size = before.size();
      for (int shift = -static_cast<int>(n); shift <= 1; ++shift)
        // What wraps around an end of a line comes from the tables' padding, where no stencil begins far out.
        for (int i = std::max(0, -shift * stride); i < size - std::max(0, shift * stride); ++i)
          reached[i] |= before[i + shift * stride];
    }

    // Tell the owners what reaches into their nodes, and those who have copies what the owners know.
    fields.clear();
    for (unsigned int i = 0; i < fields.n_local(); ++i)
      fields[i][0] = reached[lattice.table_index(node_index[i])];
    fields.add_copies_to_owners();
    fields.update_copies();
    for (unsigned int i = 0; i < fields.n_local(); ++i)
      is_active[i] = fields[i][0] > 0;
    fields.clear();
    collect_active_nodes();
  }

  template <int dim>
  bool Grid<dim>::is_active_around(const typename Lattice<dim>::Index &first, const unsigned int n) const
  {
    unsigned int n_entries = 1;
    for (unsigned int d = 0; d < dim; ++d)
      n_entries *= n + 2;
    for (unsigned int i = 0; i < n_entries; ++i)
    {
      auto index = first;
      for (unsigned int d = 0, rest = i; d < dim; ++d, rest /= n + 2)
        index[d] += static_cast<int>(rest % (n + 2)) - 1;
      if (!lattice.is_in_table(index))
        continue;
      const unsigned int node = lattice.node[lattice.table_index(index)];
      if (node != lattice.missing && !is_active[node])
        return false;
    }
    return true;
  }

  template <int dim>
  void Grid<dim>::set_slip_walls(const std::vector<typename Lattice<dim>::Faces> &faces, const unsigned int n)
  {
    AssertDimension(faces.size(), fields.n_owned());
    fields.clear();
    for (unsigned int i = 0; i < fields.n_owned(); ++i)
      fields[i][0] = faces[i];
    fields.update_copies();
    std::vector<typename Lattice<dim>::Faces> of_nodes(fields.n_local());
    for (unsigned int i = 0; i < fields.n_local(); ++i)
      of_nodes[i] = static_cast<typename Lattice<dim>::Faces>(fields[i][0]);
    fields.clear();
    lattice.find_slip_faces(of_nodes, n);
  }

  template <int dim>
  void Grid<dim>::clear()
  {
    fields.clear(active_nodes);
    fields.mirrored_force.fill(0.);
  }

  template <int dim>
  void Grid<dim>::update_velocity(const double dt, const std::vector<unsigned int> &some)
  {
    using Fields  = NodalFields<dim>;
    lost_momentum = 0;
    for (const unsigned int i : some)
    {
      double      *values = fields[i];
      const double m      = values[Fields::mass];
      if (m > mass_floor)
      {
        const double inverse_m = 1 / m;
        for (unsigned int d = 0; d < dim; ++d)
        {
          const double v                = values[Fields::momentum + d] * inverse_m;
          const double dv               = dt * values[Fields::force + d] * inverse_m;
          values[Fields::velocity + d]  = v + dv;
          values[Fields::increment + d] = dv;
        }
      }
      else
        // Empty nodes keep v = 0: dividing by m_i = 0 would spread NaN.
        for (unsigned int d = 0; d < dim; ++d)
        {
          lost_momentum[d] += values[Fields::momentum + d] + dt * values[Fields::force + d];
          values[Fields::velocity + d] = values[Fields::increment + d] = 0;
        }
    }
  }

  template <int dim>
  Point<dim> Grid<dim>::node_position(const unsigned int node) const
  {
    Point<dim> x;
    for (unsigned int d = 0; d < dim; ++d)
      x[d] = lattice.node_position(node_index[node][d], d);
    return x;
  }

  template <int dim>
  std::vector<unsigned int> Grid<dim>::nodes_on_boundary(const unsigned int boundary_id) const
  {
    const unsigned int        axis  = boundary_id / 2;
    const int                 index = boundary_id % 2 == 0 ? 0 : lattice.n_cells[axis];
    std::vector<unsigned int> nodes;
    for (unsigned int i = 0; i < fields.n_owned(); ++i)
      if (node_index[i][axis] == index)
        nodes.push_back(i);
    return nodes;
  }

  template <int dim>
  std::vector<unsigned int> Grid<dim>::nodes_in_box(const Point<dim> &lower, const Point<dim> &upper) const
  {
    std::vector<unsigned int> nodes;
    for (unsigned int i = 0; i < fields.n_owned(); ++i)
    {
      const Point<dim> x         = node_position(i);
      bool             is_inside = true;
      for (unsigned int d = 0; d < dim; ++d)
        is_inside = is_inside && lattice.is_between(x[d], lower[d], upper[d], d);
      if (is_inside)
        nodes.push_back(i);
    }
    return nodes;
  }

  template class Grid<2>;
  template class Grid<3>;
} // namespace Talus

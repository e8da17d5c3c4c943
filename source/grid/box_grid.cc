#include <talus/core/exceptions.h>
#include <talus/grid/box_grid.h>

#include <deal.II/grid/grid_generator.h>

#include <algorithm>
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
  void BoxGrid<dim>::create(const CellWeight &weight, const Reach &reach)
  {
    this->reach = reach;
    my_rank     = Utilities::MPI::this_mpi_process(communicator);
    create_triangulation();
    share_out(weight);
  }

  template <int dim>
  void BoxGrid<dim>::repartition(const std::vector<double> &counts)
  {
    share_out(this->weight_by(counts));
  }

  template <int dim>
  void BoxGrid<dim>::share_out(const CellWeight &weight)
  {
    if (Utilities::MPI::n_mpi_processes(communicator) > 1)
    {
      const auto connection = this->p4est.signals.weight.connect(
        // Material rules: cells without it are free but for their share of memory. p4est's weights have 31 bits.
        [&](const auto &cell, const auto) { return 1 + 1000 * std::min(weight(CellIterator(cell)), 1u << 20); });
      this->p4est.repartition();
      connection.disconnect();
    }
    number_nodes();
    fill_tables(reach.layers);
    knows_all_stencils = Utilities::MPI::n_mpi_processes(communicator) == 1;
    coverage           = knows_all_stencils ? std::vector<char>(lattice.node.size(), true) : lattice.coverage(reach.n);
  }

  template <int dim>
  void BoxGrid<dim>::create_triangulation()
  {
    const unsigned int        refinements = common_refinements(lattice.n_cells);
    std::vector<unsigned int> coarse_counts(dim);
    for (unsigned int d = 0; d < dim; ++d)
      coarse_counts[d] = lattice.n_cells[d] >> refinements;
    GridGenerator::subdivided_hyper_rectangle(this->p4est, coarse_counts, lower, upper, true);
    this->p4est.refine_global(refinements);
  }

  template <int dim>
  void BoxGrid<dim>::set_slip_walls(const std::vector<BoxFaces> &faces, const unsigned int n)
  {
    AssertDimension(faces.size(), fields.n_owned());
    NodalArray<1> shared;
    shared.reinit(nodes);
    for (const auto &neighbour : nodes.copied_by)
      for (const unsigned int i : neighbour.nodes)
        *shared[i] = faces[i];
    shared.update_copies();
    auto of_nodes = faces;
    for (unsigned int i = fields.n_owned(); i < fields.n_local(); ++i)
      of_nodes.push_back(static_cast<BoxFaces>(*shared[i]));
    lattice.find_slip_faces(of_nodes, n);
  }

  template <int dim>
  Point<dim> BoxGrid<dim>::node_position(const unsigned int node) const
  {
    Point<dim> x;
    for (unsigned int d = 0; d < dim; ++d)
      x[d] = lattice.node_position(node_index[node][d], d);
    return x;
  }

  template <int dim>
  std::vector<unsigned int> BoxGrid<dim>::nodes_on_boundary(const unsigned int boundary_id) const
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
  bool BoxGrid<dim>::contains(const Tensor<1, dim> &x) const
  {
    for (unsigned int d = 0; d < dim; ++d)
      if (!lattice.is_inside(lattice.coordinate(x[d], d), d))
        return false;
    return true;
  }

  template <int dim>
  std::size_t BoxGrid<dim>::cell_number(const Point<dim> &x) const
  {
    // With a layer of cells around the box, lest what lies just beyond it goes by the number of a cell within.
    const auto  index  = lattice.cell_index(x);
    std::size_t number = 0;
    for (unsigned int d = dim; d-- > 0;)
      number = number * (lattice.n_cells[d] + 2) + (index[d] + 1);
    return number;
  }

  template <int dim>
  BoundingBox<dim> BoxGrid<dim>::cell_box(const CellIterator &cell) const
  {
    const auto index = lattice.cell_index(cell->center());
    Point<dim> a, b;
    for (unsigned int d = 0; d < dim; ++d)
    {
      // Wider than round-off, so that shapes show all that may lie in the cell.
      const double margin = 2 * lattice.face_tolerance(d) + 1e-6 * lattice.h[d];
      a[d]                = lattice.node_position(index[d], d) - margin;
      b[d]                = lattice.node_position(index[d] + 1, d) + margin;
    }
    return BoundingBox<dim>({a, b});
  }

  template <int dim>
  std::vector<typename BoxGrid<dim>::CellNodes> BoxGrid<dim>::cells(const bool only_active) const
  {
    std::vector<CellNodes> result;
    for (unsigned int i = 0; i < fields.n_local(); ++i)
    {
      if ((only_active && !is_active[i]) || !owns_cell(nodes.place(i)))
        continue;
      CellNodes    cell;
      unsigned int v          = 0;
      bool         all_active = true;
      for_each_index(node_index[i], 2, [&](const auto &corner) {
        cell[v]    = lattice.node_at(corner);
        all_active = is_active[cell[v]] && all_active;
        ++v;
      });
      if (all_active || !only_active)
        result.push_back(cell);
    }
    // The order of copies hangs on how deal.II has come to this share of the cells.
    std::sort(result.begin(), result.end(),
              [&](const CellNodes &a, const CellNodes &b) { return nodes.place(a[0]) < nodes.place(b[0]); });
    return result;
  }

  template <int dim>
  std::vector<bool> BoxGrid<dim>::are_inside(const std::vector<Point<dim>> &points) const
  {
    std::vector<bool> result;
    for (const auto &x : points)
      result.push_back(contains(x));
    return result;
  }

  template <int dim>
  BoundaryPart<dim> BoxGrid<dim>::boundary(const std::string &number) const
  {
    for (unsigned int id = 0; id < 2 * dim; ++id)
      if (number == std::to_string(id))
      {
        Tensor<1, dim> normal;
        normal[id / 2] = id % 2 == 0 ? -1. : 1.;
        BoundaryPart<dim> part;
        for (const unsigned int node : nodes_on_boundary(id))
          part.add(node, {normal});
        return part;
      }
    throw InputError("The box grid has no boundary '" + number + "'. Its faces have the numbers 0 to " +
                     std::to_string(2 * dim - 1) + ".");
  }

  template <int dim>
  BoxGrid<dim> &box_grid(Grid<dim> &grid, const std::string &section, const std::string &entry)
  {
    const auto box = dynamic_cast<BoxGrid<dim> *>(&grid);
    AssertThrow(
      box != nullptr,
      EntryError(section, entry,
                 "this needs a box grid: set 'Type = box' in section 'Grid'" +
                   std::string(section == "/Kernel" ? ", or take a kernel for meshes, such as 'UMLS'." : ".")));
    return *box;
  }

  template <int dim>
  const BoxGrid<dim> &box_grid(const Grid<dim> &grid, const std::string &section, const std::string &entry)
  {
    return box_grid(const_cast<Grid<dim> &>(grid), section, entry);
  }

#define INSTANTIATE(dim)                                                                                               \
  template class BoxGrid<dim>;                                                                                         \
  template BoxGrid<dim>       &box_grid(Grid<dim> &, const std::string &, const std::string &);                        \
  template const BoxGrid<dim> &box_grid(const Grid<dim> &, const std::string &, const std::string &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Talus

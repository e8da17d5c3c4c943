#include <talus/grid/simplex_grid.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <map>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    template <int dim, class Columns>
    std::array<double, dim> point(const Columns &x, const unsigned int p)
    {
      std::array<double, dim> x_p;
      for (unsigned int d = 0; d < dim; ++d)
        x_p[d] = x[d][p];
      return x_p;
    }
  } // namespace

  template <int dim>
  void SimplexGrid<dim>::look(const Columns &x, const unsigned int begin, const unsigned int end, unsigned int *place,
                              Found &found) const
  {
    const unsigned int n_owned = this->partition.n_owned_cells;
    for (unsigned int p = begin; p < end; ++p)
    {
      const auto   x_p  = point<dim>(x, p);
      const Walk   at   = walk(mesh(), place[p], x_p.data());
      unsigned int cell = at.is_found ? at.cell : this->partition.find_here(x_p.data());
      // A walk that ends at a cell of this rank has come to the boundary, any other to what this rank does not know.
      if (cell == none && at.cell < n_owned)
      {
        found.outside.push_back(p);
        continue;
      }
      place[p]               = cell;
      found.strays           = found.strays || !(cell < n_owned);
      found.needs_activation = found.needs_activation || (cell < n_owned && !is_open[cell]);
    }
  }

  template <int dim>
  void SimplexGrid<dim>::places(const Points &, const unsigned int *place, const unsigned int begin,
                                const unsigned int end, unsigned int *result) const
  {
    for (unsigned int p = begin; p < end; ++p)
      result[p - begin] = place[p] < this->partition.n_owned_cells ? place[p] : none;
  }

  template <int dim>
  std::vector<Leaver> SimplexGrid<dim>::leavers(const Points &x, const unsigned int *place, const unsigned int n) const
  {
    std::vector<Leaver>                     leavers;
    std::vector<unsigned int>               far;
    std::vector<typename Mesh<dim>::Vector> points;
    for (unsigned int p = 0; p < n; ++p)
      if (place[p] == none)
      {
        far.push_back(leavers.size());
        points.push_back(point<dim>(x, p));
        leavers.push_back({p, none, none});
      }
      else if (place[p] >= this->partition.n_owned_cells)
        leavers.push_back({p, mesh().owner[place[p]], mesh().number[place[p]]});
    // Seldom: a particle has crossed all cells that this rank knows.
    if (Utilities::MPI::max<unsigned int>(far.size(), communicator) == 0)
      return leavers;
    const auto locations = this->partition.find(points);
    for (unsigned int i = 0; i < far.size(); ++i)
      if (locations[i].is_found)
      {
        leavers[far[i]].rank  = locations[i].rank;
        leavers[far[i]].place = locations[i].cell;
      }
    return leavers;
  }

  template <int dim>
  void SimplexGrid<dim>::activate(const std::vector<char> &is_used)
  {
    // The vertices of cells in use, on any rank; then the rings of all cells at these: particles may go on for a cell.
    const unsigned int n_owned = this->partition.n_owned_cells;
    std::vector<char>  is_near(mesh().n_nodes(), 0), is_reached(mesh().n_nodes(), 0);
    for (unsigned int c = 0; c < n_owned; ++c)
      if (is_used[c])
        for (const unsigned int v : mesh().nodes[c])
          is_near[v] = 1;
    auto near_nodes = by_number(is_near);
    this->spread(near_nodes);
    is_near            = by_place(near_nodes);
    const Rings &rings = mesh().rings;
    for (unsigned int c = 0; c < n_owned; ++c)
      if (std::any_of(mesh().nodes[c].begin(), mesh().nodes[c].end(), [&](const unsigned int v) { return is_near[v]; }))
        for (std::size_t k = rings.begin[c]; k < rings.begin[c + 1]; ++k)
          is_reached[mesh().real(rings.node[k])] = 1;
    this->activate_nodes(by_number(is_reached));
  }

  template <int dim>
  std::vector<char> SimplexGrid<dim>::by_number(const std::vector<char> &of_places) const
  {
    std::vector<char> of_nodes(this->nodes.n_local());
    for (unsigned int i = 0; i < of_nodes.size(); ++i)
      of_nodes[i] = of_places[this->nodes.place(i)];
    return of_nodes;
  }

  template <int dim>
  std::vector<char> SimplexGrid<dim>::by_place(const std::vector<char> &of_nodes) const
  {
    std::vector<char> of_places(of_nodes.size());
    for (unsigned int i = 0; i < of_nodes.size(); ++i)
      of_places[this->nodes.place(i)] = of_nodes[i];
    return of_places;
  }

  template <int dim>
  std::vector<typename SimplexGrid<dim>::CellNodes> SimplexGrid<dim>::cells(const bool only_active) const
  {
    std::vector<unsigned int> number(mesh().n_nodes());
    for (unsigned int i = 0; i < this->nodes.n_local(); ++i)
      number[this->nodes.place(i)] = i;
    std::vector<CellNodes> result;
    for (unsigned int c = 0; c < this->partition.n_owned_cells; ++c)
    {
      CellNodes cell{};
      bool      all_active = true;
      for (unsigned int v = 0; v <= dim; ++v)
      {
        cell[v]    = number[mesh().nodes[c][v]];
        all_active = all_active && this->is_active[cell[v]];
      }
      if (all_active || !only_active)
        result.push_back(cell);
    }
    return result;
  }

  template <int dim>
  void SimplexGrid<dim>::find_open_cells()
  {
    const auto   is_active = by_place({this->is_active.begin(), this->is_active.end()});
    const Rings &rings     = mesh().rings;
    for (unsigned int c = 0; c < this->partition.n_owned_cells; ++c)
      is_open[c] = std::all_of(rings.node.begin() + rings.begin[c], rings.node.begin() + rings.begin[c + 1],
                               [&](const unsigned int v) { return is_active[mesh().real(v)]; });
  }

  template <int dim>
  bool SimplexGrid<dim>::contains(const Tensor<1, dim> &x) const
  {
    return this->partition.find_here(x.begin_raw()) != none;
  }

  template <int dim>
  std::size_t SimplexGrid<dim>::cell_number(const Point<dim> &x) const
  {
    return this->partition.find_here(x.begin_raw());
  }

  template <int dim>
  Point<dim> SimplexGrid<dim>::unit_point(const CellIterator &, const Point<dim> &x) const
  {
    const auto B = mesh().barycentric(this->partition.find_here(x.begin_raw()), x.begin_raw());
    Point<dim> result;
    for (unsigned int d = 0; d < dim; ++d)
      result[d] = B[d + 1];
    return result;
  }

  template <int dim>
  dealii::BoundingBox<dim> SimplexGrid<dim>::cell_box(const CellIterator &cell) const
  {
    dealii::BoundingBox<dim> box = cell->bounding_box();
    box.extend(1e-6 * mesh().longest_edge);
    return box;
  }

  template <int dim>
  std::vector<bool> SimplexGrid<dim>::are_inside(const std::vector<Point<dim>> &points) const
  {
    std::vector<typename Mesh<dim>::Vector> positions;
    for (const auto &x : points)
    {
      positions.emplace_back();
      std::copy_n(x.begin_raw(), dim, positions.back().begin());
    }
    std::vector<bool> result;
    for (const auto &location : this->partition.find(positions))
      result.push_back(location.is_found);
    return result;
  }

  template <int dim>
  BoundaryPart<dim> SimplexGrid<dim>::boundary(const std::string &name) const
  {
    const auto group = this->group(name);
    const auto owned = this->dof_handler.locally_owned_dofs();

    // Of each node the sums of face normals times areas, one for each smooth part of the boundary that meets there.
    std::map<unsigned int, std::vector<Tensor<1, dim>>> sums;
    constexpr double                                    same = 0.75; // cosine of the angle within a smooth part
    for (const auto &cell : this->dof_handler.active_cell_iterators())
      if (cell->is_locally_owned() || cell->is_ghost())
        for (const unsigned int f : cell->face_indices())
        {
          const auto face = cell->face(f);
          if (!face->at_boundary() || face->boundary_id() != group.number)
            continue;
          Tensor<1, dim> normal;
          if constexpr (dim == 2)
            normal = cross_product_2d(face->vertex(1) - face->vertex(0));
          else
            normal = cross_product_3d(face->vertex(1) - face->vertex(0), face->vertex(2) - face->vertex(0));
          if (normal * (face->vertex(0) - cell->barycenter()) < 0)
            normal *= -1.;
          for (const unsigned int v : face->vertex_indices())
          {
            const auto dof = face->vertex_dof_index(v, 0);
            if (!owned.is_element(dof))
              continue;
            auto      &list  = sums[owned.index_within_set(dof)];
            const auto close = std::find_if(list.begin(), list.end(), [&](const auto &sum) {
              return sum * normal > same * sum.norm() * normal.norm();
            });
            if (close == list.end())
              list.push_back(normal);
            else
              *close += normal;
          }
        }
    BoundaryPart<dim> part;
    if (const auto mirrored = mirrored_faces.find(group.number); mirrored != mirrored_faces.end())
      part.mirrored_faces = mirrored->second;
    for (auto &[node, list] : sums)
    {
      for (auto &sum : list)
        sum /= sum.norm();
      part.add(node, list);
    }
    return part;
  }

#define INSTANTIATE(dim)                                                                                               \
  template void SimplexGrid<dim>::look(const Columns &, const unsigned int, const unsigned int, unsigned int *,        \
                                       Found &) const;                                                                 \
  template void SimplexGrid<dim>::places(const Points &, const unsigned int *, const unsigned int, const unsigned int, \
                                         unsigned int *) const;                                                        \
  template std::vector<Leaver> SimplexGrid<dim>::leavers(const Points &, const unsigned int *, const unsigned int)     \
    const;                                                                                                             \
  template void              SimplexGrid<dim>::activate(const std::vector<char> &);                                    \
  template std::vector<char> SimplexGrid<dim>::by_number(const std::vector<char> &) const;                             \
  template std::vector<char> SimplexGrid<dim>::by_place(const std::vector<char> &) const;                              \
  template void              SimplexGrid<dim>::find_open_cells();                                                      \
  template std::vector<typename SimplexGrid<dim>::CellNodes> SimplexGrid<dim>::cells(const bool) const;                \
  template bool                                              SimplexGrid<dim>::contains(const Tensor<1, dim> &) const; \
  template std::size_t                                       SimplexGrid<dim>::cell_number(const Point<dim> &) const;  \
  template Point<dim>               SimplexGrid<dim>::unit_point(const CellIterator &, const Point<dim> &) const;      \
  template dealii::BoundingBox<dim> SimplexGrid<dim>::cell_box(const CellIterator &) const;                            \
  template std::vector<bool>        SimplexGrid<dim>::are_inside(const std::vector<Point<dim>> &) const;               \
  template BoundaryPart<dim>        SimplexGrid<dim>::boundary(const std::string &) const;
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Talus

#include <talus/grid/mesh_walk.h>

namespace Talus
{
  namespace
  {
    template <int dim>
    std::vector<GrowingBox<dim>> boxes(const Mesh<dim> &mesh)
    {
      std::vector<GrowingBox<dim>> boxes(mesh.n_cells());
      for (unsigned int c = 0; c < mesh.n_cells(); ++c)
        for (const unsigned int v : mesh.nodes[c])
          boxes[c].add(mesh.position[v]);
      return boxes;
    }
  } // namespace

  template <int dim>
  CellFinder<dim>::CellFinder(const Mesh<dim> &mesh) : mesh(mesh), bins(boxes(mesh))
  {
  }

  template <int dim>
  unsigned int CellFinder<dim>::find(const double *x) const
  {
    if (last < mesh.n_cells())
    {
      const Walk end = walk(mesh, last, x);
      last           = end.cell;
      // Within a cell, and not on a face, there is no other that holds it.
      const auto B = mesh.barycentric(end.cell, x);
      if (*std::min_element(B.begin(), B.end()) > 100 * barycentric_tolerance)
        return end.cell;
    }
    // Of several that hold it within round-off, the one it lies deepest in, and then the first of the lowest rank: the
    // same on all ranks.
    const auto comes_before = [&](const unsigned int a, const unsigned int b) {
      return mesh.owner[a] < mesh.owner[b] || (mesh.owner[a] == mesh.owner[b] && mesh.number[a] < mesh.number[b]);
    };
    unsigned int            found   = mesh.missing;
    double                  deepest = -barycentric_tolerance;
    std::array<double, dim> point;
    std::copy(x, x + dim, point.begin());
    bins.for_near(point, point, [&](const unsigned int cell) {
      const auto   B     = mesh.barycentric(cell, x);
      const double least = *std::min_element(B.begin(), B.end());
      if (least > deepest || (least == deepest && (found == mesh.missing || comes_before(cell, found))))
      {
        found   = cell;
        deepest = least;
      }
    });
    return found;
  }

  template class CellFinder<1>;
  template class CellFinder<2>;
  template class CellFinder<3>;
} // namespace Talus

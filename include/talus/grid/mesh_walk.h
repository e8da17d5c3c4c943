#pragma once

#include <talus/grid/bins.h>
#include <talus/grid/mesh.h>

namespace Talus
{
  /**
   * A point this far outside still belongs to a cell: more than the round-off of barycentric coordinates, 2e-16 |x|/h,
   * lest a point on a face belongs to neither side.
   */
  constexpr double barycentric_tolerance = 1e-10;

  /** Where a walk has ended: in the cell that holds the point, or at a face beyond which no cell is known. */
  struct Walk
  {
    unsigned int cell;
    bool         is_found;
  };

  /**
   * Walks from `cell` to the cell that holds x: always through the face opposite to the vertex with the most negative
   * barycentric coordinate, along which x lies farthest outside. Meshes that are not convex may end the walk at their
   * boundary although x lies inside, and some that are not Delaunay could make it go in circles: it gives up.
   * Test: tests/mesh/location.cc.
   */
  template <int dim>
  Walk walk(const Mesh<dim> &mesh, unsigned int cell, const double *x)
  {
    constexpr unsigned int max_steps = 100;
    for (unsigned int step = 0; step < max_steps; ++step)
    {
      const auto   B        = mesh.barycentric(cell, x);
      unsigned int farthest = 0;
      for (unsigned int k = 1; k <= dim; ++k)
        if (B[k] < B[farthest])
          farthest = k;
      if (B[farthest] >= -barycentric_tolerance)
        return {cell, true};
      const unsigned int next = mesh.neighbours[cell][farthest];
      if (next == mesh.missing)
        return {cell, false};
      cell = next;
    }
    return {cell, false};
  }

  /** Finds the cells of points: of any, or of those whose cell was known before they moved. */
  template <int dim>
  class CellFinder
  {
  public:
    explicit CellFinder(const Mesh<dim> &mesh);

    /**
     * The cell that holds x, or Mesh::missing when none of those here does; of several, on their faces, the same
     * whatever was asked before. Fast for points near the last one.
     */
    unsigned int find(const double *x) const;

    /** The same, if x has come not far from `cell`. */
    unsigned int find_from(const unsigned int cell, const double *x) const
    {
      const Walk end = walk(mesh, cell, x);
      return end.is_found ? end.cell : find(x);
    }

  private:
    const Mesh<dim>     &mesh;
    Bins<dim>            bins;
    mutable unsigned int last = 0; // where the search begins
  };
} // namespace Talus

#pragma once

#include <talus/grid/lattice.h>

namespace Talus
{
  /** A component of a ghost node's velocity as a sum over real nodes; the coefficients sum to one. */
  template <int dim>
  struct WallRow
  {
    using Index = typename Lattice<dim>::Index;

    unsigned int                  size = 0;
    std::array<Index, 1u << dim>  node;
    std::array<double, 1u << dim> coefficient;

    /** Appends `factor` times another row; no node is in both. */
    void add(const double factor, const WallRow &other)
    {
      for (unsigned int k = 0; k < other.size; ++k)
      {
        node[size]          = other.node[k];
        coefficient[size++] = factor * other.coefficient[k];
      }
    }
  };

  /** The node of the domain next to a lattice index. */
  template <std::size_t dim>
  std::array<int, dim> clamped(std::array<int, dim> index, const std::array<int, dim> &n_cells)
  {
    for (unsigned int d = 0; d < dim; ++d)
      index[d] = std::min(std::max(index[d], 0), n_cells[d]);
    return index;
  }

  /**
   * The row of the node at `index`, at most one index beyond each face of a box of `n_cells` cells: a ghost. It is
   * built along the lowest axis d beyond whose face it lies, with the node w of this line on the face and the node q
   * inside, which are ghosts themselves where the line lies outside the box:
   * @f[ row = row(q) \quad\text{or}\quad row = 2\, row(w) - row(q) . @f]
   * The first, v even in the distance from the wall, where w slips: its normal component d is held and this one is
   * not; the second everywhere else, v linear across the face. `holds(node, component)` tells what is held at the nodes
   * of the faces. Where w is a ghost its image inside counts, one node before the other faces: *at* them it would be
   * held by their conditions, and the wall not what it is along the line. Then v_n = 0 on a wall as far as its edges,
   * whatever stands there. Real nodes have unit rows. Test: tests/grid/walls.cc.
   */
  template <int dim, class Holds>
  WallRow<dim> wall_row(const typename Lattice<dim>::Index &index, const unsigned int component,
                        const typename Lattice<dim>::Index &n_cells, const Holds &holds)
  {
    unsigned int d = 0;
    while (d < dim && index[d] >= 0 && index[d] <= n_cells[d])
      ++d;
    WallRow<dim> row;
    if (d == dim)
    {
      row.size           = 1;
      row.node[0]        = index;
      row.coefficient[0] = 1;
      return row;
    }
    auto w = index, q = index;
    w[d] = index[d] < 0 ? 0 : n_cells[d];
    q[d] = index[d] < 0 ? 1 : n_cells[d] - 1;

    auto wall = w;
    for (unsigned int e = d + 1; e < dim; ++e)
      if (w[e] != std::min(std::max(w[e], 0), n_cells[e]))
        wall[e] = w[e] < 0 ? 1 : n_cells[e] - 1;
    const bool slips = holds(wall, d) && !holds(wall, component);
    row.add(slips ? 1 : -1, wall_row<dim>(q, component, n_cells, holds));
    if (!slips)
      row.add(2, wall_row<dim>(w, component, n_cells, holds));
    return row;
  }
} // namespace Talus

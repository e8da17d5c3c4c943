#pragma once

#include <talus/grid/grid.h>
#include <talus/particles/body.h>

namespace Talus
{
  /** How much of a body there is. */
  struct Amount
  {
    std::uint64_t n      = 0; // particles
    double        volume = 0; // [volume]; NaN where a mesh cuts the body
  };

  /**
   * What the body's shape says that it has of particles, cut by the grid where the body is; found without looking at
   * cells, so that creation can be compared with it. Throws EntryError, on all ranks, for a point that does not lie in
   * the grid of a body that is not cut. Collective. Test: tests/particles/amounts.cc.
   */
  template <int dim>
  Amount amount_of_shape(const Grid<dim> &grid, const Body<dim> &body);

  /** Throws EntryError where what has been created is not what the shape has: a run never begins with less. */
  template <int dim>
  void check_amount(const Body<dim> &body, const Amount &created, const Amount &wanted);
} // namespace Talus

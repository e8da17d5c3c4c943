#pragma once

#include <talus/grid/grid.h>
#include <talus/kernels/kernel.h>
#include <talus/particles/working_set.h>

namespace Talus
{
  /**
   * Gathers grad v of all particles from the nodes' velocities, Eq. (26), and nothing else: positions, velocities and
   * what the transfer stores stay. `is_plain` as in Transfer. Test: tests/steppers.
   */
  template <int dim>
  void gather_velocity_gradient(const Grid<dim> &grid, const Kernel<dim> &kernel, const bool is_plain,
                                WorkingSet<dim> &particles);
} // namespace Talus

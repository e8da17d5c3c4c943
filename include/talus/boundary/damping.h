#pragma once

#include <talus/boundary/held_components.h>
#include <talus/grid/grid.h>

namespace Talus
{
  /**
   * Local damping for quasi-static work, Cundall (1987): each component of a node's force is changed by
   * @f[ -\alpha |f_i| \, \mathrm{sign}(v_i^n) , @f]
   * so that a motion loses the same share of its energy in each period whatever its frequency, and nothing is left of
   * it in equilibrium. Components that a condition has set in this step are not damped: their force is a reaction.
   * Test: tests/boundary/damping.cc, tests/loads (decay of a bar).
   */
  template <int dim>
  class LocalDamping
  {
  public:
    double factor = 0; // alpha [1], 0 <= alpha < 1; 0: none, at no cost
    double work   = 0; // on the body in the last step, of this rank, then of all [energy]

    /** Damps the velocities of some of this rank's nodes where they are not `held`, after the conditions. */
    void apply(const std::vector<unsigned int> &nodes, const HeldComponents<dim> &held, Grid<dim> &grid);
  };
} // namespace Talus

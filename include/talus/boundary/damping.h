#pragma once

#include <talus/grid/grid.h>

#include <vector>

namespace Talus
{
  /**
   * Local damping for quasi-static work, Cundall (1987): each component of a node's force is changed by
   * @f[ -\alpha |f_i| \, \mathrm{sign}(v_i^n) , @f]
   * so that a motion loses the same share of its energy in each period whatever its frequency, and nothing is left of
   * it in equilibrium. Components that a condition has set in this step are not damped: their force is a reaction.
   * Test: tests/boundary/main.cc, tests/loads (decay of a bar).
   */
  template <int dim>
  class LocalDamping
  {
  public:
    double factor = 0; // alpha [1], 0 <= alpha < 1; 0: none, at no cost
    double work   = 0; // on the body in the last step [energy]

    /** Forgets what was held in the last step. */
    void begin(const Grid<dim> &grid)
    {
      work = 0;
      for (const std::size_t k : held)
        is_held[k] = false;
      held.clear();
      is_held.resize(grid.fields.n_owned() * dim, false);
    }

    /** This component's velocity is prescribed; returns whether it was free until now. */
    bool hold(const unsigned int i, const unsigned int component)
    {
      const std::size_t k        = std::size_t{i} * dim + component;
      const bool        was_free = !is_held[k];
      if (was_free)
        held.push_back(k);
      is_held[k] = true;
      return was_free;
    }

    /** Damps the velocities of this rank's nodes, after the conditions. */
    void apply(Grid<dim> &grid);

  private:
    std::vector<char>        is_held; // dim for each owned node
    std::vector<std::size_t> held;
  };
} // namespace Talus

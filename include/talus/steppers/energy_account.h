#pragma once

#include <talus/core/reduction.h>
#include <talus/grid/walls.h>
#include <talus/materials/material.h>

#include <vector>

namespace Talus
{
  /**
   * Where the nodes' kinetic energy goes in a step. With v0 = p_i / m_i what particles have brought, v1 the velocities
   * that they get back, f the forces and R what conditions add to the momentum,
   * @f[ K_1 - K_0 = \Delta t\, f \cdot v_1 + R \cdot v_1 - \tfrac12 \sum_i m_i |v_1 - v_0|^2 . @f]
   * Of the last sum the share of components which conditions or ghost nodes have changed is the loss at walls; that of
   * free ones, less what the stress changes by during the step, is the loss of the integration in time. What particles
   * and nodes differ by is the loss of the transfer. Theory: doc/energy.md. Test: tests/steppers/energy_account.cc.
   */
  template <int dim>
  class EnergyAccount
  {
  public:
    bool is_on = false;

    /** Keeps the sums of this rank's nodes, when they are complete. */
    void start(const Grid<dim> &grid, const Walls<dim> &walls);

    /** Finds what the step, of size dt, has made of them, when conditions have acted and ghosts are filled. */
    void finish(const double dt, const Grid<dim> &grid, const Walls<dim> &walls);

    /** Keeps the forces of stress alone, and no others, from nodes that have been summed once more (MUSL). */
    void restart(const Grid<dim> &grid, const Walls<dim> &walls);

    /** The stress worked with these velocities and not with those of the step. */
    void repeat(const double dt, const Grid<dim> &grid, const Walls<dim> &walls);

    /** Counts the work of the stress at the begin of the step, and at its end, on the strain of the step. */
    void count_stress(const MaterialRange &range, const bool is_end);

    void add_to(Reduction &reduction);

    // Of the last step: of this rank's nodes, then of all [energy].
    double change           = 0; // K_1 - K_0
    double wall_loss        = 0;
    double integration_loss = 0;
    double second_loss      = 0; // by the second velocities of MUSL

  private:
    using Fields                      = NodalFields<dim>;
    static constexpr unsigned int all = Fields::stride;

    /** Calls body(numbers) for this rank's active nodes and its ghosts, always in the same order. */
    template <class Body>
    static void for_each_node(const Grid<dim> &grid, const Walls<dim> &walls, const Body &body);

    static void copy(const Grid<dim> &grid, const Walls<dim> &walls, std::vector<double> &numbers);

    std::vector<double> before, stress; // `all` numbers of each node
    std::vector<double> first;          // their velocities in the step
  };
} // namespace Talus

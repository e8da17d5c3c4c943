#pragma once

#include <talus/boundary/condition.h>
#include <talus/boundary/damping.h>
#include <talus/boundary/obstacle.h>

#include <memory>

namespace Talus
{
  /**
   * The conditions of a run, applied in the order of the list, the damping of what they leave free, and then the
   * obstacles.
   */
  template <int dim>
  class Boundary
  {
  public:
    void apply(const double time, const double dt, Grid<dim> &grid)
    {
      held.clear(grid.fields.n_owned());
      for (auto &condition : conditions)
        condition->apply(time, dt, grid, held);
      damping.apply(grid.active_nodes, held, grid);
      meet_obstacles(time, dt, nullptr, grid);
    }

    /**
     * The same where the grid has ghosts: from the nodes' sums to their velocities at `time`, the end of a step.
     * Collective.
     */
    void solve(const double time, const double dt, Walls<dim> &walls, Grid<dim> &grid);

    /**
     * Changes velocities as apply() does, or solve() with the nodes' momenta alone, once more in the same step: what
     * conditions and faces know of it stays as it was.
     */
    void repeat(const double time, const double dt, Walls<dim> &walls, Grid<dim> &grid);

    /** Finds the nodes of all conditions. Collective. */
    void attach(const Grid<dim> &grid)
    {
      for (auto &condition : conditions)
        condition->attach(grid);
      for (auto &obstacle : obstacles)
        obstacle->attach(grid);
      marked.clear();
    }

    void select(const Grid<dim> &grid)
    {
      for (auto &condition : conditions)
        condition->select(grid);
    }

    /**
     * Tells the grid which nodes are of slip walls, and of nothing else, in a step that ends at `time`; stencils have n
     * nodes per axis. Collective; costs nothing unless a condition begins or ends.
     */
    void mark_slip_walls(const double time, const unsigned int n, Grid<dim> &grid);

    void add_to(Reduction &reduction)
    {
      for (auto &condition : conditions)
        condition->add_to(reduction);
      reduction.sum(damping.work);
      for (auto &obstacle : obstacles)
        obstacle->add_to(reduction);
    }

    void add_to(Table &table) const;

    void serialize(Archive &archive, const Grid<dim> &grid)
    {
      for (unsigned int c = 0; c < conditions.size(); ++c)
      {
        const Archive::Scope scope(archive, "condition." + names[c]);
        conditions[c]->serialize(archive, grid);
      }
      for (auto &obstacle : obstacles)
      {
        const Archive::Scope scope(archive, "obstacle." + obstacle->name);
        obstacle->serialize(archive, grid);
      }
    }

    std::vector<std::string>                     names;
    std::vector<std::unique_ptr<Condition<dim>>> conditions;
    std::vector<std::unique_ptr<Obstacle<dim>>>  obstacles;
    LocalDamping<dim>                            damping;

  private:
    void account(const double dt, const Grid<dim> &grid);

    /** `walls`: where they have solved for the velocities. */
    void meet_obstacles(const double time, const double dt, Walls<dim> *walls, Grid<dim> &grid,
                        const bool is_repeated = false);

    HeldComponents<dim> held;
    Prescribed<dim>     prescribed;
    std::vector<bool>   marked; // which conditions acted when the slip walls were marked
  };
} // namespace Talus

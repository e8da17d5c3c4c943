#pragma once

#include <talus/grid/grid.h>

namespace Talus
{
  /**
   * Prescribes velocities of nodes after the momentum equation is solved. What it
   * takes from the nodes' momentum is its reaction.
   */
  template <int dim>
  class Condition : public dealii::ParameterAcceptor
  {
  public:
    explicit Condition(const std::string &section);

    /** Finds the nodes; throws EntryError where the region is wrong or holds none. Collective. */
    virtual void attach(const Grid<dim> &grid);

    /** Changes the velocities of this rank's nodes at the end of the step. */
    void apply(const double time, const double dt, Grid<dim> &grid);

    void parse_parameters(dealii::ParameterHandler &prm) override;

    /** Force of the body on the condition, sum m (v_trial - v) / dt, of this rank's nodes in the last step [force]. */
    dealii::Tensor<1, dim> reaction;
    /** Work the condition did on the body in the last step [energy]. */
    double work = 0;

  protected:
    virtual void prescribe(const double time, Grid<dim> &grid) = 0;

    /** Sets a component of a node's velocity and records what it costs. */
    void set(double *node, const unsigned int component, const double velocity)
    {
      using Fields         = NodalFields<dim>;
      const double change  = velocity - node[Fields::velocity + component];
      const double impulse = -node[Fields::mass] * change;
      reaction[component] += impulse / dt;
      work -= impulse * velocity;
      node[Fields::velocity + component] = velocity;
      node[Fields::increment + component] += change;
    }

    std::vector<unsigned int>              boundary_ids;
    std::vector<std::vector<unsigned int>> nodes; // owned, of each boundary id; of the box in the last list

  private:
    std::vector<double> lower, upper;
    double              dt = 0;
  };

  /** The conditions of a run, applied in the order of the list. */
  template <int dim>
  class Boundary
  {
  public:
    void apply(const double time, const double dt, Grid<dim> &grid)
    {
      for (auto &condition : conditions)
        condition->apply(time, dt, grid);
    }

    std::vector<std::string>                     names;
    std::vector<std::unique_ptr<Condition<dim>>> conditions;
  };
} // namespace Talus

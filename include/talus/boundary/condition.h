#pragma once

#include <talus/boundary/held_components.h>
#include <talus/core/function.h>
#include <talus/core/reduction.h>
#include <talus/core/table.h>
#include <talus/grid/walls.h>

#include <limits>
#include <string>

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

    /** Looks which of its nodes are active: the others have no material near, and are left alone. */
    void select(const Grid<dim> &grid);

    /**
     * Changes the velocities of this rank's nodes at the end of the step, if its interval contains `time`, and
     * notes what it sets.
     */
    void apply(const double time, const double dt, Grid<dim> &grid, HeldComponents<dim> &held);

    /** Says what it holds at the end of the step, if its interval contains `time`; who solves for the velocities does
     * the rest, and calls take(). */
    void prescribe(const double time, Grid<dim> &grid, Prescribed<dim> &prescribed);

    /**
     * Enters what a component of a node has cost in a step of size dt: what was taken from the body there, the share of
     * its forces in it, and the velocity that it has [momentum, length/time].
     */
    void take(const unsigned int component, const double impulse, const double force_impulse, const double velocity,
              const double dt)
    {
      reaction[component] += impulse / dt;
      nodal_force[component] += force_impulse / dt;
      work -= impulse * velocity;
    }

    /** Keeps what a face's account has become in a step; without accounts nothing is kept. */
    virtual void keep(const unsigned int /* node */, const unsigned int /* axis */,
                      const typename Prescribed<dim>::Contact & /* contact */)
    {
    }

    /** What it remembers from one step to the next. */
    virtual void serialize(Archive & /* archive */, const Grid<dim> & /* grid */) {}

    /** Whether it acts in a step that ends at `time`. */
    bool acts(const double time) const;

    /** Throws EntryError for what it could not carry out in a run up to `end_time`. */
    virtual void check_before_start(const Grid<dim> & /* grid */, const double /* end_time */) const {}

    /** Its interval [time]. */
    double start() const { return start_time.empty() ? -std::numeric_limits<double>::infinity() : start_time[0]; }
    double end() const { return end_time.empty() ? std::numeric_limits<double>::infinity() : end_time[0]; }

    /** Where a box or a half space of nodes ends. */
    struct Edge
    {
      unsigned int axis;
      bool         is_upper; // nodes below it are meant
      double       position; // [length]
      std::string  entry;
    };
    std::vector<Edge> edges() const;

    /** This rank's nodes, active or not: of each boundary id, of each half space, and of the box. */
    const std::vector<std::vector<unsigned int>> &owned_nodes() const { return all_nodes; }

    /** The same of the named parts of a mesh's boundary. */
    const std::vector<BoundaryPart<dim>> &owned_parts() const { return all_parts; }

    /** True when it leaves the nodes of its faces free to slide along them. */
    virtual bool is_slip() const { return false; }

    /** Enters or takes away the faces on which its nodes slip, for each owned node. */
    void mark_slip(std::vector<BoxFaces> &faces) const;

    void parse_parameters(dealii::ParameterHandler &prm) override;

    /** Registers what it knows of the last step. */
    void add_to(Reduction &reduction)
    {
      reduction.sum(reaction);
      reduction.sum(nodal_force);
      reduction.sum(work);
    }

    // Of the last step: at this rank's nodes, then summed over all ranks.

    /** Force of the body on the condition, sum m (v_trial - v) / dt [force]. */
    dealii::Tensor<1, dim> reaction;
    /**
     * Forces of stress, body force and tractions on what it was the first to set [force]: the reaction but for what
     * the nodes' mass accelerates.
     */
    dealii::Tensor<1, dim> nodal_force;
    /** Work the condition did on the body [energy]. */
    double work = 0;

  protected:
    /** Empties its accounts: its interval has ended, or has not begun. */
    virtual void forget() {}

    virtual void prescribe(const double time, Grid<dim> &grid) = 0;

    /** Calls `body(i)` for all its active nodes. */
    template <class Body>
    void for_each_node(const Body &body) const
    {
      for (const auto &list : nodes)
        for (const unsigned int i : list)
          body(i);
      for (const auto &part : parts)
        for (const unsigned int i : part.nodes)
          body(i);
    }

    /** Sets a component of a node's velocity and records what it costs. */
    void set(const unsigned int i, const unsigned int component, const double velocity)
    {
      if (prescribed)
        return prescribed->hold(i, component, velocity);
      using Fields         = NodalFields<dim>;
      double      *node    = grid->fields[i];
      const double change  = velocity - node[Fields::velocity + component];
      const double impulse = -node[Fields::mass] * change;
      reaction[component] += impulse / dt;
      if (held->hold(i, component))
        nodal_force[component] += node[Fields::mass] * node[Fields::increment + component] / dt;
      work -= impulse * velocity;
      node[Fields::velocity + component] = velocity;
      node[Fields::increment + component] += change;
    }

    /**
     * Sets a component of a node's velocity and of its acceleration to zero. The body loses what the node's forces
     * would have given it, and not what its particles have brought there.
     */
    void arrest(const unsigned int i, const unsigned int component)
    {
      if (prescribed)
        return prescribed->hold(i, component, 0., /* is_symmetric = */ true);
      using Fields         = NodalFields<dim>;
      double      *node    = grid->fields[i];
      const double impulse = node[Fields::mass] * node[Fields::increment + component];
      reaction[component] += impulse / dt;
      if (held->hold(i, component))
        nodal_force[component] += impulse / dt;
      node[Fields::velocity + component]  = 0;
      node[Fields::increment + component] = 0;
    }

    /** Sets the component along a unit vector of a node's velocity and records what it costs. */
    void set(const unsigned int i, const dealii::Tensor<1, dim> &n, const double velocity);

    /** Sets the components of a node's velocity and of its acceleration along a unit vector to zero. */
    void arrest(const unsigned int i, const dealii::Tensor<1, dim> &n);

    /** Bears what a face has borne of the last transfer as a mirror; of several conditions the first has it. */
    void take_mirrored(const unsigned int face, Grid<dim> &grid);

    /** The same of all mirrors on its parts of a mesh's boundary, and of its half spaces in a mesh. */
    void take_mirrored(Grid<dim> &grid);

    Prescribed<dim>                       *prescribed = nullptr; // where velocities are solved for
    std::vector<unsigned int>              boundary_ids;
    std::vector<unsigned int>              faces; // 2 axis + side: boundary ids, and faces parallel to the half spaces
    std::vector<std::vector<unsigned int>> nodes; // active, of each of these; of the box in the last list
    std::vector<std::string>               boundaries; // names or numbers of a mesh's groups of faces
    std::vector<BoundaryPart<dim>>         parts;      // active nodes of these, with normals

  private:
    /** Finds the nodes of the named parts of a mesh's boundary. */
    void attach_parts(const Grid<dim> &grid);

    /** Leaves out the nodes where the formula does not hold. */
    void keep_where(const Grid<dim> &grid);

    /** Counts the component along n as held; returns whether it was free until now. */
    bool hold(const unsigned int i, const dealii::Tensor<1, dim> &n);

    /** Enters "x <= 0.1" into `faces` and `positions`. */
    void read_half_space(const std::string &text);

    std::vector<std::vector<unsigned int>> all_nodes; // owned
    std::vector<BoundaryPart<dim>>         all_parts; // the same
    std::vector<std::string>               half_spaces;
    std::vector<double>                    positions; // of their planes [length]
    std::vector<double>                    lower, upper;
    std::string                            where_text;
    ParsedCondition<dim>                   where;
    std::vector<double>                    start_time, end_time; // one number or none
    bool                                   is_box = true;        // the grid
    double                                 dt     = 0;
    Grid<dim>                             *grid   = nullptr;
    HeldComponents<dim>                   *held   = nullptr;
  };
} // namespace Talus

#pragma once

#include <talus/core/archive.h>
#include <talus/core/exceptions.h>
#include <talus/grid/boundary_part.h>
#include <talus/grid/nodal_fields.h>
#include <talus/grid/reach.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/parameter_acceptor.h>
#include <deal.II/distributed/tria_base.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/mapping.h>

#include <functional>
#include <string>

namespace Talus
{
  /** What look() finds among particles. */
  struct Found
  {
    std::vector<unsigned int> outside;                  // particles that have left the grid
    bool                      strays           = false; // one has come where this rank does not know all nodes
    bool                      needs_activation = false; // one has come where nodes are not active
  };

  /** A particle that lies in another rank's cell. */
  struct Leaver
  {
    unsigned int particle;
    unsigned int rank;  // `none` where no rank's cell holds it
    unsigned int place; // there, where particles keep their places
  };

  /**
   * The background grid: cells shared out over the ranks by deal.II, their vertices as nodes, and what the nodes carry.
   * A node's number is its degree of freedom in a linear element.
   *
   * Where a particle lies is a *place*: one number that says where its stencil begins. Whatever hangs on it - order in
   * memory, migration, which nodes are active - is a function of the place, and how it is found differs from grid to
   * grid: by arithmetic on a box, by a walk from cell to cell on a mesh, for which particles then keep their places.
   */
  template <int dim>
  class Grid : public dealii::ParameterAcceptor
  {
  public:
    using CellIterator = typename dealii::Triangulation<dim>::active_cell_iterator;
    using Points       = std::array<const double *, dim>; // a column for each coordinate
    using Columns      = std::array<double *, dim>;
    using CellWeight   = std::function<unsigned int(const CellIterator &)>;

    static constexpr unsigned int none = static_cast<unsigned int>(-1);

    /**
     * Builds triangulation, nodes and fields for what kernels and transfers ask for. `weight` estimates a cell's work
     * (its number of particles); the ranks' shares are balanced by it. Collective.
     */
    virtual void create(const CellWeight &weight, const Reach &reach) = 0;

    /**
     * Shares the cells out anew by the numbers of particles in them: centre and number of each cell that has any, each
     * rank those of its cells at least. Nodes then have other numbers, places are other ones. Collective.
     */
    virtual void repartition(const std::vector<double> &counts) = 0;

    // Of particles, block by block.

    /** Whether particles keep their places; if not, `place` of the functions below is not read and may be null. */
    virtual bool keeps_places() const { return false; }

    /** All places are below this number. */
    virtual std::size_t n_places() const = 0;

    /**
     * Looks where the points begin .. end - 1 have come, and brings their places up to date; what is beyond a face by
     * round-off is put on it.
     */
    virtual void look(const Columns &x, const unsigned int begin, const unsigned int end, unsigned int *place,
                      Found &found) const = 0;

    /** Their places; `none` where this rank does not know all nodes of the stencil. */
    virtual void places(const Points &x, const unsigned int *place, const unsigned int begin, const unsigned int end,
                        unsigned int *result) const = 0;

    /** Those of the n points that lie in other ranks' cells. Collective. */
    virtual std::vector<Leaver> leavers(const Points &x, const unsigned int *place, const unsigned int n) const = 0;

    /**
     * Makes active what material may reach: all nodes of stencils that begin where `is_used`, on any rank, and some
     * nodes more on each side. Empty space then costs nothing. Fields of nodes that are no longer active become zero,
     * and no others are touched. Collective.
     */
    virtual void activate(const std::vector<char> &is_used) = 0;

    /** Whether activate() would find nothing new in a stencil that begins here, as far as this rank knows. */
    virtual bool is_active_around(const unsigned int place) const = 0;

    /** Which nodes are active. Collective. */
    void serialize(Archive &archive);

    /** A few numbers that tell this rank's share of the grid from any other. */
    std::vector<double> share() const;

    // For set-up and messages.

    virtual dealii::Point<dim> node_position(const unsigned int node) const = 0;

    /** Whether a point lies in the domain, as far as this rank knows. */
    virtual bool contains(const dealii::Tensor<1, dim> &x) const = 0;

    /** A number for the cell that holds a point, the same for all points in it and for no others nearby. */
    virtual std::size_t cell_number(const dealii::Point<dim> &x) const = 0;

    /** x on the unit cell. */
    virtual dealii::Point<dim> unit_point(const CellIterator &cell, const dealii::Point<dim> &x) const
    {
      return mapping.transform_real_to_unit_cell(cell, x);
    }

    /** x, moved off the faces of its cell, on which deal.II may lose a particle. */
    virtual dealii::Point<dim> inside_cell(const dealii::Point<dim> &x) const { return x; }

    /** A box that holds a cell, and what lies on its faces by round-off. */
    virtual dealii::BoundingBox<dim> cell_box(const CellIterator &cell) const = 0;

    /**
     * The local nodes at the corners of each of this rank's cells in the order of deal.II: of the cells whose nodes are
     * all active, or of all.
     */
    using CellNodes                                                    = std::array<unsigned int, (1 << dim)>;
    virtual std::vector<CellNodes> cells(const bool only_active) const = 0;
    virtual dealii::ReferenceCell  cell_type() const                   = 0;

    /**
     * Puts x on the faces of the domain from which round-off has taken it. False where x lies farther out, or where
     * this rank knows no cell that holds it.
     */
    virtual bool enter(dealii::Tensor<1, dim> &x) const = 0;

    /** The share of a particle at `x` that lies in the domain, for a body that the domain's faces cut. Moves x as
     * enter(). */
    virtual double share_inside(dealii::Point<dim> &x) const = 0;

    /** Whether points lie in the domain, each rank asks for its own. Collective. */
    virtual std::vector<bool> are_inside(const std::vector<dealii::Point<dim>> &points) const = 0;

    /** Where the grid lies, for messages: "which reaches from .. to ..". */
    virtual std::string extent() const = 0;

    /** Its size, for the summary: "10 x 10 cells". */
    virtual std::string summary() const = 0;

    /** A part of the boundary by its name or number. Throws InputError with those there are. */
    virtual BoundaryPart<dim> boundary(const std::string &name) const = 0;

    /** Owned nodes in the closed box. */
    std::vector<unsigned int> nodes_in_box(const dealii::Point<dim> &lower, const dealii::Point<dim> &upper) const;

    // In every step.

    /** Zeros the active nodes and all copies; the others are zero. */
    void clear();

    /** Eqs. (20)-(21) of the active nodes: v_i += dt f_i / m_i where m_i > `mass_floor`; elsewhere v_i = 0. */
    void update_velocity(const double dt) { update_velocity(dt, active_nodes); }

    /** The same of some of this rank's nodes. */
    void update_velocity(const double dt, const std::vector<unsigned int> &some);

    /** Owned nodes that are active, in ascending order; at first all. */
    std::vector<unsigned int> active_nodes;
    std::vector<bool>         is_active; // of each local node

    /** How many local nodes the last activate() has switched on or off; it writes to no others. */
    unsigned int n_changed_nodes = 0;

    Communicator                              communicator;
    dealii::parallel::TriangulationBase<dim> &triangulation;
    dealii::DoFHandler<dim>                  &dof_handler;
    const dealii::Mapping<dim>               &mapping;
    Nodes                                     nodes;
    NodalFields<dim>                          fields;

    /**
     * Nodes of at most this mass [mass] are empty; what they held of momentum and
     * impulse in the last step is counted as lost. The impulse counts most: towards
     * the end of a B-spline's support its gradient is far larger than its value.
     */
    double                 mass_floor = 0;
    dealii::Tensor<1, dim> lost_momentum;

    /** What the user should be told of it before the run takes its memory. */
    std::vector<EntryError> remarks;

    dealii::Point<dim> lower, upper; // of a box around the domain

    /** The distance of nodes along each axis, on a mesh about that, and its inverse: steps are measured by it. */
    std::array<double, dim> spacing, inverse_spacing;
    double                  smallest_spacing = 0, largest_spacing = 0;

    /** Whether x lies in an interval that a user wrote: its ends have a tolerance of 1e-6 spacings. */
    bool is_between(const double x, const double lower, const double upper, const unsigned int d) const
    {
      const double tolerance = 1e-6 * spacing[d];
      return x >= lower - tolerance && x <= upper + tolerance;
    }

    /** Square of the length of a cell's diagonal, or about that. */
    double diagonal_square() const
    {
      double sum = 0;
      for (const double h : spacing)
        sum += h * h;
      return sum;
    }

  protected:
    /** What deal.II makes of the grid belongs to the derived class. */
    Grid(const std::string &section, const Communicator &communicator,
         dealii::parallel::TriangulationBase<dim> &triangulation, dealii::DoFHandler<dim> &dof_handler,
         const dealii::Mapping<dim> &mapping);

    /** The weight of cells by numbers of particles in the form that repartition() has. */
    CellWeight weight_by(const std::vector<double> &counts) const;

    /** Sets marks of local nodes that any rank has set. Collective. */
    void spread(std::vector<char> &of_nodes);

    /** Makes active, and no others, the nodes on which `is_reached`, of each local node, holds on any rank. Collective.
     */
    void activate_nodes(std::vector<char> is_reached);

    void activate_all();

    /** Called when the active nodes have changed. */
    virtual void active_nodes_changed() {}

  private:
    void collect_active_nodes();
  };
} // namespace Talus

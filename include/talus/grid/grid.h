#pragma once

#include <talus/grid/lattice.h>
#include <talus/grid/nodal_fields.h>
#include <talus/grid/reach.h>

#include <deal.II/base/parameter_acceptor.h>
#include <deal.II/distributed/tria.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>

namespace Talus
{
  /**
   * The background grid: a box of equal cells, refined from a small coarse mesh
   * and partitioned by p4est. A node is a vertex; its number is its degree of
   * freedom in FE_Q(1), within a rank lexicographic, so that neighbours along x
   * are neighbours in memory.
   */
  template <int dim>
  class Grid : public dealii::ParameterAcceptor
  {
  public:
    using CellIterator = typename dealii::Triangulation<dim>::active_cell_iterator;

    Grid(const std::string &section, const Communicator &communicator);

    /**
     * Builds triangulation, nodes, lattice and fields for what kernels and transfers ask for. `weight` estimates
     * a cell's work (its number of particles); the ranks' shares are balanced by it. Collective.
     */
    void create(const std::function<unsigned int(const CellIterator &)> &weight, const Reach &reach);

    /** Sets up the triangulation's extents alone; called by create(). */
    void parse_parameters(dealii::ParameterHandler &prm) override;

    /** Zeros the active nodes and all copies; the others are zero. */
    void clear();

    /** Eqs. (20)-(21) of the active nodes: v_i += dt f_i / m_i where m_i > `mass_floor`; elsewhere v_i = 0. */
    void update_velocity(const double dt) { update_velocity(dt, active_nodes); }

    /** The same of some of this rank's nodes. */
    void update_velocity(const double dt, const std::vector<unsigned int> &some);

    /**
     * Makes active what material may reach: all nodes i with `first` true at one of the lattice indices
     * i - n .. i + 1 of every axis, on any rank: the stencils of n nodes and one node more on each side.
     * Empty space then costs nothing. `first` is a table like those of the lattice. Collective.
     */
    void activate(const std::vector<char> &first, const unsigned int n);

    /** Whether activate() would find nothing new in a stencil that begins at `first`, as far as this rank knows. */
    bool is_active_around(const typename Lattice<dim>::Index &first, const unsigned int n) const;

    /**
     * Tells the lattice where stencils of n nodes per axis meet slip walls; `faces` has for each owned node those on
     * which it slips. Collective.
     */
    void set_slip_walls(const std::vector<typename Lattice<dim>::Faces> &faces, const unsigned int n);

    /** Owned nodes that are active, in ascending order; at first all. */
    std::vector<unsigned int> active_nodes;
    std::vector<bool>         is_active; // of each local node

    dealii::Point<dim> node_position(const unsigned int node) const;

    /** Whether a point lies in the domain. */
    bool contains(const dealii::Tensor<1, dim> &x) const
    {
      for (unsigned int d = 0; d < dim; ++d)
        if (!lattice.is_inside(lattice.coordinate(x[d], d), d))
          return false;
      return true;
    }

    /** Owned nodes on the faces of the box with number `boundary_id` (2 d: lower, 2 d + 1: upper face of axis d). */
    std::vector<unsigned int> nodes_on_boundary(const unsigned int boundary_id) const;

    /** Owned nodes in the closed box; see Lattice::is_between(). */
    std::vector<unsigned int> nodes_in_box(const dealii::Point<dim> &lower, const dealii::Point<dim> &upper) const;

    const CellIterator &owned_cell(const unsigned int active_cell_index) const { return cells[active_cell_index]; }

    Communicator                                      communicator;
    dealii::parallel::distributed::Triangulation<dim> triangulation;
    dealii::DoFHandler<dim>                           dof_handler;
    Lattice<dim>                                      lattice;
    Nodes                                             nodes;
    NodalFields<dim>                                  fields;
    std::vector<typename Lattice<dim>::Index>         node_index; // lattice index of each local node

    /**
     * Nodes of at most this mass [mass] are empty; what they held of momentum and
     * impulse in the last step is counted as lost. The impulse counts most: towards
     * the end of a B-spline's support its gradient is far larger than its value.
     */
    double                 mass_floor = 0;
    dealii::Tensor<1, dim> lost_momentum;

    dealii::Point<dim> lower, upper;

  private:
    /** Throws EntryError where the cells need more memory than there is, and says what much of it they need. Collective. */
    void check_memory() const;

    void create_triangulation(const std::function<unsigned int(const CellIterator &)> &weight);
    void number_nodes();
    void fill_tables(const unsigned int n_layers);

    /**
     * What deal.II does not tell of the cells beyond this rank's ghost cells, which are the first layer, their owners
     * do: of two layers at least who owns them, and of `n_layers` the numbers of their nodes. The owner is who a
     * particle that goes farther is sent to; with the nodes, particles whose stencils reach farther can be kept.
     */
    void learn_layers(const unsigned int n_layers, std::vector<dealii::types::global_dof_index> &dofs,
                      dealii::IndexSet &known);

    void collect_active_nodes();

    dealii::FE_Q<dim>         fe;
    std::vector<CellIterator> cells;

    std::vector<double>       lower_corner, upper_corner, spacing;
    std::vector<unsigned int> cell_counts;
  };
} // namespace Talus

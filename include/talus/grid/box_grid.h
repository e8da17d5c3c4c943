#pragma once

#include <talus/grid/grid.h>
#include <talus/grid/lattice.h>

#include <deal.II/distributed/tria.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/mapping_cartesian.h>

#include <optional>

namespace Talus
{
  /** What deal.II has of a box; a base class, so that it is there before the grid refers to it. */
  template <int dim>
  struct BoxTriangulation
  {
    explicit BoxTriangulation(MPI_Comm communicator);

    dealii::parallel::distributed::Triangulation<dim> p4est;
    dealii::FE_Q<dim>                                 fe;
    dealii::DoFHandler<dim>                           dofs;
    dealii::MappingCartesian<dim>                     cartesian;
  };

  /**
   * A box of equal cells, refined from a small coarse mesh and partitioned by
   * p4est. Nodes are numbered lexicographically within a rank, so that neighbours
   * along x are neighbours in memory. A place is an entry of the lattice's tables.
   */
  template <int dim>
  class BoxGrid : private BoxTriangulation<dim>, public Grid<dim>
  {
  public:
    using typename Grid<dim>::CellIterator;
    using typename Grid<dim>::CellWeight;
    using typename Grid<dim>::Points;
    using typename Grid<dim>::Columns;
    using typename Grid<dim>::CellNodes;
    using Grid<dim>::none;
    using Grid<dim>::communicator;
    using Grid<dim>::dof_handler;
    using Grid<dim>::nodes;
    using Grid<dim>::fields;
    using Grid<dim>::is_active;
    using Grid<dim>::lower;
    using Grid<dim>::upper;

    BoxGrid(const std::string &section, const Communicator &communicator);

    /** Sets up the box's extents alone. */
    void parse_parameters(dealii::ParameterHandler &prm) override;

    void create(const CellWeight &weight, const Reach &reach) override;
    void repartition(const std::vector<double> &counts) override;

    std::size_t n_places() const override { return lattice.node.size(); }
    void        look(const Columns &x, const unsigned int begin, const unsigned int end, unsigned int *place,
                     Found &found) const override;
    void        places(const Points &x, const unsigned int *place, const unsigned int begin, const unsigned int end,
                       unsigned int *result) const override;
    std::vector<Leaver> leavers(const Points &x, const unsigned int *place, const unsigned int n) const override;
    void                activate(const std::vector<char> &is_used) override { activate(is_used, reach.n); }
    bool                is_active_around(const unsigned int place) const override
    {
      return is_active_around(lattice.table_entry(place), reach.n);
    }

    dealii::Point<dim> node_position(const unsigned int node) const override;
    bool               contains(const dealii::Tensor<1, dim> &x) const override;
    std::size_t        cell_number(const dealii::Point<dim> &x) const override;
    dealii::Point<dim> inside_cell(const dealii::Point<dim> &x) const override { return lattice.inside_cell(x); }
    bool               enter(dealii::Tensor<1, dim> &x) const override { return lattice.enter(x); }
    double             share_inside(dealii::Point<dim> &x) const override { return lattice.share_inside(x); }

    dealii::BoundingBox<dim> cell_box(const CellIterator &cell) const override;
    std::vector<CellNodes>   cells(const bool only_active) const override;
    dealii::ReferenceCell    cell_type() const override { return dealii::ReferenceCells::get_hypercube<dim>(); }
    std::vector<bool>        are_inside(const std::vector<dealii::Point<dim>> &points) const override;
    std::string              extent() const override;
    std::string              summary() const override;

    /** The face of the box with this number. */
    BoundaryPart<dim> boundary(const std::string &number) const override;

    /**
     * All nodes i with `first` true at one of the lattice indices i - n .. i + 1 of every axis, on any rank: the
     * stencils of n nodes and one node more on each side. `first` is a table like those of the lattice. Collective.
     */
    void activate(const std::vector<char> &first, const unsigned int n);

    /** Whether activate() would find nothing new in a stencil that begins at `first`, as far as this rank knows. */
    bool is_active_around(const typename Lattice<dim>::Index &first, const unsigned int n) const;

    /**
     * Tells the lattice where stencils of n nodes per axis meet slip walls; `faces` has for each owned node those on
     * which it slips. Collective.
     */
    void set_slip_walls(const std::vector<BoxFaces> &faces, const unsigned int n);

    /** Owned nodes on the faces of the box with number `boundary_id` (2 d: lower, 2 d + 1: upper face of axis d). */
    std::vector<unsigned int> nodes_on_boundary(const unsigned int boundary_id) const;

    /** Calls `body(node, weight)` for the corners of the cell around x that this rank knows, weighted by hats. */
    template <class Body>
    void for_each_corner(const dealii::Tensor<1, dim> &x, const Body &body) const
    {
      for_each_near<2>(
        x, 0.,
        [](const double s, double *weight) {
          weight[0] = 1 - s;
          weight[1] = s;
        },
        body);
    }

    /** The same for the nodes of a quadratic B-spline around x. */
    template <class Body>
    void for_each_around(const dealii::Tensor<1, dim> &x, const Body &body) const
    {
      for_each_near<3>(
        x, 0.5,
        [](const double s, double *weight) {
          weight[0] = 0.5 * (1.5 - s) * (1.5 - s);
          weight[1] = 0.75 - (s - 1) * (s - 1);
          weight[2] = 0.5 * (s - 0.5) * (s - 0.5);
        },
        body);
    }

    /** Whether a node lies on a face of another axis. */
    bool is_on_other_face(const unsigned int node, const unsigned int axis) const
    {
      for (unsigned int d = 0; d < dim; ++d)
        if (d != axis && (node_index[node][d] == 0 || node_index[node][d] == lattice.n_cells[d]))
          return true;
      return false;
    }

    /** The line of nodes nearest to the coordinate x along an axis, and x less it in spacings; none outside the box. */
    std::optional<std::pair<double, double>> nearest_line(const double x, const unsigned int axis) const
    {
      const double c = lattice.coordinate(x, axis), line = std::round(c);
      if (!(line >= 0 && line <= lattice.n_cells[axis]))
        return {};
      return std::make_pair(lattice.node_position(static_cast<int>(line), axis), c - line);
    }

    /** Whether the cell above a place of the lattice is this rank's. */
    bool owns_cell(const unsigned int place) const { return lattice.owner[place] == my_rank; }

    Lattice<dim>                              lattice;
    std::vector<typename Lattice<dim>::Index> node_index; // lattice index of each local node
    std::vector<char>                         coverage;   // places from which on all nodes within reach are known

  private:
    /** Nodes of stencils of n per axis that begin at floor(coordinate - shift), with the weights of each axis. */
    template <unsigned int n, class Weights, class Body>
    void for_each_near(const dealii::Tensor<1, dim> &x, const double shift, const Weights &weights,
                       const Body &body) const
    {
      typename Lattice<dim>::Index first;
      double                       of_axis[dim][n];
      for (unsigned int d = 0; d < dim; ++d)
      {
        const double c = lattice.coordinate(x[d], d);
        first[d]       = static_cast<int>(std::floor(c - shift));
        weights(c - first[d], of_axis[d]);
      }
      for_each_index(first, n, [&](const auto &index) {
        const unsigned int node = lattice.node_at(index);
        if (node == lattice.missing)
          return;
        double weight = 1;
        for (unsigned int d = 0; d < dim; ++d)
          weight *= of_axis[d][index[d] - first[d]];
        body(node, weight);
      });
    }

    /** Throws EntryError where the cells need more memory than there is, and says what much of it they need.
     * Collective. */
    void check_memory();

    void create_triangulation();
    void share_out(const CellWeight &weight);
    void number_nodes();
    void fill_tables(const unsigned int n_layers);

    /**
     * What deal.II does not tell of the cells beyond this rank's ghost cells, which are the first layer, their owners
     * do: of two layers at least who owns them, and of `n_layers` the numbers of their nodes. The owner is who a
     * particle that goes farther is sent to; with the nodes, particles whose stencils reach farther can be kept.
     */
    void learn_layers(const unsigned int n_layers, std::vector<dealii::types::global_dof_index> &dofs,
                      dealii::IndexSet &known);

    /** Puts a particle back on the faces of the domain from which round-off has taken it. */
    void put_on_face(const Columns &x, const unsigned int p) const;

    /** Sets the ranks of leavers that this rank does not know. Collective. */
    void find_far_ranks(const Points &x, std::vector<Leaver> &leavers) const;

    Reach        reach;
    unsigned int my_rank            = 0;
    bool         knows_all_stencils = false; // this rank has the nodes of every stencil in the domain

    std::vector<double>       lower_corner, upper_corner, spacings;
    std::vector<unsigned int> cell_counts;
  };

  /** The grid as a box. Throws EntryError of that entry where it is none. */
  template <int dim>
  BoxGrid<dim> &box_grid(Grid<dim> &grid, const std::string &section, const std::string &entry);
  template <int dim>
  const BoxGrid<dim> &box_grid(const Grid<dim> &grid, const std::string &section, const std::string &entry);
} // namespace Talus

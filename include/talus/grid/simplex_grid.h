#pragma once

#include <talus/grid/grid.h>
#include <talus/grid/mesh_partition.h>

#include <deal.II/fe/mapping_fe.h>

#include <map>

namespace Talus
{
  /** The mesh in parts and its mapping; a base class, so that they are there before the grid refers to them. */
  template <int dim>
  struct SimplexTriangulation
  {
    explicit SimplexTriangulation(MPI_Comm communicator) : partition(communicator), affine(partition.fe) {}

    MeshPartition<dim>     partition;
    dealii::MappingFE<dim> affine;
  };

  /**
   * A mesh of triangles or tetrahedra, from a file of gmsh or generated, shared out over the ranks. A place is a local
   * cell: particles keep it, and walk on from it. Those of a rank lie in its own cells, whose rings are complete; one
   * that enters another rank's cell migrates. Test: tests/mesh/simplex_grid.cc.
   */
  template <int dim>
  class SimplexGrid : private SimplexTriangulation<dim>, public Grid<dim>
  {
  public:
    using typename Grid<dim>::CellWeight;
    using typename Grid<dim>::Points;
    using typename Grid<dim>::CellIterator;
    using typename Grid<dim>::Columns;
    using typename Grid<dim>::CellNodes;
    using Grid<dim>::none;
    using Grid<dim>::communicator;
    using Grid<dim>::fields;

    SimplexGrid(const std::string &section, const Communicator &communicator);

    void parse_parameters(dealii::ParameterHandler &prm) override;

    void create(const CellWeight &weight, const Reach &reach) override;
    void repartition(const std::vector<double> &counts) override;

    bool        keeps_places() const override { return true; }
    std::size_t n_places() const override { return mesh().n_cells(); }
    void        look(const Columns &x, const unsigned int begin, const unsigned int end, unsigned int *place,
                     Found &found) const override;
    void        places(const Points &x, const unsigned int *place, const unsigned int begin, const unsigned int end,
                       unsigned int *result) const override;
    std::vector<Leaver> leavers(const Points &x, const unsigned int *place, const unsigned int n) const override;
    void                activate(const std::vector<char> &is_used) override;
    bool                is_active_around(const unsigned int place) const override { return is_open[place] != 0; }

    /** Its barycentric coordinates. */
    dealii::Point<dim> unit_point(const CellIterator &cell, const dealii::Point<dim> &x) const override;

    dealii::Point<dim> node_position(const unsigned int node) const override;
    bool               contains(const dealii::Tensor<1, dim> &x) const override;

    /** The local cell, or `none`. */
    std::size_t cell_number(const dealii::Point<dim> &x) const override;

    dealii::BoundingBox<dim> cell_box(const CellIterator &cell) const override;
    std::vector<CellNodes>   cells(const bool only_active) const override;
    dealii::ReferenceCell    cell_type() const override { return dealii::ReferenceCells::get_simplex<dim>(); }

    /** Moves nothing: what is outside by round-off belongs to a cell nevertheless. */
    bool enter(dealii::Tensor<1, dim> &x) const override { return contains(x); }

    /**
     * The share of a small ball around x that lies in the mesh, for a body that its boundary cuts: a half on a plane
     * face, a quarter on the edge between two of a box; 0 where no cell of this rank holds x.
     */
    double share_inside(dealii::Point<dim> &x) const override;

    std::vector<bool> are_inside(const std::vector<dealii::Point<dim>> &points) const override;
    std::string       extent() const override;
    std::string       summary() const override;
    BoundaryPart<dim> boundary(const std::string &name) const override;

    const Mesh<dim> &mesh() const { return this->partition.mesh; }

  private:
    MeshInput<dim> read() const;
    void           hold_boundaries();
    void           mirror_boundaries();

    /** A group of faces by name or number. Throws InputError with those there are. */
    typename MeshInput<dim>::Group group(const std::string &name) const;

    /** Marks of this rank's nodes on a part of the boundary that `entry` names. */
    std::vector<char> nodes_on(const std::string &name, const std::string &entry) const;

    typename Mesh<dim>::Mirror find_mirror(const std::string &name, const std::string &entry,
                                           const std::vector<char> &is_on) const;
    void                       number_nodes();

    /** Marks of nodes in the order of the nodes' numbers, from those in the order of the mesh, and the other way. */
    std::vector<char> by_number(const std::vector<char> &of_places) const;
    std::vector<char> by_place(const std::vector<char> &of_nodes) const;

    void find_extent();

    /** Cells of this rank all of whose stencil's nodes are active. */
    void find_open_cells();
    void active_nodes_changed() override { find_open_cells(); }

    std::vector<char>                    is_open;
    std::map<unsigned int, unsigned int> mirrored_faces; // of groups, see BoundaryPart

    std::string               file;
    std::vector<double>       lower_corner, upper_corner, spacings;
    std::vector<unsigned int> cell_counts;
    std::vector<std::string>  held_boundaries, slip_mirrors, no_slip_mirrors;
    double                    ratio = 1;
  };

  /** The grid as a mesh. Throws EntryError of that entry where it is none. */
  template <int dim>
  const SimplexGrid<dim> &simplex_grid(const Grid<dim> &grid, const std::string &section, const std::string &entry);
} // namespace Talus

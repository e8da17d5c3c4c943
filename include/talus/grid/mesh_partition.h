#pragma once

#include <talus/grid/mesh_input.h>
#include <talus/grid/mesh_walk.h>

#include <deal.II/distributed/fully_distributed_tria.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_simplex_p.h>

#include <functional>
#include <memory>
#include <vector>

namespace Talus
{
  /** Shares the cells of a mesh out by halving, across the longest side each time; parts of equal weight. */
  template <int dim>
  std::vector<unsigned int> partition_by_halves(const MeshInput<dim> &input, const std::vector<double> &weights,
                                                const unsigned int n_parts);

  /**
   * A simplex mesh in parts. A rank knows its own cells, which come first in `mesh`, and all that touch them at a
   * vertex (deal.II's ghost cells): the rings of its own cells are complete. The vertices are the degrees of freedom of
   * FE_SimplexP(1). Every call but find() is collective. Test: tests/mesh/parts.cc.
   */
  template <int dim>
  class MeshPartition
  {
  public:
    explicit MeshPartition(MPI_Comm communicator);

    using Weight = std::function<double(const typename dealii::Triangulation<dim>::active_cell_iterator &)>;

    /**
     * The root alone calls `read` and holds the whole mesh, for a while; what it throws, an InputError, is thrown on
     * all ranks. On several ranks the root asks for the `weight` of each cell, and `mesh` and find_here() are those of
     * the whole as long as it does; none: all are equal.
     */
    void create(const std::function<MeshInput<dim>()> &read, const Weight &weight = {});

    /** The cell of a point: its rank, and its number there. */
    struct Location
    {
      unsigned int rank, cell;
      bool         is_found;

      template <class Archive>
      void serialize(Archive &archive, const unsigned int)
      {
        archive &rank &cell &is_found;
      }
    };

    /** Where x lies that was in the local cell `cell`; not found when it has left all that this rank knows. */
    Location find_from(const unsigned int cell, const double *x) const { return locate(finder->find_from(cell, x)); }

    /** The local cell that holds x, or Mesh::missing. */
    unsigned int find_here(const double *x) const { return finder->find(x); }

    /** The same for any points, each rank asks for its own; those not found lie outside the mesh. Collective. */
    std::vector<Location> find(const std::vector<typename Mesh<dim>::Vector> &points) const;

    dealii::parallel::fullydistributed::Triangulation<dim> triangulation;
    dealii::FE_SimplexP<dim>                               fe;
    dealii::DoFHandler<dim>                                dof_handler;

    Mesh<dim>                                    mesh;
    unsigned int                                 n_owned_cells = 0;
    std::vector<dealii::types::global_dof_index> node_numbers; // by local node
    std::vector<typename MeshInput<dim>::Group>  groups;       // of boundary faces, the same on all ranks

  private:
    void     fill_tables();
    void     find_owners();
    Location locate(const unsigned int cell) const
    {
      if (cell == mesh.missing)
        return {0, 0, false};
      return {mesh.owner[cell], mesh.number[cell], true};
    }

    const MPI_Comm                   communicator;
    std::unique_ptr<CellFinder<dim>> finder;
    std::vector<GrowingBox<dim>>     boxes; // of each rank's own cells
  };
} // namespace Talus

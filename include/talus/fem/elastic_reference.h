#pragma once

#include <talus/core/parameters.h>
#include <talus/fem/box_mesh.h>
#include <talus/fem/displacement_conditions.h>

#include <deal.II/base/function.h>
#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/distributed/tria.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/mapping_q1.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/la_parallel_vector.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <memory>
#include <string>
#include <vector>

namespace Talus
{
  /**
   * A finite element reference: the static, linear elastic body at small strains
   * @f[ -\nabla\cdot\sigma = f, \quad \sigma = K\, \mathrm{tr}\,\varepsilon\, I + 2 G\, \mathrm{dev}\,\varepsilon,
   *     \quad \varepsilon = \nabla^s u , @f]
   * on a box with prescribed displacements on its faces; plane strain in 2D.
   *
   * Q1 or Q2 elements on a uniform mesh of its own. It knows no particle, so that
   * it is independent of what it is compared with. Displacement elements lock
   * when the body is nearly incompressible: K/G above 50 (Poisson's ratio .49) is
   * rejected. Every call is collective.
   *
   * Throws InputError (moduli, box, a body that is free to move, a point outside,
   * an unknown condition) and RunError (the solver does not converge).
   * Theory: doc/fem_reference.md. Test: tests/fem/.
   */
  template <int dim>
  class ElasticReference : public dealii::ParameterAcceptor
  {
  public:
    ElasticReference(Parameters &parameters, const std::string &section, const MPI_Comm communicator = MPI_COMM_WORLD);

    /** K and G [stress]. */
    void set_moduli(const double bulk_modulus, const double shear_modulus);

    /** Force per volume with `dim` components, at rest; none when never called. */
    void set_body_force(std::shared_ptr<const dealii::Function<dim>> body_force);

    /** Solves with the conditions as they are at `time`. */
    void solve(const double time);

    /** u at any points of the box [length]; each rank may ask for its own. */
    std::vector<dealii::Tensor<1, dim>> displacement(const std::vector<dealii::Point<dim>> &points) const;

    /** Cauchy stress, tension positive, the same way; the mean of the cells around a point on their border. */
    std::vector<dealii::SymmetricTensor<2, 3>> stress(const std::vector<dealii::Point<dim>> &points) const;

    /**
     * Force of the body *on* a condition [force, per thickness in 2D]: minus the sum of the residual
     * @f$ \int \sigma : \nabla^s N_i - f \cdot N_i @f$ over the condition's degrees of freedom.
     * One that several conditions prescribe belongs to the last of them.
     */
    dealii::Tensor<1, dim> force(const std::string &condition) const;

    /** Whether a condition of this name exists. */
    bool has_condition(const std::string &condition) const;

  private:
    using Vector = dealii::LinearAlgebra::distributed::Vector<double>;

    void   make_mesh();
    void   compute_cell_matrix();
    void   assemble();
    void   solve_system();
    void   compute_residual();
    Vector new_vector() const;

    /** The points, moved onto the box when round-off put them outside. Throws on all ranks when one is outside. */
    std::vector<dealii::Point<dim>> checked(const std::vector<dealii::Point<dim>> &points) const;

    const MPI_Comm communicator;

    BoxMesh<dim>                                 box;
    DisplacementConditions<dim>                  conditions;
    unsigned int                                 degree = 2;
    double                                       K = 0., G = 0.;
    std::shared_ptr<const dealii::Function<dim>> body_force;

    dealii::parallel::distributed::Triangulation<dim> triangulation;
    dealii::MappingQ1<dim>                            mapping;
    std::unique_ptr<dealii::FESystem<dim>>            fe;
    dealii::DoFHandler<dim>                           dof_handler;
    dealii::AffineConstraints<double>                 constraints;
    dealii::FullMatrix<double>                        cell_matrix; // the same for all cells
    dealii::TrilinosWrappers::SparseMatrix            matrix;
    Vector                                            right_hand_side, load, solution, residual;
  };
} // namespace Talus

#pragma once

#include <talus/core/parameters.h>
#include <talus/fem/box_mesh.h>
#include <talus/fem/cell_strains.h>
#include <talus/fem/displacement_conditions.h>
#include <talus/fem/j2_law.h>

#include <deal.II/distributed/tria.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/mapping_q.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/la_parallel_vector.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace Talus
{
  /**
   * A finite element reference for plastic bodies: quasi-static equilibrium at small strains,
   * @f[ \int \sigma(\bar\varepsilon(u)) : \bar\varepsilon(v) = 0 , @f]
   * under displacements that grow with time, with the stress of J2Law; plane strain in 2D.
   *
   * Q2 elements with 3 Gauss points in each direction, B-bar strains (CellStrains). Newton's method with the
   * consistent tangent and a line search; where it does not converge, the step is halved. The mesh is a uniform box or
   * any other. It knows no particle and no material of a run. Every call is collective.
   *
   * Throws InputError (entries, a body that is free to move, an unknown condition) and RunError (no equilibrium is
   * found within the `limits`). Theory: doc/fem_reference.md. Test: tests/fem/.
   */
  template <int dim>
  class PlasticReference : public dealii::ParameterAcceptor
  {
  public:
    using Mesh = dealii::parallel::distributed::Triangulation<dim>;

    PlasticReference(Parameters &parameters, const std::string &section, const MPI_Comm communicator = MPI_COMM_WORLD);

    /** Another mesh than the box of the section; before solve(). Conditions name its boundary ids. */
    void set_mesh(const std::function<void(Mesh &)> &create);

    /** Loads the body from rest at time 0 to `end_time`; calls `report` with the time after each step, first at 0. */
    void solve(const double end_time, const std::function<void(double)> &report = {});

    /** Force of the body *on* a condition [force, per thickness in 2D], as in ElasticReference. */
    dealii::Tensor<1, dim> force(const std::string &condition) const { return conditions.force(condition, residual); }

    /** Mean of the displacements that a condition prescribes [length]. */
    dealii::Tensor<1, dim> mean_displacement(const std::string &condition) const
    {
      return conditions.mean_displacement(condition);
    }

    std::vector<std::string> condition_names() const { return conditions.names(); }

    /** Norm of the forces out of balance over that of all cell forces, after each iteration of the last step. */
    const std::vector<double> &imbalances() const { return imbalance_history; }

    /** How long Newton's method is tried. */
    struct Limits
    {
      unsigned int iterations     = 25;  // in one step
      unsigned int halvings       = 10;  // of a load step, one after the other
      unsigned int all_iterations = 500; // in one load step with all that it was halved into
      unsigned int all_halvings   = 40;
    };
    Limits limits;

    /** Iterations of all steps, and how often a step was halved. */
    unsigned int n_iterations() const { return iterations; }
    unsigned int n_halvings() const { return halvings; }

  private:
    using Vector = dealii::LinearAlgebra::distributed::Vector<double>;

    void set_up();

    /** Goes on to `time`, in shorter steps than `full_step` where necessary. */
    void advance(const double time, const double full_step);

    /** Newton's method; false when it does not converge. */
    bool find_equilibrium(const double time);
    void search_line(const Vector &increment);

    /** Adds a part of an increment to the solution and computes its residual and states. */
    void   move(const Vector &increment, const double factor);
    void   compute_residual();
    void   assemble(const dealii::AffineConstraints<double> &constraints);
    Vector solve_system(const dealii::AffineConstraints<double> &constraints) const;
    void   commit(const double time);

    /** Norm of the residual where no displacement is prescribed. */
    double free_force() const;
    Vector new_vector() const;

    /** Strain at a quadrature point of the cell that `strains` is set to. */
    dealii::SymmetricTensor<2, 3> strain_at(const unsigned int q, const dealii::Vector<double> &cell_solution) const;

    const MPI_Comm              communicator;
    BoxMesh<dim>                box;
    J2Law                       law;
    DisplacementConditions<dim> conditions;
    std::string                 integration = "B-bar";
    unsigned int                n_steps     = 20;

    Mesh                                   triangulation;
    dealii::MappingQ<dim>                  mapping;
    dealii::FESystem<dim>                  fe;
    dealii::DoFHandler<dim>                dof_handler;
    std::unique_ptr<CellStrains<dim>>      strains;
    std::vector<J2Law::State>              old_states, states; // by cell and quadrature point
    dealii::TrilinosWrappers::SparseMatrix matrix;
    Vector                                 right_hand_side, residual;
    Vector                                 solution, old_solution, older_solution;
    double                                 solved_time = 0., older_time = 0.;
    double                                 cell_forces = 0.; // root of the square sum over all cells
    std::vector<double>                    imbalance_history;
    unsigned int                           iterations = 0, halvings = 0;
  };
} // namespace Talus

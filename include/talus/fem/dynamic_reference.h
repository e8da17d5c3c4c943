#pragma once

#include <talus/core/parameters.h>
#include <talus/fem/box_mesh.h>
#include <talus/fem/displacement_conditions.h>
#include <talus/fem/neo_hookean_cells.h>

#include <deal.II/base/mpi_remote_point_evaluation.h>
#include <deal.II/distributed/tria.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/mapping_q1.h>
#include <deal.II/lac/la_parallel_vector.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace Talus
{
  /** Young's modulus, Poisson's ratio and density of a reference, apart from the materials of a run. */
  class ElasticSolid : public dealii::ParameterAcceptor
  {
  public:
    explicit ElasticSolid(const std::string &section);
    void parse_parameters(dealii::ParameterHandler &prm) override;

    double lambda() const
    {
      return youngs_modulus * poisson_ratio / ((1. + poisson_ratio) * (1. - 2. * poisson_ratio));
    }
    double mu() const { return youngs_modulus / (2. * (1. + poisson_ratio)); }

    double youngs_modulus = 1e6, poisson_ratio = 0.3, density = 1e3; // [stress], [1], [mass/volume]
  };

  /**
   * A finite element reference in motion, geometrically exact: a neo-Hookean box from rest,
   * @f[ \rho_0 \ddot u = \mathrm{Div}\, P(F) + \rho_0 b , @f]
   * with prescribed displacements and body forces per mass; plane strain in 2D.
   *
   * Q1 elements, or Q2 with nodes at Gauss-Lobatto points, on a uniform mesh of its own (NeoHookeanCells); mass lumped
   * at the nodes by that quadrature; central differences in time with a fixed step below the bound that the greatest
   * frequency of a cell gives. No damping. It knows no particle and no material of a run. Every call is collective.
   *
   * Throws InputError (entries, points outside) and RunError (energy is not conserved: it diverges).
   * Theory: doc/fem_reference.md. Test: tests/fem/dynamic.cc.
   */
  template <int dim>
  class DynamicReference : public dealii::ParameterAcceptor
  {
  public:
    using BodyForce = std::function<dealii::Tensor<1, dim>(const dealii::Point<dim> &x, const double time)>;

    DynamicReference(Parameters &parameters, const std::string &section, const MPI_Comm communicator = MPI_COMM_WORLD);

    void parse_parameters(dealii::ParameterHandler &prm) override;

    /** Another body force per mass than the formulas of the section. */
    void set_body_force(BodyForce new_body_force);

    /** Energies of the body, and the work done on it since the start [energy, per thickness in 2D]. */
    struct Energies
    {
      double kinetic = 0., strain = 0., work = 0.;
      double residual() const { return kinetic + strain - work; }
    };

    /** Moves the body from rest at time 0 to `end_time`; calls `report` with the time at the equally spaced rows. */
    void solve(const double end_time, const std::function<void(double)> &report = {});

    /** u at any points of the box [length]; each rank may ask for its own. */
    std::vector<dealii::Tensor<1, dim>> displacement(const std::vector<dealii::Point<dim>> &points) const;

    /** u at the points of the section. */
    std::vector<dealii::Tensor<1, dim>> displacements_at_points() const;

    const std::vector<dealii::Point<dim>> &history_points() const { return points; }
    const Energies                        &energies() const { return now; }
    double                                 step_size() const { return dt; }
    unsigned int                           n_steps() const { return steps_done; }

  private:
    using Vector = dealii::LinearAlgebra::distributed::Vector<double>;

    void   set_up();
    void   number_cells();
    void   find_held(const double time);
    void   compute_forces(const double time);
    void   update_velocity(const double time);
    void   add_work();
    void   update_energies(const double time);
    Vector new_vector() const;

    const MPI_Comm communicator;

    BoxMesh<dim>                    box;
    ElasticSolid                    solid;
    DisplacementConditions<dim>     conditions;
    unsigned int                    degree = 2, n_rows = 200;
    double                          courant_number = 0.8;
    std::string                     body_force_text;
    std::vector<dealii::Point<dim>> points;
    ParsedVector<dim>               parsed_body_force;
    BodyForce                       body_force;
    bool                            is_uniform = true; // the body force is the same everywhere

    dealii::parallel::distributed::Triangulation<dim> triangulation;
    dealii::MappingQ1<dim>                            mapping;
    std::unique_ptr<dealii::FESystem<dim>>            fe;
    dealii::DoFHandler<dim>                           dof_handler;
    NeoHookeanCells<dim>                              cells;

    // By local number: those of each cell, one after the other, and of this rank's own the node and the component.
    std::vector<unsigned int>       cell_dofs, components;
    std::vector<dealii::Point<dim>> positions;
    std::vector<unsigned int>       held;
    std::vector<double>             held_displacement; // at the end of the step

    Vector       displacement_now, velocity, old_velocity, mass, force, external, old_external;
    Energies     now;
    double       dt = 0., strain_energy_here = 0., work_here = 0., greatest_energy = 0.;
    unsigned int steps_done = 0;

    mutable dealii::Utilities::MPI::RemotePointEvaluation<dim> point_cache;
  };
} // namespace Talus

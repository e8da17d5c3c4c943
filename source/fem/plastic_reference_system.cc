#include <talus/fem/plastic_reference.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/grid/filtered_iterator.h>
#include <deal.II/lac/trilinos_solver.h>
#include <deal.II/lac/trilinos_sparsity_pattern.h>

#include <Amesos.h>

namespace Talus
{
  using namespace dealii;

  template <int dim>
  void PlasticReference<dim>::set_up()
  {
    if (triangulation.n_levels() == 0)
      box.create(triangulation);
    dof_handler.distribute_dofs(fe);
    strains = std::make_unique<CellStrains<dim>>(mapping, fe, QGauss<dim>(3), integration == "B-bar");
    states.assign(triangulation.n_active_cells() * strains->n_points, J2Law::State());
    old_states      = states;
    solution        = new_vector();
    old_solution    = new_vector();
    older_solution  = new_vector();
    residual        = new_vector();
    right_hand_side = new_vector();
    solved_time = older_time = 0.;
    iterations = halvings = 0;

    conditions.prescribe(mapping, dof_handler, 0.);
    TrilinosWrappers::SparsityPattern sparsity(dof_handler.locally_owned_dofs(), dof_handler.locally_owned_dofs(),
                                               DoFTools::extract_locally_relevant_dofs(dof_handler), communicator);
    DoFTools::make_sparsity_pattern(dof_handler, sparsity, conditions.constraints(), false,
                                    Utilities::MPI::this_mpi_process(communicator));
    sparsity.compress();
    matrix.reinit(sparsity);
  }

  template <int dim>
  typename PlasticReference<dim>::Vector PlasticReference<dim>::new_vector() const
  {
    return Vector(dof_handler.locally_owned_dofs(), DoFTools::extract_locally_relevant_dofs(dof_handler), communicator);
  }

  template <int dim>
  SymmetricTensor<2, 3> PlasticReference<dim>::strain_at(const unsigned int            q,
                                                         const dealii::Vector<double> &cell_solution) const
  {
    SymmetricTensor<2, 3> strain;
    for (unsigned int i = 0; i < strains->n_dofs; ++i)
      strain += cell_solution(i) * (*strains)(i, q);
    return strain;
  }

  template <int dim>
  void PlasticReference<dim>::compute_residual()
  {
    residual.zero_out_ghost_values();
    residual = 0.;

    double                               square = 0.;
    dealii::Vector<double>               cell_solution(strains->n_dofs), cell_force(strains->n_dofs);
    std::vector<types::global_dof_index> dofs(strains->n_dofs);
    for (const auto &cell : dof_handler.active_cell_iterators() | IteratorFilters::LocallyOwnedCell())
    {
      strains->reinit(cell);
      cell->get_dof_indices(dofs);
      cell->get_dof_values(solution, cell_solution);
      cell_force = 0.;
      for (unsigned int q = 0; q < strains->n_points; ++q)
      {
        const unsigned int point    = cell->active_cell_index() * strains->n_points + q;
        const auto         response = law.respond(strain_at(q, cell_solution), old_states[point]);
        states[point]               = response.state;
        for (unsigned int i = 0; i < strains->n_dofs; ++i)
          cell_force(i) += response.stress * (*strains)(i, q) * strains->JxW(q);
      }
      residual.add(dofs, cell_force);
      square += cell_force.norm_sqr();
    }
    residual.compress(VectorOperation::add);
    cell_forces = std::sqrt(Utilities::MPI::sum(square, communicator));
  }

  template <int dim>
  void PlasticReference<dim>::assemble(const AffineConstraints<double> &constraints)
  {
    matrix          = 0.;
    right_hand_side = 0.;

    const unsigned int                   n = strains->n_dofs;
    FullMatrix<double>                   cell_matrix(n, n);
    dealii::Vector<double>               cell_solution(n), cell_force(n);
    std::vector<SymmetricTensor<2, 3>>   stress(n);
    std::vector<types::global_dof_index> dofs(n);
    for (const auto &cell : dof_handler.active_cell_iterators() | IteratorFilters::LocallyOwnedCell())
    {
      strains->reinit(cell);
      cell->get_dof_indices(dofs);
      cell->get_dof_values(solution, cell_solution);
      cell_matrix = 0.;
      cell_force  = 0.;
      for (unsigned int q = 0; q < strains->n_points; ++q)
      {
        const unsigned int point   = cell->active_cell_index() * strains->n_points + q;
        const auto         strain  = strain_at(q, cell_solution);
        const auto         tangent = law.tangent(strain, old_states[point]);
        const auto         sigma   = law.respond(strain, old_states[point]).stress;
        for (unsigned int i = 0; i < n; ++i)
        {
          stress[i] = strains->JxW(q) * (tangent * (*strains)(i, q));
          cell_force(i) -= sigma * (*strains)(i, q) * strains->JxW(q);
        }
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int j = 0; j <= i; ++j)
            cell_matrix(i, j) += stress[i] * (*strains)(j, q);
      }
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = i + 1; j < n; ++j)
          cell_matrix(i, j) = cell_matrix(j, i);
      constraints.distribute_local_to_global(cell_matrix, cell_force, dofs, matrix, right_hand_side);
    }
    matrix.compress(VectorOperation::add);
    right_hand_side.compress(VectorOperation::add);
  }

  template <int dim>
  typename PlasticReference<dim>::Vector PlasticReference<dim>::solve_system(
    const AffineConstraints<double> &constraints) const
  {
    // At a limit load the tangent is close to singular, beyond it indefinite: a factorisation does not mind.
    const bool                                           has_mumps = Amesos().Query("Amesos_Mumps");
    const TrilinosWrappers::SolverDirect::AdditionalData data(false, has_mumps ? "Amesos_Mumps" : "Amesos_Klu");
    SolverControl                                        control;
    TrilinosWrappers::SolverDirect                       solver(control, data);
    Vector                                               increment = new_vector();
    solver.initialize(matrix);
    solver.solve(increment, right_hand_side);
    constraints.distribute(increment);
    return increment;
  }

  template class PlasticReference<2>;
  template class PlasticReference<3>;
} // namespace Talus

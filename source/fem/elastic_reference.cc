#include <talus/fem/elastic_reference.h>

#include <deal.II/base/patterns.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/grid/filtered_iterator.h>
#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/trilinos_precondition.h>
#include <deal.II/lac/trilinos_sparsity_pattern.h>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    const FEValuesExtractors::Vector u(0);
  } // namespace

  template <int dim>
  ElasticReference<dim>::ElasticReference(Parameters &parameters, const std::string &section,
                                          const MPI_Comm communicator) :
    ParameterAcceptor(section),
    communicator(communicator), box(section), conditions(parameters, section + "/Conditions"),
    triangulation(communicator), dof_handler(triangulation)
  {
    add_parameter("Degree", degree, "Polynomial degree of the elements, 1 or 2.", this->prm, Patterns::Integer(1, 2));
  }

  template <int dim>
  void ElasticReference<dim>::set_moduli(const double bulk_modulus, const double shear_modulus)
  {
    AssertThrow(bulk_modulus > 0. && shear_modulus > 0.,
                InputError("The elastic reference needs positive moduli, not a bulk modulus of " +
                           std::to_string(bulk_modulus) + " and a shear modulus of " + std::to_string(shear_modulus) +
                           "."));
    AssertThrow(bulk_modulus <= 50. * shear_modulus,
                InputError("The elastic reference locks for a bulk modulus of more than 50 shear moduli, here " +
                           std::to_string(bulk_modulus / shear_modulus) +
                           ". Choose a Poisson's ratio of at most 0.49."));
    K = bulk_modulus;
    G = shear_modulus;
  }

  template <int dim>
  void ElasticReference<dim>::set_body_force(std::shared_ptr<const Function<dim>> new_body_force)
  {
    body_force = std::move(new_body_force);
  }

  template <int dim>
  void ElasticReference<dim>::solve(const double time)
  {
    Assert(K > 0., ExcMessage("Call set_moduli() before solve()."));
    if (triangulation.n_levels() == 0)
      make_mesh();
    conditions.prescribe(mapping, dof_handler, time);
    constraints.copy_from(conditions.constraints());
    compute_cell_matrix();
    assemble();
    solve_system();
    compute_residual();
  }

  template <int dim>
  void ElasticReference<dim>::make_mesh()
  {
    box.create(triangulation);
    fe = std::make_unique<FESystem<dim>>(FE_Q<dim>(degree), dim);
    dof_handler.distribute_dofs(*fe);
  }

  template <int dim>
  void ElasticReference<dim>::compute_cell_matrix()
  {
    // All cells are the same box, so one matrix serves all. A rank without cells needs none.
    const unsigned int n = fe->n_dofs_per_cell();
    cell_matrix.reinit(n, n);
    auto cell = dof_handler.begin_active();
    while (cell != dof_handler.end() && !cell->is_locally_owned())
      ++cell;
    if (cell == dof_handler.end())
      return;
    FEValues<dim> fe_values(mapping, *fe, QGauss<dim>(degree + 1), update_gradients | update_JxW_values);
    fe_values.reinit(cell);

    // sigma : epsilon = (K - 2G/3) div u div v + 2G epsilon(u) : epsilon(v)
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        for (const unsigned int q : fe_values.quadrature_point_indices())
          cell_matrix(i, j) +=
            ((K - 2. / 3. * G) * fe_values[u].divergence(i, q) * fe_values[u].divergence(j, q) +
             2. * G * (fe_values[u].symmetric_gradient(i, q) * fe_values[u].symmetric_gradient(j, q))) *
            fe_values.JxW(q);
  }

  template <int dim>
  typename ElasticReference<dim>::Vector ElasticReference<dim>::new_vector() const
  {
    return Vector(dof_handler.locally_owned_dofs(), DoFTools::extract_locally_relevant_dofs(dof_handler), communicator);
  }

  template <int dim>
  void ElasticReference<dim>::assemble()
  {
    TrilinosWrappers::SparsityPattern sparsity(dof_handler.locally_owned_dofs(), dof_handler.locally_owned_dofs(),
                                               DoFTools::extract_locally_relevant_dofs(dof_handler), communicator);
    DoFTools::make_sparsity_pattern(dof_handler, sparsity, constraints, false,
                                    Utilities::MPI::this_mpi_process(communicator));
    sparsity.compress();
    matrix.reinit(sparsity);
    right_hand_side = new_vector();
    load            = new_vector();

    FEValues<dim>                        fe_values(mapping, *fe, QGauss<dim>(degree + 1),
                                                   update_values | update_quadrature_points | update_JxW_values);
    dealii::Vector<double>               cell_load(fe->n_dofs_per_cell());
    std::vector<types::global_dof_index> dofs(fe->n_dofs_per_cell());
    for (const auto &cell : dof_handler.active_cell_iterators() | IteratorFilters::LocallyOwnedCell())
    {
      cell_load = 0.;
      if (body_force)
      {
        fe_values.reinit(cell);
        for (const unsigned int q : fe_values.quadrature_point_indices())
          for (const unsigned int i : fe_values.dof_indices())
            cell_load(i) += body_force->value(fe_values.quadrature_point(q), fe->system_to_component_index(i).first) *
                            fe_values.shape_value(i, q) * fe_values.JxW(q);
      }
      cell->get_dof_indices(dofs);
      constraints.distribute_local_to_global(cell_matrix, cell_load, dofs, matrix, right_hand_side);
      load.add(dofs, cell_load);
    }
    matrix.compress(VectorOperation::add);
    right_hand_side.compress(VectorOperation::add);
    load.compress(VectorOperation::add);
  }

  template <int dim>
  void ElasticReference<dim>::solve_system()
  {
    TrilinosWrappers::PreconditionAMG::AdditionalData data;
    data.elliptic              = true;
    data.higher_order_elements = degree > 1;
    data.smoother_sweeps       = 2;
    data.aggregation_threshold = 0.02;
    // Without these modes ML takes the components of a displacement for one scalar field.
    DoFTools::extract_constant_modes(dof_handler, ComponentMask(dim, true), data.constant_modes);
    TrilinosWrappers::PreconditionAMG preconditioner;
    preconditioner.initialize(matrix, data);

    // So tight that comparisons on other meshes or numbers of ranks see the discretisation alone.
    SolverControl control(1000, 1e-12 * right_hand_side.l2_norm());
    Vector        result = new_vector();
    try
    {
      SolverCG<Vector>(control).solve(matrix, result, right_hand_side, preconditioner);
    }
    catch (const SolverControl::NoConvergence &error)
    {
      throw RunError("The solver of the elastic reference did not converge: residual " +
                     std::to_string(error.last_residual / right_hand_side.l2_norm()) + " of its start after " +
                     std::to_string(error.last_step) +
                     " iterations. Make the cells more cubic, or lower Poisson's ratio.");
    }
    constraints.distribute(result);
    solution = result;
    solution.update_ghost_values();
  }

  template <int dim>
  void ElasticReference<dim>::compute_residual()
  {
    residual = new_vector();
    dealii::Vector<double>               cell_solution(fe->n_dofs_per_cell()), cell_force(fe->n_dofs_per_cell());
    std::vector<types::global_dof_index> dofs(fe->n_dofs_per_cell());
    for (const auto &cell : dof_handler.active_cell_iterators() | IteratorFilters::LocallyOwnedCell())
    {
      cell->get_dof_indices(dofs);
      cell->get_dof_values(solution, cell_solution);
      cell_matrix.vmult(cell_force, cell_solution);
      residual.add(dofs, cell_force);
    }
    residual.compress(VectorOperation::add);
    residual -= load;
  }

  template class ElasticReference<2>;
  template class ElasticReference<3>;
} // namespace Talus

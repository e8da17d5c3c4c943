#include <talus/fem/elastic_reference.h>

#include <deal.II/base/patterns.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/grid/filtered_iterator.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/lac/lapack_full_matrix.h>
#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/trilinos_precondition.h>
#include <deal.II/lac/trilinos_sparsity_pattern.h>
#include <deal.II/numerics/vector_tools_boundary.h>

#include <algorithm>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    const FEValuesExtractors::Vector u(0);

    /** A component of the rigid translations and rotations at x. */
    template <int dim>
    std::vector<double> rigid_motions(const Tensor<1, dim> &x, const unsigned int component)
    {
      std::vector<double> motions(dim, 0.);
      motions[component] = 1.;
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = i + 1; j < dim; ++j)
          motions.push_back(component == i ? -x[j] : component == j ? x[i] : 0.);
      return motions;
    }
  } // namespace

  template <int dim>
  ElasticReference<dim>::ElasticReference(Parameters &parameters, const std::string &section,
                                          const MPI_Comm communicator) :
    ParameterAcceptor(section),
    communicator(communicator), n_cells(dim, 20), triangulation(communicator), dof_handler(triangulation)
  {
    for (unsigned int i = 0; i < dim; ++i)
      upper[i] = 1.;
    add_parameter("Degree", degree, "Polynomial degree of the elements, 1 or 2.", this->prm, Patterns::Integer(1, 2));
    add_parameter("Lower corner", lower, "Lower corner of the box [length].", this->prm);
    add_parameter("Upper corner", upper, "Upper corner of the box [length].", this->prm);
    add_parameter("Cells", n_cells,
                  "Number of cells in each direction. A high common power of two saves memory: the rest is "
                  "stored on every rank.",
                  this->prm, Patterns::List(Patterns::Integer(1), dim, dim));

    const std::string objects = section + "/Conditions";
    for (const auto &name : parameters.names(objects, "Names of the prescribed displacements. Each has a section of "
                                                      "its name; where two prescribe the same, the last one counts."))
      conditions.push_back(std::make_unique<DisplacementCondition<dim>>(objects + "/" + name, name));
  }

  template <int dim>
  void ElasticReference<dim>::parse_parameters(ParameterHandler &)
  {
    for (unsigned int i = 0; i < dim; ++i)
      if (!(lower[i] < upper[i]))
        throw EntryError(get_section_name(), "Upper corner",
                         "the box from " + Patterns::Tools::to_string(lower) + " to " +
                           Patterns::Tools::to_string(upper) +
                           " is empty. Every coordinate of the upper corner must be greater than that of the lower.");
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
    prescribe(time);
    check_body_is_held();
    compute_cell_matrix();
    assemble();
    solve_system();
    compute_residual();
  }

  template <int dim>
  void ElasticReference<dim>::make_mesh()
  {
    // p4est keeps the coarse mesh on every rank: leave as much as possible to refinement.
    auto         n_coarse      = n_cells;
    unsigned int n_refinements = 0;
    const auto   is_even       = [](const unsigned int n) { return n % 2 == 0; };
    for (; std::all_of(n_coarse.begin(), n_coarse.end(), is_even); ++n_refinements)
      for (auto &n : n_coarse)
        n /= 2;
    GridGenerator::subdivided_hyper_rectangle(triangulation, n_coarse, lower, upper, true);
    triangulation.refine_global(n_refinements);

    fe = std::make_unique<FESystem<dim>>(FE_Q<dim>(degree), dim);
    dof_handler.distribute_dofs(*fe);
  }

  template <int dim>
  void ElasticReference<dim>::prescribe(const double time)
  {
    prescribed.clear();
    for (unsigned int k = 0; k < conditions.size(); ++k)
    {
      const auto &condition = *conditions[k];
      for (const unsigned int component : condition.components)
      {
        const VectorFunctionFromScalarFunctionObject<dim> displacement(
          [&](const Point<dim> &x) { return condition.displacement.value(x, time)[component]; }, component, dim);
        std::map<types::boundary_id, const Function<dim> *> functions;
        for (const unsigned int id : condition.boundary_ids)
          functions[id] = &displacement;
        ComponentMask mask(dim, false);
        mask.set(component, true);
        std::map<types::global_dof_index, double> values;
        VectorTools::interpolate_boundary_values(mapping, dof_handler, functions, values, mask);
        for (const auto &[dof, value] : values)
          prescribed[dof] = {k, component, value};
      }
    }

    constraints.reinit(DoFTools::extract_locally_relevant_dofs(dof_handler));
    for (const auto &[dof, data] : prescribed)
    {
      constraints.add_line(dof);
      constraints.set_inhomogeneity(dof, data.value);
    }
    constraints.close();
  }

  template <int dim>
  void ElasticReference<dim>::check_body_is_held() const
  {
    std::map<types::global_dof_index, Point<dim>> positions;
    DoFTools::map_dofs_to_support_points(mapping, dof_handler, positions);

    // The body is held when no rigid motion vanishes on all that is prescribed: their Gram matrix there is regular.
    const unsigned int  n = dim + dim * (dim - 1) / 2;
    std::vector<double> gram(n * n, 0.);
    for (const auto &[dof, data] : prescribed)
      if (dof_handler.locally_owned_dofs().is_element(dof))
      {
        const Tensor<1, dim> x       = (positions.at(dof) - lower) / (upper - lower).norm();
        const auto           motions = rigid_motions(x, data.component);
        for (unsigned int a = 0; a < n; ++a)
          for (unsigned int b = 0; b < n; ++b)
            gram[a * n + b] += motions[a] * motions[b];
      }
    Utilities::MPI::sum(gram, communicator, gram);

    LAPACKFullMatrix<double> matrix(n);
    for (unsigned int a = 0; a < n; ++a)
      for (unsigned int b = 0; b < n; ++b)
        matrix(a, b) = gram[a * n + b];
    matrix.compute_svd();
    AssertThrow(matrix.singular_value(n - 1) > 1e-10 * matrix.singular_value(0),
                InputError("The conditions in section '" + get_section_name() +
                           "/Conditions' leave the body free to move or turn as a whole. Prescribe more components, "
                           "or another face."));
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
    solution = std::move(result);
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

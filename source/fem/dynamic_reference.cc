#include <talus/fem/dynamic_reference.h>

#include <talus/core/exceptions.h>

#include <deal.II/base/patterns.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/grid/filtered_iterator.h>
#include <deal.II/numerics/vector_tools_evaluate.h>

#include <cmath>
#include <sstream>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    // Central differences keep energy up to terms of the square of the step; far more is a divergence.
    const double greatest_residual = 0.1;
  } // namespace

  ElasticSolid::ElasticSolid(const std::string &section) : ParameterAcceptor(section)
  {
    add_parameter("Young's modulus", youngs_modulus, "Of small strains [stress].", prm, Patterns::Double());
    add_parameter("Poisson's ratio", poisson_ratio, "Of small strains, at most 0.49: displacement elements lock [1].",
                  prm, Patterns::Double(-1, 0.49));
    add_parameter("Density", density, "In the reference state [mass/volume].", prm, Patterns::Double());
  }

  void ElasticSolid::parse_parameters(ParameterHandler &)
  {
    if (!(youngs_modulus > 0.))
      throw EntryError(get_section_name(), "Young's modulus", "it must be positive.");
    if (!(density > 0.))
      throw EntryError(get_section_name(), "Density", "it must be positive.");
    if (!(poisson_ratio > -1. && poisson_ratio <= 0.49))
      throw EntryError(get_section_name(), "Poisson's ratio", "it must lie between -1 and 0.49.");
  }

  template <int dim>
  DynamicReference<dim>::DynamicReference(Parameters &parameters, const std::string &section,
                                          const MPI_Comm communicator) :
    ParameterAcceptor(section),
    communicator(communicator), box(section), solid(section + "/Solid"),
    conditions(parameters, section + "/Conditions"), body_force_text(dim == 2 ? "0; 0" : "0; 0; 0"),
    triangulation(communicator), dof_handler(triangulation)
  {
    add_parameter("Degree", degree, "Polynomial degree of the elements, 1 or 2.", this->prm, Patterns::Integer(1, 2));
    add_parameter("Courant number", courant_number,
                  "Step size over its bound, 2 over the greatest frequency of a cell "
                  "at rest [1]; cells that are compressed need less.",
                  this->prm, Patterns::Double());
    add_parameter(
      "Body force", body_force_text,
      "Force per mass [length/time^2], at once: functions of x, y, z in the reference state and t, separated "
      "by ';'.",
      this->prm);
    add_parameter("Points", points,
                  "Points of the body at rest whose displacements are written [length]: 'x, y; x, y'.", this->prm);
    add_parameter("Rows", n_rows, "Number of equal intervals from rest to the end time after which they are written.",
                  this->prm, Patterns::Integer(1));
  }

  template <int dim>
  void DynamicReference<dim>::parse_parameters(ParameterHandler &)
  {
    if (!(courant_number > 0.))
      throw EntryError(get_section_name(), "Courant number", "it must be positive; 0.8 is a safe choice.");
    for (const auto &point : points)
      for (unsigned int d = 0; d < dim; ++d)
        if (!(point[d] >= box.lower[d] && point[d] <= box.upper[d]))
          throw EntryError(get_section_name(), "Points",
                           "the point " + to_text(point) + " lies outside the box from " + to_text(box.lower) + " to " +
                             to_text(box.upper) + ".");
    parsed_body_force.initialize(body_force_text, get_section_name(), "Body force");
    is_uniform = !parsed_body_force.depends_on_space();
    body_force = [this](const Point<dim> &x, const double time) { return parsed_body_force.value(x, time); };
  }

  template <int dim>
  void DynamicReference<dim>::set_body_force(BodyForce new_body_force)
  {
    body_force = std::move(new_body_force);
    is_uniform = false;
  }

  template <int dim>
  typename DynamicReference<dim>::Vector DynamicReference<dim>::new_vector() const
  {
    return Vector(dof_handler.locally_owned_dofs(), DoFTools::extract_locally_relevant_dofs(dof_handler), communicator);
  }

  template <int dim>
  void DynamicReference<dim>::set_up()
  {
    box.create(triangulation);
    // The nodes of FE_Q are the Gauss-Lobatto points.
    fe = std::make_unique<FESystem<dim>>(FE_Q<dim>(degree), dim);
    dof_handler.distribute_dofs(*fe);
    for (Vector *vector : {&displacement_now, &velocity, &old_velocity, &mass, &force, &external, &old_external})
      *vector = new_vector();

    std::map<types::global_dof_index, Point<dim>> support_points;
    DoFTools::map_dofs_to_support_points(mapping, dof_handler, support_points);
    positions.resize(velocity.locally_owned_size());
    components.resize(positions.size());
    const auto &partitioner = *velocity.get_partitioner();
    for (unsigned int i = 0; i < positions.size(); ++i)
      positions[i] = support_points.at(partitioner.local_to_global(i));
    number_cells();

    double frequency = 0.;
    if (!cell_dofs.empty())
      frequency = cells.greatest_frequency(solid.density);
    dt = courant_number * 2. / Utilities::MPI::max(frequency, communicator);
  }

  template <int dim>
  void DynamicReference<dim>::number_cells()
  {
    const auto                          &partitioner = *velocity.get_partitioner();
    std::vector<types::global_dof_index> dofs(fe->n_dofs_per_cell());
    for (const auto &cell : dof_handler.active_cell_iterators() | IteratorFilters::LocallyOwnedCell())
    {
      if (cell_dofs.empty())
        cells.reinit(mapping, cell, solid.lambda(), solid.mu());
      cell->get_dof_indices(dofs);
      for (unsigned int i = 0; i < dofs.size(); ++i)
      {
        const unsigned int local = partitioner.global_to_local(dofs[i]);
        cell_dofs.push_back(local);
        mass.local_element(local) += solid.density * cells.masses()[i];
      }
    }
    mass.compress(VectorOperation::add);
    // A component is a property of the number, not of the cell that asks: ghosts' cells know it as well.
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (!cell->is_artificial())
      {
        cell->get_dof_indices(dofs);
        for (unsigned int i = 0; i < dofs.size(); ++i)
          if (partitioner.in_local_range(dofs[i]))
            components[partitioner.global_to_local(dofs[i])] = fe->system_to_component_index(i).first;
      }
  }

  template <int dim>
  void DynamicReference<dim>::find_held(const double time)
  {
    conditions.prescribe(mapping, dof_handler, time, /* must_be_held = */ false);
    held.clear();
    held_displacement.clear();
    conditions.for_each_owned([&](const types::global_dof_index dof, const double value) {
      held.push_back(velocity.get_partitioner()->global_to_local(dof));
      held_displacement.push_back(value);
    });
  }

  template <int dim>
  void DynamicReference<dim>::compute_forces(const double time)
  {
    const unsigned int  n = fe->n_dofs_per_cell();
    std::vector<double> u(n), cell_force(n);
    displacement_now.update_ghost_values();
    force              = 0.;
    strain_energy_here = 0.;
    for (std::size_t first = 0; first < cell_dofs.size(); first += n)
    {
      for (unsigned int i = 0; i < n; ++i)
        u[i] = displacement_now.local_element(cell_dofs[first + i]);
      std::fill(cell_force.begin(), cell_force.end(), 0.);
      strain_energy_here += cells.add_forces(u.data(), cell_force.data());
      for (unsigned int i = 0; i < n; ++i)
        force.local_element(cell_dofs[first + i]) -= cell_force[i];
    }
    force.compress(VectorOperation::add);

    external.swap(old_external);
    Tensor<1, dim> b = body_force({}, time);
    for (unsigned int i = 0; i < positions.size(); ++i)
    {
      if (!is_uniform && (i == 0 || positions[i] != positions[i - 1]))
        b = body_force(positions[i], time);
      external.local_element(i) = mass.local_element(i) * b[components[i]];
      force.local_element(i) += external.local_element(i);
    }
  }

  /** From the middle of the last step to that of the next; what is held goes where it shall be then. */
  template <int dim>
  void DynamicReference<dim>::update_velocity(const double time)
  {
    // From rest half a step is enough.
    const double factor = steps_done == 0 ? .5 * dt : dt;
    old_velocity        = velocity;
    for (unsigned int i = 0; i < positions.size(); ++i)
      velocity.local_element(i) += factor * force.local_element(i) / mass.local_element(i);
    if (steps_done == 0 || conditions.depends_on_time())
      find_held(time + dt);
    for (unsigned int k = 0; k < held.size(); ++k)
    {
      const unsigned int i      = held[k];
      velocity.local_element(i) = (held_displacement[k] - displacement_now.local_element(i)) / dt;
      // What holds it makes up for what is missing.
      external.local_element(i) +=
        mass.local_element(i) * (velocity.local_element(i) - old_velocity.local_element(i)) / dt -
        force.local_element(i);
    }
  }

  template <int dim>
  void DynamicReference<dim>::add_work()
  {
    if (steps_done == 0)
      return;
    double work = 0.; // by the mean force of the last step
    for (unsigned int i = 0; i < positions.size(); ++i)
      work += old_velocity.local_element(i) * (external.local_element(i) + old_external.local_element(i));
    work_here += .5 * dt * work;
  }

  template <int dim>
  void DynamicReference<dim>::update_energies(const double time)
  {
    double kinetic = 0.;
    for (unsigned int i = 0; steps_done > 0 && i < positions.size(); ++i)
      kinetic += .125 * mass.local_element(i) * std::pow(velocity.local_element(i) + old_velocity.local_element(i), 2);
    std::vector<double> sums = {kinetic, strain_energy_here, work_here};
    Utilities::MPI::sum(sums, communicator, sums);
    now             = {sums[0], sums[1], sums[2]};
    greatest_energy = std::max(greatest_energy, now.kinetic + now.strain + std::abs(now.work));
    if (!(std::abs(now.residual()) <= greatest_residual * greatest_energy))
    {
      std::ostringstream text;
      text << "The dynamic reference has diverged at t = " << time << ": kinetic energy " << now.kinetic
           << ", strain energy " << now.strain << ", work done on it " << now.work
           << ". Lower 'Courant number' in section '" << get_section_name().substr(1) << "', or make the body stiffer.";
      throw RunError(text.str());
    }
  }

  template <int dim>
  void DynamicReference<dim>::solve(const double end_time, const std::function<void(double)> &report)
  {
    set_up();
    const double       interval = end_time / n_rows;
    const unsigned int n        = std::max(1, static_cast<int>(std::ceil(interval / dt)));
    dt                          = interval / n;
    for (;; ++steps_done)
    {
      const double time = steps_done * dt;
      compute_forces(time);
      update_velocity(time);
      add_work();
      if (steps_done % n == 0)
      {
        update_energies(time);
        if (report)
          report(time);
      }
      if (steps_done == n * n_rows)
        return;
      for (unsigned int i = 0; i < positions.size(); ++i)
        displacement_now.local_element(i) += dt * velocity.local_element(i);
    }
  }

  template <int dim>
  std::vector<Tensor<1, dim>> DynamicReference<dim>::displacement(const std::vector<Point<dim>> &points) const
  {
    displacement_now.update_ghost_values();
    return VectorTools::point_values<dim>(mapping, dof_handler, displacement_now, points, point_cache);
  }

  template <int dim>
  std::vector<Tensor<1, dim>> DynamicReference<dim>::displacements_at_points() const
  {
    // The root alone asks, the others would ask for the same.
    const bool is_root = Utilities::MPI::this_mpi_process(communicator) == 0;
    return Utilities::MPI::broadcast(communicator, displacement(is_root ? points : std::vector<Point<dim>>()));
  }

  template class DynamicReference<2>;
  template class DynamicReference<3>;
} // namespace Talus

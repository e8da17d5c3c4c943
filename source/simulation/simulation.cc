#include <talus/simulation/simulation.h>

#include <iomanip>

namespace Talus
{
  using namespace dealii;

  template <int dim>
  Simulation<dim>::Simulation(Parameters &parameters, MPI_Comm communicator) :
    ParameterAcceptor("/Run"), communicator(communicator), parameters(parameters),
    timer(std::cout, TimerOutput::never, TimerOutput::wall_times), grid("/Grid", communicator),
    kernel(parameters.make<Kernel<dim>>("/Kernel", "Type", "quadratic B-spline", "Kernel function.")),
    transfer(
      parameters.make<Transfer<dim>>("/Transfer", "Type", "TPIC", "Scheme that carries motion to the grid and back.")),
    model{grid, particles, *kernel, *transfer, boundary, materials, acceleration},
    acceleration_text(dim == 2 ? "0; 0" : "0; 0; 0")
  {
    kernel->attach(grid.lattice,
                   parameters.make<Treatment<dim>>("/Kernel", "Boundary treatment", "WLS",
                                                   "What happens to the kernel where nodes are missing."));

    const auto material_names =
      parameters.names("/Materials", "Names of the materials; each has a subsection of its name.");
    const auto body_names = parameters.names("/Bodies", "Names of the bodies; each has a subsection of its name.");
    boundary.names        = parameters.names("/Conditions", "Names of the conditions in the order in which they act.");
    AssertThrow(!material_names.empty(), EntryError("/Materials", "Names", "give at least one material."));
    AssertThrow(!body_names.empty(), EntryError("/Bodies", "Names", "give at least one body."));

    for (const auto &name : material_names)
    {
      materials.push_back(
        parameters.make<Material>("/Materials/" + name, "Type", "linear elastic", "Constitutive law."));
      for (const auto &state : materials.back()->state_names())
        particles.add_field(state, 1);
    }
    for (const auto &name : body_names)
      bodies.push_back(std::make_unique<Body<dim>>(parameters, name, material_names));
    for (const auto &name : boundary.names)
      boundary.conditions.push_back(
        parameters.make<Condition<dim>>("/Conditions/" + name, "Type", "no-slip", "Kind of condition."));
    transfer->add_fields(particles);

    add_parameter("End time", end_time, "The run ends at this time [time].", prm, Patterns::Double());
    add_parameter("Courant number", courant_number, "Step size over its critical value, Eq. (37) [1].", prm,
                  Patterns::Double());
    add_parameter("Step size", fixed_step_size, "Fixed step size [time]; 0: by the Courant number each step.", prm,
                  Patterns::Double(0));
    add_parameter("Number of steps", max_steps,
                  "The run ends after this many steps if the end time is later; 0: no limit.", prm,
                  Patterns::Integer(0));
    add_parameter("Body force", acceleration_text,
                  "Force per mass [length/time^2], for instance gravity: functions of x, y, z, t, separated by ';'.");
  }

  template <int dim>
  void Simulation<dim>::parse_parameters(ParameterHandler &)
  {
    acceleration.initialize(acceleration_text, get_section_name(), "Body force");
    if (!(end_time > 0))
      throw EntryError(get_section_name(), "End time", "it must be positive.");
    if (!(courant_number > 0))
      throw EntryError(get_section_name(), "Courant number", "it must be positive; 0.5 is a safe choice.");
  }

  template <int dim>
  void Simulation<dim>::run()
  {
    set_up();
    while (!is_finished())
      advance();
  }

  template <int dim>
  void Simulation<dim>::set_up()
  {
    TimerOutput::Scope scope(timer, "set-up");
    for (auto &body : bodies)
      body->shape->create(grid.lattice.h);
    grid.create([&](const auto &cell) { return Particles<dim>::count(grid, bodies, cell); });
    particles.set_stencil(grid, kernel->n_nodes(), kernel->shift());
    particles.create(grid, bodies, materials);
    transfer->initialize(*kernel, particles);
    for (auto &condition : boundary.conditions)
      condition->attach(grid);
    now = survey(model, time, dt);
  }

  template <int dim>
  double Simulation<dim>::choose_step_size() const
  {
    if (fixed_step_size > 0)
      return fixed_step_size;
    return courant_number * grid.lattice.smallest_spacing() / now.signal_speed; // Eqs. (35), (37)
  }

  template <int dim>
  void Simulation<dim>::advance()
  {
    dt                 = choose_step_size();
    const bool is_last = time + dt >= end_time * (1 - 1e-12);
    if (is_last)
      dt = end_time - time;
    if (now.needs_synchronise)
    {
      TimerOutput::Scope scope(timer, "synchronise");
      particles.synchronise();
    }
    explicit_step(model, time, dt, timer);
    time = is_last ? end_time : time + dt;
    ++step;

    TimerOutput::Scope scope(timer, "survey");
    now = survey(model, time, dt);
    if (now.has_failed)
      report_failure(model, step, time, dt);
    energy.check(now, step, time, dt);
  }

  template class Simulation<2>;
  template class Simulation<3>;
} // namespace Talus

#include <talus/simulation/simulation.h>

#include <talus/core/command_line.h>
#include <talus/core/traffic.h>
#include <talus/postprocess/energies.h>

#include <iomanip>
#include <iostream>
#include <limits>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    /** Resident memory of this process, now and at most [byte]. */
    std::pair<double, double> resident_memory()
    {
      Utilities::System::MemoryStats stats;
      Utilities::System::get_memory_stats(stats);
      return {1024. * stats.VmRSS, 1024. * stats.VmHWM};
    }
  } // namespace

  template <int dim>
  Simulation<dim>::Simulation(Parameters &parameters, MPI_Comm communicator) :
    ParameterAcceptor("/Run"), communicator(communicator), parameters(parameters),
    memory_at_start(resident_memory().first), step_timing(timing), set_up_section(timing.add("set-up")),
    upkeep_section(timing.add("upkeep")), smoothing_section(timing.add("smoothing of J")),
    output_section(timing.add("output")), comparison_section(timing.add("finite element reference")),
    grid("/Grid", communicator),
    kernel(parameters.make<Kernel<dim>>("/Kernel", "Type", "quadratic B-spline", "Kernel function.")),
    transfer(
      parameters.make<Transfer<dim>>("/Transfer", "Type", "TPIC", "Scheme that carries motion to the grid and back.")),
    model{grid, particles, *kernel, *transfer, boundary, materials, acceleration, tractions}, probes(parameters),
    acceleration_text(dim == 2 ? "0; 0" : "0; 0; 0")
  {
    kernel->choose(parameters);
    kernel->attach(grid);

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
    tractions.names = parameters.names("/Tractions", "Names of the tractions; each has a subsection of its name.");
    for (const auto &name : tractions.names)
      tractions.loads.push_back(std::make_unique<Traction<dim>>(parameters, name, body_names));
    kernel->add_fields(particles);
    transfer->add_fields(particles);
    add_reference(parameters, material_names);
    verification = Verification<dim>::make(parameters, communicator);

    transfer->is_plain =
      parameters.choose_from("/Run", "Loops", "batched", "batched|plain",
                             "batched: many particles at a time; plain: one, the slow reference of the others.") ==
      "plain";
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
    add_parameter("Local damping", boundary.damping.factor,
                  "Share alpha of each nodal force that opposes the motion, for quasi-static work [1]; 0: none.", prm,
                  Patterns::Double());
  }

  template <int dim>
  void Simulation<dim>::add_reference(Parameters &parameters, const std::vector<std::string> &material_names)
  {
    const std::string section = "/FEM reference";
    if (parameters.choose_from(section, "Compare", "no", "no|yes",
                               "Solve the problem by finite elements too, for comparison.") == "no")
      return;
    if (parameters.choose_from(section, "Model", "linear elastic", "linear elastic|J2",
                               "'linear elastic': the stress at the end is compared with that of the particles; 'J2': "
                               "plasticity, a load-displacement curve is written.") == "J2")
      load_curve = std::make_unique<LoadCurve<dim>>(parameters, section, communicator);
    else
    {
      comparison = std::make_unique<Comparison<dim>>(parameters, section, material_names, communicator);
      comparison->add_fields(particles);
    }
  }

  template <int dim>
  void Simulation<dim>::parse_parameters(ParameterHandler &)
  {
    acceleration.initialize(acceleration_text, get_section_name(), "Body force");
    if (!(end_time > 0))
      throw EntryError(get_section_name(), "End time", "it must be positive.");
    if (!(courant_number > 0))
      throw EntryError(get_section_name(), "Courant number", "it must be positive; 0.5 is a safe choice.");
    if (!(boundary.damping.factor >= 0 && boundary.damping.factor < 1))
      throw EntryError(get_section_name(), "Local damping",
                       "it must lie between 0 and 1, 1 excluded; 0.7 comes to rest soon.");
  }

  template <int dim>
  void Simulation<dim>::run()
  {
    set_up();
    open_output();
    postprocess();
    Traffic::here()         = {};
    processor_time_at_start = processor_time();
    while (!is_finished())
    {
      advance();
      postprocess();
    }
    finish();
  }

  template <int dim>
  void Simulation<dim>::set_up()
  {
    Timing::Scope scope(timing, set_up_section);
    for (auto &body : bodies)
      body->shape->create(grid.lattice.h);
    grid.create([&](const auto &cell) { return Particles<dim>::count(grid, bodies, cell); }, transfer->reach(*kernel));
    particles.set_reach(grid, transfer->reach(*kernel));
    smoothing.add_fields(materials, particles);
    particles.create(grid, bodies, materials);
    for (auto &condition : boundary.conditions)
      condition->attach(grid);
    boundary.mark_slip_walls(std::numeric_limits<double>::min(), particles.n_stencil_nodes, grid);
    if (verification)
      verification->start(materials, particles, acceleration);
    transfer->initialize(*kernel, particles);
    smoothing.initialize(materials, *kernel, particles, grid);
    for (auto &traction : tractions.loads)
      traction->attach(grid, bodies, particles);
    now = survey(model, time, dt);
    energy.start(now, totals(particles, *transfer, materials, communicator).strain_energy);
  }

  template <int dim>
  void Simulation<dim>::open_output()
  {
    output.check(particles);
    output.open(communicator);
    if (Utilities::MPI::this_mpi_process(communicator) == 0)
    {
      log.open(output.directory() + "/log.txt");
      std::ofstream used(output.directory() + "/parameters.prm");
      parameters.print(used, /* with_help = */ false);
      AssertThrow(log && used.flush(), RunError("Cannot write into the directory '" + output.directory() + "'."));
    }
    probes.open(output.directory(), particles, grid);

    std::vector<Column> columns = {{"time", "time"}, {"step", "1"}, {"step size", "time"}};
    for (const auto &column : Totals<dim>::columns())
      columns.push_back(column);
    columns.push_back({"body force work", "energy"});
    columns.push_back({"condition work", "energy"});
    columns.push_back({"traction work", "energy"});
    columns.push_back({"damping energy", "energy"});
    columns.push_back({"energy residual", "energy"});
    for (unsigned int d = 0; d < dim; ++d)
      columns.push_back({std::string("lost momentum ") + "xyz"[d], "mass length/time"});
    for (const auto &name : boundary.names)
      for (unsigned int d = 0; d < dim; ++d)
        columns.push_back({"reaction " + name + " " + "xyz"[d], "force"});
    for (const auto &name : boundary.names)
      for (unsigned int d = 0; d < dim; ++d)
        columns.push_back({"nodal force " + name + " " + "xyz"[d], "force"});
    for (const auto &name : tractions.names)
      for (unsigned int d = 0; d < dim; ++d)
        columns.push_back({"traction " + name + " " + "xyz"[d], "force"});
    if (verification)
      for (const auto &column : Verification<dim>::columns())
        columns.push_back(column);
    statistics.open(output.directory() + "/statistics.csv", columns, communicator);

    say(summary());
    progress = std::make_unique<Progress>(communicator, end_time, particles.n_global);
  }

  template <int dim>
  void Simulation<dim>::postprocess()
  {
    Timing::Scope scope(timing, output_section);
    if (comparison && step > 0)
      comparison->accumulate(time, dt, end_time, now.reactions, particles);
    if (verification)
      verification->record(time, end_time, step, particles);
    if (output.is_statistics_due(step) || is_finished())
    {
      write_statistics();
      probes.write(time, particles);
    }
    if (output.is_due(time, step) && !is_finished())
      output.write(time, step, particles, grid);
    progress->update(time, step);
  }

  template <int dim>
  void Simulation<dim>::write_statistics()
  {
    std::vector<double> row    = {time, static_cast<double>(step), dt};
    const auto          totals = Talus::totals(particles, *transfer, materials, communicator);
    const auto          values = totals.values();
    row.insert(row.end(), values.begin(), values.end());
    row.push_back(energy.body_force_work);
    row.push_back(energy.condition_work);
    row.push_back(energy.traction_work);
    row.push_back(energy.damping_energy);
    row.push_back(energy.residual(totals.kinetic_energy, totals.strain_energy));
    for (unsigned int d = 0; d < dim; ++d)
      row.push_back(lost_momentum[d]);
    for (const auto &reaction : now.reactions)
      row.insert(row.end(), reaction.begin_raw(), reaction.end_raw());
    for (const auto &force : now.nodal_forces)
      row.insert(row.end(), force.begin_raw(), force.end_raw());
    for (const auto &force : now.traction_forces)
      row.insert(row.end(), force.begin_raw(), force.end_raw());
    if (verification)
    {
      const auto errors = verification->errors(time, particles);
      row.insert(row.end(), errors.begin(), errors.end());
    }
    statistics.write_row(row);
  }

  template <int dim>
  void Simulation<dim>::finish()
  {
    progress->finish(time, step);
    if (comparison && time < end_time)
      say("\nNo comparison with the finite element reference: the run ended before its end time.\n");
    else if (comparison)
    {
      Timing::Scope scope(timing, comparison_section);
      comparison->finish(end_time, materials, boundary.names, particles);
      std::ostringstream table;
      comparison->write(output.directory() + "/comparison.csv", table);
      say(table.str());
    }
    if (verification)
    {
      std::ostringstream table;
      verification->write(output.directory() + "/verification.csv", table);
      say(table.str());
    }
    if (load_curve)
    {
      Timing::Scope scope(timing, comparison_section);
      load_curve->compute(end_time, output.directory() + "/load_curve.csv");
      say(load_curve->summary());
    }
    if (output.is_due_at_end(step))
    {
      Timing::Scope scope(timing, output_section);
      output.write(time, step, particles, grid);
    }
    say(timing.table() + "  " + std::to_string(upkeep.n_migrations) + " migrations between ranks, " +
        std::to_string(upkeep.n_sorts) + " sorts\n" + traffic() + memory());
  }

  template <int dim>
  std::string Simulation<dim>::traffic() const
  {
    const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(communicator);
    if (n_ranks == 1 || step == 0)
      return "";
    const Traffic &here = Traffic::here();
    const double   busy = Utilities::MPI::max(processor_time() - processor_time_at_start - here.waiting, communicator);
    const double   per_step = 1. / (static_cast<double>(step) * n_ranks);
    const double   bytes    = per_step * Utilities::MPI::sum(static_cast<double>(here.bytes), communicator),
                 messages   = per_step * Utilities::MPI::sum(static_cast<double>(here.messages), communicator);
    std::ostringstream text;
    text << std::fixed << std::setprecision(3) << "  busiest rank: " << busy << " s of processor time outside waiting\n"
         << std::setprecision(1) << "  a rank sends " << messages << " messages and " << bytes / 1000
         << " kB in a step\n";
    return text.str();
  }

  template <int dim>
  std::string Simulation<dim>::memory() const
  {
    const auto   here = resident_memory();
    const double n    = particles.n_global;
    const double now  = Utilities::MPI::sum(here.first - memory_at_start, communicator),
                 most = Utilities::MPI::sum(here.second - memory_at_start, communicator);
    std::ostringstream text;
    text << std::fixed << std::setprecision(0) << "  bytes per particle: " << now / n << " now, " << most / n
         << " at most\n";
    return text.str();
  }

  template <int dim>
  void Simulation<dim>::say(const std::string &text)
  {
    if (Utilities::MPI::this_mpi_process(communicator) != 0)
      return;
    std::cout << text << std::flush;
    log << text << std::flush;
  }

  template <int dim>
  std::string Simulation<dim>::summary() const
  {
    const auto chosen = [](const std::string &section, const std::string &entry) {
      prm.enter_subsection(section);
      const std::string value = prm.get(entry);
      prm.leave_subsection();
      return value;
    };
    std::ostringstream text;
    text << "Talus " << version() << ", " << Utilities::MPI::n_mpi_processes(communicator) << " rank(s)\n  grid       ";
    for (unsigned int d = 0; d < dim; ++d)
      text << (d == 0 ? "" : " x ") << grid.lattice.n_cells[d];
    text << " cells, " << grid.dof_handler.n_dofs() << " nodes\n  particles  " << particles.n_global << " in "
         << bodies.size()
         << (bodies.size() == 1 ? " body\n" : " bodies, which share one velocity field: they stick on contact\n")
         << "  kernel     " << chosen("Kernel", "Type") << ", boundary treatment "
         << chosen("Kernel", "Boundary treatment") << "\n  transfer   " << chosen("Transfer", "Type")
         << "\n  output     " << output.directory() << '\n';
    return text.str();
  }

  template <int dim>
  double Simulation<dim>::choose_step_size() const
  {
    if (fixed_step_size > 0)
      return fixed_step_size;
    double nu = 0;
    for (const auto &material : materials)
      nu = std::max(nu, material->kinematic_viscosity());
    // Eqs. (35), (37); together with the explicit limit of viscous stress, h^2 / (2 dim nu).
    const double h = grid.lattice.smallest_spacing();
    return courant_number / (now.signal_speed / h + 2 * dim * nu / (h * h));
  }

  template <int dim>
  void Simulation<dim>::advance()
  {
    dt                 = choose_step_size();
    const double stop  = verification ? verification->next_stop(time, end_time) : end_time;
    const bool   stops = time + dt >= stop * (1 - 1e-12);
    if (stops)
      dt = stop - time;
    {
      Timing::Scope scope(timing, upkeep_section);
      upkeep.run(model, now);
    }
    {
      Timing::Scope scope(timing, smoothing_section);
      smoothing.apply(materials, *kernel, dt, particles, grid);
    }
    now  = explicit_step(model, time, dt, step_timing);
    time = stops ? stop : time + dt;
    ++step;

    lost_momentum += now.lost_momentum;
    if (now.has_failed)
      report_failure(model, step, time, dt);
    energy.check(model, now, step, time, dt);
    if (step % energy.interval == 0 || is_finished())
      energy.check_total(model, now, totals(particles, *transfer, materials, communicator).strain_energy, step, time,
                         dt);
  }

  template class Simulation<2>;
  template class Simulation<3>;
} // namespace Talus

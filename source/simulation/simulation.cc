#include <talus/simulation/simulation.h>

#include <talus/core/command_line.h>
#include <talus/core/exceptions.h>
#include <talus/core/memory.h>

#include <iostream>

namespace Talus
{
  using namespace dealii;

  template <int dim>
  Simulation<dim>::Simulation(Parameters &parameters, const Communicator &communicator) :
    ParameterAcceptor("/Run"), communicator(communicator), parameters(parameters), resources(communicator),
    model(parameters, communicator),
    stepper(parameters.make<Stepper<dim>>("/Run", "Stepper", "explicit", "How the state is advanced in time.")),
    probes(parameters), references(parameters, model, communicator)
  {
    AssertThrow(!model.bodies.empty(), EntryError("/Bodies", "Names", "give at least one body."));
    add_parameter("End time", end_time, "The run ends at this time [time].", prm, Patterns::Double());
    add_parameter("Number of steps", max_steps,
                  "The run ends after this many steps if the end time is later; 0: no limit.", prm,
                  Patterns::Integer(0));
  }

  template <int dim>
  void Simulation<dim>::parse_parameters(ParameterHandler &)
  {
    if (!(end_time > 0))
      throw EntryError(get_section_name(), "End time", "it must be positive.");
  }

  template <int dim>
  void Simulation<dim>::run(const std::string &origin)
  {
    this->origin = origin;
    to_the_end([&] {
      set_up();
      open_output();
      postprocess();
      step_to_end();
    });
  }

  template <int dim>
  void Simulation<dim>::step_to_end()
  {
    const bool is_root = Utilities::MPI::this_mpi_process(communicator) == 0;
    resources.start_steps();
    {
      const Requests::Signals caught;
      while (!is_finished() && !model.requests.is_stopped())
      {
        model.requests.wants_checkpoint = is_root && checkpoints.is_due_by_clock();
        step();
        postprocess();
        checkpoint();
      }
    }
    if (is_finished())
      finish();
    else
      stop();
  }

  template <int dim>
  void Simulation<dim>::set_up()
  {
    const Timing::Scope scope(timing, timing.add("set-up"));
    for (const auto &remark : model.grid.remarks)
      parameters.warn(remark);
    tell_warnings(); // the system may end a run that takes its memory
    model.create([this] { references.start(model); });
    report = stepper->start(model, timing);
    energy.start(report, current_totals().strain_energy);
    fracture.start(model);
    Checks<dim>(parameters, model, end_time).run(stepper->step_size(model, report), report.signal_speed, max_steps);
    return_free_memory();
  }

  template <int dim>
  void Simulation<dim>::advance()
  {
    now.dt             = stepper->step_size(model, report);
    const double stop  = references.next_stop(now.time, end_time);
    const bool   stops = now.time + now.dt >= stop * (1 - 1e-12);
    if (stops)
      now.dt = stop - now.time;
    report   = stepper->advance(model, report, now.time, now.dt);
    now.time = stops ? stop : now.time + now.dt;
    ++now.step;
    lost_momentum += model.grid.lost_momentum;
  }

  template <int dim>
  void Simulation<dim>::check()
  {
    AssertThrow(!report.has_failed, RunError(report.failure + now.text() + ". " + report.remedy));
    AssertThrow(report.n_particles == model.particles.n_global,
                RunError("There are " + std::to_string(static_cast<std::uint64_t>(report.n_particles)) +
                         " particles, not " + std::to_string(model.particles.n_global) + ',' + now.text() +
                         ": some were lost or counted twice between ranks. Lower the Courant number."));
    if (!report.news.empty())
    {
      progress->end_line();
      say(report.news + now.text() + ".\n");
    }
    energy.check(model, report, now);
    if (now.step % energy.interval == 0 || is_finished())
    {
      energy.check_total(model, report, current_totals().strain_energy, now);
      look_for_fracture();
    }
  }

  template <int dim>
  void Simulation<dim>::look_for_fracture()
  {
    const std::string found = fracture.look(model);
    if (!found.empty())
      say_warning(found + now.text() + ". " + fracture.remedy);
  }

  template <int dim>
  void Simulation<dim>::postprocess()
  {
    const Timing::Scope scope(timing, output_section);
    references.accumulate(now, end_time, model);
    if (output.is_statistics_due(now.step) || is_finished())
    {
      totals = current_totals();
      fracture.measure(model);
      references.measure(now.time, model);
      statistics.write_row(table.row());
      probes.write(now.time, model.particles);
    }
    if (output.is_due(now.time, now.step) && !is_finished())
      output.write(now.time, now.step, model.particles, model.grid);
    progress->update(now.time, now.step);
  }

  template <int dim>
  void Simulation<dim>::finish()
  {
    progress->finish(now.time, now.step);
    {
      const Timing::Scope scope(timing, reference_section);
      say(references.finish(now.time, end_time, output.directory(), model));
    }
    if (output.is_due_at_end(now.step))
    {
      const Timing::Scope scope(timing, output_section);
      output.write(now.time, now.step, model.particles, model.grid);
    }
    say(timing.table() + stepper->summary() + resources.traffic(now.step - first_step) +
        resources.memory(model.particles.n_global));
    const double mean = static_cast<double>(model.particles.n_global) / Utilities::MPI::n_mpi_processes(communicator);
    if (report.most_particles > 1.5 * mean && parameters.value("/Run", "Largest imbalance", "0") == "0")
      say("  the busiest rank has " + std::to_string(static_cast<int>(100 * report.most_particles / mean)) +
          " % of the mean number of particles: 'Largest imbalance = 1.2' in section 'Run' shares the cells out anew\n");
  }

  template <int dim>
  void Simulation<dim>::open_output(const Resume *resume)
  {
    output_section     = timing.add("output");
    reference_section  = timing.add("finite element reference");
    checkpoint_section = timing.add("checkpoints");
    output.leave_out(references.idle_fields());
    probes.leave_out(references.idle_fields());
    output.check(model.particles);
    if (resume)
      output.reopen(communicator);
    else
      output.open(communicator);
    if (Utilities::MPI::this_mpi_process(communicator) == 0)
    {
      start_log(resume != nullptr);
      std::ofstream used(output.directory() + "/parameters.prm");
      parameters.print(used, /* with_help = */ false);
      AssertThrow(log && used.flush(), RunError("Cannot write into the directory '" + output.directory() + "'."));
    }
    fill_table();
    const std::string statistics_file = output.directory() + "/statistics.csv";
    if (resume)
    {
      probes.reopen(output.directory(), now.time, model.particles, model.grid);
      statistics.reopen(statistics_file, table.columns(), now.time, communicator);
      say("\nGoing on from '" + resume->file + "', step " + std::to_string(now.step) + ".\n");
    }
    else
    {
      probes.open(output.directory(), model.particles, model.grid);
      statistics.open(statistics_file, table.columns(), communicator);
    }
    checkpoints.start(output.directory(), now, communicator);
    say(summary());
    tell_warnings();
    progress = std::make_unique<Progress>(communicator, end_time, model.particles.n_global);
  }

  template <int dim>
  void Simulation<dim>::fill_table()
  {
    table.add("time", "time", now.time);
    table.add("step", "1", [this] { return now.step; });
    table.add("step size", "time", now.dt);
    totals.add_to(table);
    energy.add_to(table);
    table.add("energy residual", "energy",
              [this] { return energy.residual(totals.kinetic_energy, totals.strain_energy); });
    if (model.account.is_on)
    {
      energy.add_losses_to(table);
      table.add("plastic work", "energy", totals.plastic_work);
      table.add("unaccounted energy", "energy", [this] {
        return energy.unaccounted(energy.residual(totals.kinetic_energy, totals.strain_energy), totals.plastic_work);
      });
    }
    table.add("lost momentum", "mass length/time", lost_momentum);
    fracture.add_to(table);
    model.boundary.add_to(table);
    model.tractions.add_to(table);
    model.contacts.add_to(table);
    references.add_to(table);
  }

  template <int dim>
  Totals<dim> Simulation<dim>::current_totals()
  {
    // The law stores the energy of its own stress.
    if (model.f_bar.is_on)
      model.f_bar.remove_added(model.particles, 0, model.particles.size());
    const auto sums = Talus::totals(model.particles, *model.transfer, model.materials, communicator);
    if (model.f_bar.is_on)
      model.f_bar.add_added(model.particles, 0, model.particles.size());
    return sums;
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
  void Simulation<dim>::say_warning(const std::string &text)
  {
    if (progress)
      progress->end_line();
    say(warning_line(text));
  }

  template <int dim>
  void Simulation<dim>::tell_warnings()
  {
    for (; n_told < parameters.warnings().size(); ++n_told)
      say_warning(parameters.warnings()[n_told]);
  }

  template <int dim>
  std::string Simulation<dim>::summary() const
  {
    std::ostringstream text;
    text << "Talus " << version() << ", " << Utilities::MPI::n_mpi_processes(communicator) << " rank(s)\n"
         << model.summary() << "  output     " << output.directory() << '\n'
         << stepper->warning(model);
    return text.str();
  }

  template class Simulation<2>;
  template class Simulation<3>;
} // namespace Talus

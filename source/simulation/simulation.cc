#include <talus/simulation/simulation.h>

#include <talus/core/exceptions.h>
#include <talus/core/libraries.h>
#include <talus/core/memory.h>

#include <iostream>

namespace Talus
{
  using namespace dealii;

  template <int dim>
  Simulation<dim>::Simulation(Parameters &parameters, const Communicator &communicator,
                              const unsigned int stage_number) :
    ParameterAcceptor("/Run"),
    communicator(communicator), parameters(parameters), resources(communicator), model(parameters, communicator),
    stepper(parameters.make<Stepper<dim>>("/Run", "Stepper", "explicit", "How the state is advanced in time.")),
    probes(parameters), references(parameters, model, communicator), stages(Stages::declare(parameters)),
    stage_number(stage_number)
  {
    AssertThrow(!model.bodies.empty(), EntryError("/Bodies", "Names", "give at least one body."));
    if (stages.empty())
      add_parameter("End time", end_time, "The run ends at this time [time].", prm, Patterns::Double());
    else
      parameters.refuse(
        EntryError("/Run", "End time", "the run has stages, and ends after their durations. Remove the entry."));
    add_parameter("Number of steps", max_steps,
                  "The run ends after this many steps if the end time is later; 0: no limit.", prm,
                  Patterns::Integer(0));
  }

  template <int dim>
  std::unique_ptr<Simulation<dim>> Simulation<dim>::make(Parameters &parameters, const Communicator &communicator,
                                                         const unsigned int stage_number)
  {
    References<dim>::allow_idle_entries(parameters);
    parameters.choose_from("", "Dimension", "2", "2|3", "Number of space dimensions; 2 is plane strain.");
    declare_libraries();
    auto simulation = std::make_unique<Simulation>(parameters, communicator, stage_number);
    parameters.parse();
    return simulation;
  }

  template <int dim>
  void Simulation<dim>::parse_parameters(ParameterHandler &)
  {
    if (!(end_time > 0))
      throw EntryError(get_section_name(), "End time", "it must be positive.");
    if (!stages.empty() && references.any())
      throw EntryError("/Stages", "Names", "runs in stages have no reference. Remove the stages, or the reference.");
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
    if (!is_finished())
      stop();
    else if (stages.empty())
      finish();
    else
      finish_stage();
  }

  template <int dim>
  void Simulation<dim>::set_up(const Resume *resume)
  {
    const Timing::Scope scope(timing, timing.add("set-up"));
    for (const auto &remark : model.grid.remarks)
      parameters.warn(remark);
    tell_warnings(); // the system may end a run that takes its memory
    const bool begins_stage = resume != nullptr && resume->head.begins_stage;
    if (!stages.empty())
    {
      stage_begin = resume == nullptr ? 0. : begins_stage ? resume->head.time : resume->head.stage_begin;
      end_time    = stage_begin + stages.at(stage_number)->duration;
    }
    model.create([this] { references.start(model); });
    if (begins_stage)
      begin_stage(*resume);
    report = stepper->start(model, timing);
    energy.start(report, current_totals().strain_energy);
    fracture.start(model);
    Checks<dim>(parameters, model, stage_begin, end_time)
      .run(stepper->step_size(model, report), report.signal_speed, max_steps);
    return_free_memory();
  }

  template <int dim>
  void Simulation<dim>::advance()
  {
    now.dt            = stepper->step_size(model, report);
    double       stop = references.next_stop(now.time, end_time);
    const double next = output.next_stop(now.time);
    if (next < stop)
    {
      stop = next;
      if (now.time + now.dt < stop && now.time + 2 * now.dt > stop)
        now.dt = 0.5 * (stop - now.time); // two equal steps, and not a whole and a tiny one
    }
    const bool stops = now.time + now.dt >= stop * (1 - 1e-12);
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
      if (progress)
        progress->end_line();
      say(report.news + now.text() + ".\n");
    }
    energy.check(model, report, now);
    most_kinetic_energy = std::max(most_kinetic_energy, report.kinetic_energy);
    if (now.step % energy.interval == 0 || is_finished())
    {
      energy.check_total(model, report, current_totals().strain_energy, now);
      check_obstacles();
      look_for_fracture();
      look_for_rest();
    }
  }

  template <int dim>
  void Simulation<dim>::check_obstacles() const
  {
    // Those that press on one lie a part of a spacing deep in it.
    for (const auto &obstacle : model.boundary.obstacles)
      if (const auto found = particles_in(*obstacle, model, now.time, model.grid.largest_spacing); found.first > 0)
        throw RunError("The obstacle '" + obstacle->name + "' has not held " + std::to_string(found.first) +
                       " particle(s)," + now.text() + ": the deepest in it is " + found.second +
                       ". It must be two spacings thick at least, and no edge may be sharper: take a smaller spacing.");
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
    if (output.is_statistics_due(now.time, now.dt, now.step) || is_finished())
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

  template class Simulation<2>;
  template class Simulation<3>;
} // namespace Talus

#include <talus/simulation/simulation.h>

#include <talus/core/command_line.h>
#include <talus/core/exceptions.h>

#include <fstream>
#include <sstream>

namespace Talus
{
  using namespace dealii;

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
      std::ofstream used(output.directory() + "/parameters" +
                         (stage_number == 0 ? "" : "_" + stages[stage_number]->name) + ".prm");
      parameters.print(used, /* with_help = */ false);
      AssertThrow(log && used.flush(), RunError("Cannot write into the directory '" + output.directory() + "'."));
    }
    fill_table();
    if (resume)
    {
      probes.reopen(output.directory(), now.time, model.particles, model.grid);
      reopen_statistics(*resume);
      say(resume->head.begins_stage ?
            "\nStage " + stage_name() + " begins" + now.text() + ".\n" :
            "\nGoing on from '" + resume->file + "', step " + std::to_string(now.step) + ".\n");
    }
    else
    {
      probes.open(output.directory(), model.particles, model.grid);
      statistics.open(output.directory() + "/statistics.csv", table.columns(), communicator);
    }
    checkpoints.start(output.directory(), now, communicator);
    say(summary());
    tell_warnings();
    progress = std::make_unique<Progress>(communicator, end_time, model.particles.n_global);
  }

  template <int dim>
  void Simulation<dim>::reopen_statistics(const Resume &resume)
  {
    // Other conditions and loads have other columns: a table of their own.
    std::string file = output.directory() + "/statistics.csv";
    if (stage_number > 0 && !CsvFile::is_of(file, table.columns(), communicator))
    {
      CsvFile::check(file, communicator);
      file = output.directory() + "/statistics_" + stages[stage_number]->name + ".csv";
      if (resume.head.begins_stage)
      {
        statistics.open(file, table.columns(), communicator);
        return;
      }
    }
    statistics.reopen(file, table.columns(), now.time, communicator);
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
  std::string Simulation<dim>::summary() const
  {
    std::ostringstream text;
    text << "Talus " << version() << ", " << Utilities::MPI::n_mpi_processes(communicator) << " rank(s)\n"
         << model.summary() << "  output     " << output.directory() << '\n'
         << stepper->warning(model);
    return text.str();
  }

#define INSTANTIATE(dim)                                                                                               \
  template void        Simulation<dim>::open_output(const Resume *);                                                   \
  template void        Simulation<dim>::reopen_statistics(const Resume &);                                             \
  template void        Simulation<dim>::fill_table();                                                                  \
  template std::string Simulation<dim>::summary() const;
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Talus

#include <talus/simulation/simulation.h>

#include <talus/core/command_line.h>
#include <talus/core/exceptions.h>
#include <talus/core/json.h>

#include <array>
#include <filesystem>

#include <unistd.h>

namespace Talus
{
  using namespace dealii;

  template <int dim>
  void Simulation<dim>::start_log(const bool goes_on)
  {
    std::array<char, 256> host{};
    gethostname(host.data(), host.size() - 1);
    log.open(output.directory() + "/log.txt", goes_on ? std::ios::app : std::ios::out);
    log << date() << " started on " << host.data() << " in '" << std::filesystem::current_path().string() << "', "
        << Utilities::MPI::n_mpi_processes(communicator) << " rank(s): " << origin << std::endl;
    for (unsigned int k = 0; k < n_told; ++k)
      log << warning_line(parameters.warnings()[k]);
  }

  template <int dim>
  void Simulation<dim>::to_the_end(const std::function<void()> &work)
  {
    try
    {
      work();
    }
    catch (const EntryError &error)
    {
      note_failure(InputError(parameters.locate(error)));
      throw;
    }
    catch (const std::exception &error)
    {
      note_failure(error);
      throw;
    }
    const std::string end = is_to_go_on() ? "stage " + stage_name() + " done" :
                            is_finished() && !model.requests.is_stopped() ?
                                            "done" :
                                            "signal " + std::to_string(model.requests.signal_number()) + " (" +
                                              model.requests.signal_name() + ")";
    log << date() << " ended: " << end << std::endl;
    write_summary(end);
  }

  template <int dim>
  void Simulation<dim>::note_failure(const std::exception &error)
  {
    is_alone                   = is_alone || !all_ranks_failed();
    const bool        is_input = dynamic_cast<const InputError *>(&error) != nullptr;
    const std::string text = date() + " ended: " + (is_input ? "wrong input. " : "failed. ") + message_of(error) + '\n';
    if (log.is_open())
    {
      log << text << std::flush;
      write_summary(is_input ? "wrong input" : "failed", message_of(error));
    }
    else if (is_alone && progress) // the first rank knows nothing of it, and will be ended
      std::ofstream(output.directory() + "/log.txt", std::ios::app) << text;
  }

  template <int dim>
  void Simulation<dim>::write_summary(const std::string &end, const std::string &message) const
  {
    if (!log.is_open()) // on the first rank alone
      return;
    JsonObject statistics, all;
    const auto row = table.row();
    for (unsigned int c = 0; c < row.size(); ++c)
      statistics.add(table.columns()[c].name + " [" + table.columns()[c].unit + "]", row[c]);
    all.add("program", "talus " + version());
    all.add("origin", origin);
    all.add("ended", end);
    all.add("message", message);
    all.add("date", date());
    all.add("ranks", Utilities::MPI::n_mpi_processes(communicator));
    all.add("particles", static_cast<double>(model.particles.n_global));
    all.add("steps", now.step);
    all.add("time [time]", now.time);
    all.add("wall time [s]", std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    all.add("warnings", parameters.warnings());
    all.add("statistics", statistics);
    // A run that has ended is not made to fail by its summary.
    std::ofstream(output.directory() + "/summary.json") << all.text() << std::endl;
  }

  template <int dim>
  void Simulation<dim>::step()
  {
    std::string problem;
    bool        is_whole = false;
    try
    {
      advance();
      is_whole = true;
      check();
      return;
    }
    catch (const RunError &error)
    {
      problem = error.message;
    }
    if (!is_whole)
      problem += " It was the step after" + now.text() + ".";
    throw RunError(problem + write_failure(is_whole));
  }

  template <int dim>
  std::string Simulation<dim>::write_failure(const bool is_whole)
  {
    is_alone = !all_ranks_failed();
    try
    {
      const bool has_grid = is_whole && !is_alone;
      return " The state at the failure is in '" +
             output.write_failure(now.time, now.step, model.particles, has_grid ? &model.grid : nullptr,
                                  is_alone ? MPI_COMM_SELF : static_cast<MPI_Comm>(communicator)) +
             "'.";
    }
    catch (const RunError &error)
    {
      return " " + error.message;
    }
  }

  template <int dim>
  void Simulation<dim>::stop()
  {
    progress->finish(now.time, now.step);
    const std::string &resumed = trial.begin == nullptr ? output.directory() : trial.begin->directory;
    say(timing.table() + stepper->summary() + resources.traffic(now.step - first_step) +
        resources.memory(model.particles.n_global) + "Stopped by " + model.requests.signal_name() + now.text() +
        ". It goes on with: talus --resume " + resumed + "\nCheckpoint " +
        (trial.begin == nullptr ? last_checkpoint : trial.begin->file) + '\n');
  }

#define INSTANTIATE(dim)                                                                                               \
  template void        Simulation<dim>::start_log(const bool);                                                         \
  template void        Simulation<dim>::to_the_end(const std::function<void()> &);                                     \
  template void        Simulation<dim>::note_failure(const std::exception &);                                          \
  template void        Simulation<dim>::write_summary(const std::string &, const std::string &) const;                 \
  template void        Simulation<dim>::step();                                                                        \
  template std::string Simulation<dim>::write_failure(const bool);                                                     \
  template void        Simulation<dim>::stop();
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Talus

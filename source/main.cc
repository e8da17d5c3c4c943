#include <talus/core/command_line.h>
#include <talus/core/exceptions.h>
#include <talus/core/libraries.h>
#include <talus/core/parameters.h>
#include <talus/core/requests.h>
#include <talus/simulation/element.h>
#include <talus/simulation/help_topics.h>
#include <talus/simulation/list.h>
#include <talus/simulation/parameter_sweep.h>
#include <talus/simulation/resume.h>
#include <talus/simulation/safety_search.h>
#include <talus/simulation/simulation.h>
#include <talus/simulation/stages.h>

#include <deal.II/base/mpi.h>

#include <commit.h>

#include <algorithm>
#include <iostream>
#include <memory>
#include <optional>

using namespace Talus;

namespace
{
  std::string program() { return "talus " + version() + " (commit " + TALUS_COMMIT + ")"; }

  bool is_root() { return dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0; }

  void say(const std::string &text)
  {
    if (is_root())
      std::cout << text;
  }

  /** Runs and single points have files of their own. */
  void check_kind(const Parameters &parameters, const CommandLine &command_line)
  {
    const std::string file = command_line.file_name;
    AssertThrow(command_line.is_element || !parameters.has_section("Element"),
                InputError(file +
                           ": the section 'Element' is of a single point, not of a run. Start it with 'talus "
                           "--element " +
                           file + "', or remove the section."));
    for (const char *section : {"Run", "Grid", "Bodies"})
      AssertThrow(!command_line.is_element || !parameters.has_section(section),
                  InputError(file + ": the section '" + section +
                             "' is of a run, not of a single point. Leave out "
                             "--element, or give a file with 'Materials', 'Element' and 'Output'; 'include' shares "
                             "materials between files."));
  }

  void run_element(Parameters &parameters, const CommandLine &command_line)
  {
    Element element(parameters);
    parameters.parse();
    if (!command_line.prints_parameters)
      element.run();
    else if (is_root())
      parameters.print(std::cout, /* with_help = */ true);
  }

  /** Runs a stage, or what the file has if that has none; the directory of its output if another one follows. */
  template <int dim>
  std::string run(Parameters &parameters, const CommandLine &command_line, const Resume *resume,
                  const unsigned int stage)
  {
    const auto        simulation = Simulation<dim>::make(parameters, MPI_COMM_WORLD, stage);
    const std::string origin     = program() + ", " + command_line.text;
    if (command_line.only_checks)
    {
      simulation->try_start();
      return "";
    }
    if (resume != nullptr)
      simulation->go_on(*resume, Resume::changes(command_line.overrides, "Run/End time"), origin);
    else if (!command_line.prints_parameters)
      simulation->run(origin);
    else
    {
      if (is_root())
        parameters.print(std::cout, /* with_help = */ true);
      return "";
    }
    return simulation->is_to_go_on() ? simulation->directory() : "";
  }

  /** `work` of the parameters of a stage; what is wrong with an entry is said with its place in the file. */
  template <class Work>
  void with_parameters(Parameters parameters, const Work &work)
  {
    try
    {
      work(parameters);
    }
    catch (const EntryError &error)
    {
      throw InputError(parameters.locate(error));
    }
  }

  /** A stage that is a search; the directory of the run's output, from where the next one goes on. */
  template <int dim>
  std::string search(const Stages &stages, const CommandLine &command_line, const Resume &begin,
                     const unsigned int stage)
  {
    const std::string directory = begin.directory;
    SafetySearch<dim> search(stages, stage, begin, program() + ", " + command_line.text, MPI_COMM_WORLD);
    return search.run() ? directory : "";
  }

  template <int dim>
  void run_stages(const Parameters &file, const CommandLine &command_line, std::optional<Resume> &resume)
  {
    const Stages       stages(file);
    const unsigned int first = resume ? resume->head.stage : 0, n = std::max(stages.size(), 1u);
    AssertThrow(first < n, InputError("the checkpoint is of stage " + std::to_string(first + 1) + ", and the run has " +
                                      std::to_string(n) + ". It was changed."));
    AssertThrow(!resume || !resume->head.begins_stage || first > 0,
                InputError("the checkpoint begins a stage, and the run's first one begins without. It was changed."));
    // What is wrong in a later stage is said before the first one runs.
    for (unsigned int stage = first + 1; stage < n; ++stage)
      with_parameters(stages.parameters(stage),
                      [&](Parameters &parameters) { Simulation<dim>::make(parameters, MPI_COMM_WORLD, stage); });
    std::string directory;
    for (unsigned int stage = first; stage == first || (stage < n && !directory.empty()); ++stage)
    {
      if (stage > first)
        resume.emplace(directory, MPI_COMM_WORLD);
      if (stages.searches(stage))
        directory = search<dim>(stages, command_line, *resume, stage);
      else
        with_parameters(stages.parameters(stage), [&](Parameters &parameters) {
          directory = run<dim>(parameters, command_line, resume ? &*resume : nullptr, stage);
        });
      resume.reset();
    }
  }

  void run_file(const CommandLine &command_line)
  {
    std::optional<Resume> resume;
    if (!command_line.directory.empty())
      resume.emplace(command_line.directory, MPI_COMM_WORLD);
    Parameters parameters =
      resume ? resume->parameters(command_line.overrides) : Parameters(command_line.file_name, command_line.overrides);
    check_kind(parameters, command_line);
    with_parameters(parameters, [](const Parameters &all) { load_libraries(all); });
    if (command_line.is_element)
      with_parameters(parameters, [&](Parameters &element) { run_element(element, command_line); });
    else if (parameters.value("", "Dimension", "2") == "2")
      run_stages<2>(parameters, command_line, resume);
    else
      run_stages<3>(parameters, command_line, resume);
  }
  /** Runs one after the other; the greatest exit status of them. */
  int run_sweep(const CommandLine &command_line)
  {
    ParameterSweep    sweep(command_line.sweeps);
    const std::string directory =
      Parameters(command_line.file_name, command_line.overrides).value("/Output", "Directory", "output");
    int worst = 0;
    for (unsigned int number = 0; number < sweep.size(); ++number)
    {
      CommandLine       one       = command_line;
      const auto        overrides = sweep.overrides(number);
      const std::string place     = directory + "/" + sweep.name(number);
      one.overrides.insert(one.overrides.end(), overrides.begin(), overrides.end());
      one.overrides.push_back("Output/Directory = " + place);
      std::string text = "Run " + sweep.name(number) + " of " + std::to_string(sweep.size());
      for (const auto &entry : overrides)
        text += ", " + entry;
      say(text + '\n');
      const int status = exit_status([&] { run_file(one); });
      worst            = std::max(worst, status);
      if (is_root() && !command_line.only_checks)
        sweep.note(directory, number, status);
      if (dealii::Utilities::MPI::logical_or(Requests::is_signal_noted(), MPI_COMM_WORLD))
      {
        say("The sweep ends here. Go on with the run that was stopped by: talus --resume " + place + '\n');
        break;
      }
    }
    return worst;
  }
} // namespace

int main(int argc, char **argv)
{
  // PETSc, where deal.II has it, warns of words that are none of its own.
  int                                      n_words = 1;
  dealii::Utilities::MPI::MPI_InitFinalize mpi(n_words, argv, /* max_num_threads = */ 1);
  int                                      worst  = 0; // of a sweep
  const int                                status = exit_status([&]() {
    const CommandLine command_line(argc, argv);
    if (!command_line.sweeps.empty() && !command_line.wants_help)
      worst = run_sweep(command_line);
    else if (command_line.wants_help)
      say(command_line.topic.empty() ? CommandLine::help() : parameters_on(command_line.topic));
    else if (command_line.wants_version && is_root())
      std::cout << program() << " on deal.II " << DEAL_II_PACKAGE_VERSION << '\n';
    else if (command_line.wants_list && is_root())
      list_registered(std::cout);
    else if (command_line.prints_parameters && command_line.file_name.empty())
      say(parameters_on(""));
    else if (!command_line.file_name.empty() || !command_line.directory.empty())
      run_file(command_line);
  });
  return std::max(status, worst);
}

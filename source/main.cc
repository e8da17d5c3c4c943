#include <talus/core/command_line.h>
#include <talus/core/exceptions.h>
#include <talus/core/parameters.h>
#include <talus/simulation/element.h>
#include <talus/simulation/list.h>
#include <talus/simulation/resume.h>
#include <talus/simulation/simulation.h>

#include <deal.II/base/mpi.h>

#include <commit.h>

#include <iostream>
#include <optional>

using namespace Talus;

namespace
{
  std::string program() { return "talus " + version() + " (commit " + TALUS_COMMIT + ")"; }

  bool is_root() { return dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0; }

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

  template <int dim>
  void run(Parameters &parameters, const CommandLine &command_line, const Resume *resume)
  {
    References<dim>::allow_idle_entries(parameters);
    parameters.choose_from("", "Dimension", "2", "2|3", "Number of space dimensions; 2 is plane strain.");
    Simulation<dim> simulation(parameters, MPI_COMM_WORLD);
    parameters.parse();
    const std::string origin = program() + ", " + command_line.text;
    if (resume != nullptr)
      simulation.go_on(*resume, Resume::changes(command_line.overrides, "Run/End time"), origin);
    else if (!command_line.prints_parameters)
      simulation.run(origin);
    else if (is_root())
      parameters.print(std::cout, /* with_help = */ true);
  }

  void run_file(const CommandLine &command_line)
  {
    std::optional<Resume> resume;
    if (!command_line.directory.empty())
      resume.emplace(command_line.directory, MPI_COMM_WORLD);
    Parameters parameters =
      resume ? resume->parameters(command_line.overrides) : Parameters(command_line.file_name, command_line.overrides);
    check_kind(parameters, command_line);
    try
    {
      if (command_line.is_element)
        run_element(parameters, command_line);
      else if (parameters.value("", "Dimension", "2") == "2")
        run<2>(parameters, command_line, resume ? &*resume : nullptr);
      else
        run<3>(parameters, command_line, resume ? &*resume : nullptr);
    }
    catch (const EntryError &error)
    {
      throw InputError(parameters.locate(error));
    }
  }
} // namespace

int main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, /* max_num_threads = */ 1);
  return exit_status([&]() {
    const CommandLine command_line(argc, argv);
    if (command_line.wants_help && is_root())
      std::cout << CommandLine::help();
    else if (command_line.wants_version && is_root())
      std::cout << program() << " on deal.II " << DEAL_II_PACKAGE_VERSION << '\n';
    else if (command_line.wants_list && is_root())
      list_registered(std::cout);
    else if (!command_line.file_name.empty() || !command_line.directory.empty())
      run_file(command_line);
  });
}

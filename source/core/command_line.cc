#include <talus/core/command_line.h>
#include <talus/core/exceptions.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <chrono>
#include <iostream>
#include <new>
#include <sstream>
#include <thread>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    std::string quoted(const std::string &word)
    {
      const bool  is_plain = !word.empty() && word.find_first_of(" \t\n\"'\\\\$;&|<>*?()#`") == std::string::npos;
      std::string text     = word;
      for (std::size_t at = 0; (at = text.find('\'', at)) != std::string::npos; at += 4)
        text.replace(at, 1, "'\\''");
      return is_plain ? word : "'" + text + "'";
    }

    bool is_file(const std::string &word) { return word.size() > 4 && word.compare(word.size() - 4, 4, ".prm") == 0; }
  } // namespace

  CommandLine::CommandLine(int argc, char **argv)
  {
    for (int i = 0; i < argc; ++i)
      text += (i > 0 ? " " : "") + quoted(argv[i]);
    for (int i = 1; i < argc; ++i)
    {
      const std::string word = argv[i];
      if (word == "--help" || word == "-h")
      {
        wants_help = true;
        if (i + 1 < argc && argv[i + 1][0] != '-' && !is_file(argv[i + 1]))
          topic = argv[++i];
      }
      else if (word == "--version")
        wants_version = true;
      else if (word == "--list")
        wants_list = true;
      else if (word == "--parameters")
        prints_parameters = true;
      else if (word == "--element")
        is_element = true;
      else if (word == "--check")
        only_checks = true;
      else if (word == "--set")
      {
        AssertThrow(i + 1 < argc, InputError("--set needs \"Section/Entry = value\" after it."));
        overrides.push_back(argv[++i]);
      }
      else if (word == "--sweep")
      {
        AssertThrow(i + 1 < argc, InputError("--sweep needs \"Section/Entry = value | value\" after it."));
        sweeps.push_back(argv[++i]);
      }
      else if (word == "--resume")
      {
        AssertThrow(i + 1 < argc, InputError("--resume needs the directory of the run that is to go on after it."));
        directory = argv[++i];
        AssertThrow(!directory.empty(), InputError("--resume: the directory has no name."));
      }
      else
      {
        AssertThrow(word[0] != '-', InputError("Unknown option '" + word + "'. Try talus --help."));
        AssertThrow(file_name.empty(),
                    InputError("Two parameter files, '" + file_name + "' and '" + word + "'. Give one."));
        file_name = word;
      }
    }
    AssertThrow(directory.empty() || !is_element,
                InputError("--element has no checkpoints to go on from. Leave out --resume, and give a file."));
    AssertThrow(sweeps.empty() || (!file_name.empty() && !prints_parameters),
                InputError("--sweep makes runs of a parameter file: give one, and leave out --resume and --parameters."));
    AssertThrow(!only_checks || (directory.empty() && !is_element && !prints_parameters),
                InputError("--check looks at the file of a run. Leave out --resume, --element and --parameters."));
    AssertThrow(directory.empty() || (file_name.empty() && !prints_parameters),
                InputError("--resume takes the parameters from the checkpoint. Leave out the parameter file and "
                           "--parameters; --set may change some entries."));
    AssertThrow(!file_name.empty() || !directory.empty() || (prints_parameters && !is_element) || wants_help ||
                  wants_version || wants_list,
                InputError("No parameter file given. Try talus --help."));
  }

  std::string CommandLine::help()
  {
    return "Talus: the material point method on deal.II\n"
           "\n"
           "  talus FILE.prm [--set \"Section/Entry = value\"]...   run\n"
           "  talus --sweep \"Section/Entry = a | b\"... FILE.prm   a run for each combination, in numbered directories\n"
           "  talus --resume DIRECTORY [--set ...]...             go on with a run from its last checkpoint\n"
           "  talus --check FILE.prm [--set ...]...               how many steps, time and memory it takes; no output\n"
           "  talus --element FILE.prm [--set ...]...             take a single point of a material along a path\n"
           "  talus --parameters [--element] FILE.prm             print all entries of the chosen objects, with help\n"
           "  talus --parameters                                  the same of a file with one object of each kind\n"
           "  talus --help \"SECTION\" | \"SECTION/OBJECT\"          a part of it: \"Run\", \"Materials/Drucker-Prager\"\n"
           "  talus --list                                        print all kernels, transfers, materials, ...\n"
           "  talus --help | --version\n"
           "\n"
           "In parallel: mpirun -n RANKS talus FILE.prm\n"
           "Exit status: 0 done, 1 wrong input, 2 the run failed.\n";
  }

  std::string version() { return TALUS_VERSION; }

  std::string message_of(const std::exception &error)
  {
    if (dynamic_cast<const std::bad_alloc *>(&error) != nullptr)
      return "The memory of this machine is used up. Take fewer particles, a larger spacing, or more machines.";
    std::ostringstream text;
    if (const auto *exception = dynamic_cast<const ExceptionBase *>(&error))
      exception->print_info(text);
    else
      text << error.what();
    std::string message = text.str();
    while (!message.empty() && std::isspace(message.back()))
      message.pop_back();
    // One line, and nothing that a terminal obeys.
    std::replace_if(
      message.begin(), message.end(), [](const unsigned char letter) { return letter < 32 || letter == 127; }, ' ');
    return shortened(message, 1000);
  }

  bool all_ranks_failed()
  {
    MPI_Request request;
    int         has_arrived = 0;
    MPI_Ibarrier(MPI_COMM_WORLD, &request);
    for (unsigned int i = 0; i < 200 && !has_arrived; ++i)
    {
      MPI_Test(&request, &has_arrived, MPI_STATUS_IGNORE);
      std::this_thread::sleep_for(std::chrono::milliseconds(has_arrived ? 0 : 10));
    }
    return has_arrived;
  }

  int exit_status(const std::function<void()> &program)
  {
    int         status = 0;
    std::string message;
    try
    {
      program();
      return 0;
    }
    catch (const InputError &error)
    {
      status  = 1;
      message = message_of(error);
    }
    catch (const std::exception &error)
    {
      status  = 2;
      message = message_of(error);
    }
    // An error that all ranks share is told by the first; of one rank's own error the others know nothing.
    const bool is_shared = all_ranks_failed();
    if (!is_shared || Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      std::cerr << "talus: " << message << std::endl;
    if (!is_shared)
      MPI_Abort(MPI_COMM_WORLD, status);
    return status;
  }
} // namespace Talus

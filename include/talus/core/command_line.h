#pragma once

#include <functional>
#include <string>
#include <vector>

namespace Talus
{
  /** What the user asked for. Throws InputError for what it does not understand. */
  struct CommandLine
  {
    CommandLine(int argc, char **argv);

    static std::string help();

    std::string              text; // as a shell would take it
    std::string              file_name;
    std::string              topic;     // of --help and --parameters without a file
    std::string              directory; // of the run that is to go on
    std::vector<std::string> overrides, sweeps;
    bool                     wants_help = false, wants_version = false, wants_list = false, prints_parameters = false;
    bool                     is_element  = false; // the file is of a single point
    bool                     only_checks = false; // what the run would be
  };

  std::string version();

  /**
   * Runs the program and turns what it throws into the exit status: 0 done, 1
   * wrong input, 2 the run failed. The message is written once, whatever the
   * number of ranks; an error on some ranks only ends the others too.
   */
  int exit_status(const std::function<void()> &program);

  /** The message of an error, of a thousand letters at most. */
  std::string message_of(const std::exception &error);

  /** Whether all ranks get here within two seconds, and so have failed alike. */
  bool all_ranks_failed();
} // namespace Talus

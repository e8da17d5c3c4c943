#pragma once

#include <talus/postprocess/directory_lock.h>

#include <mpi.h>

#include <functional>
#include <ostream>
#include <string>

namespace Talus
{
  /**
   * Creates the directory into which a run writes. An old one that is not empty is
   * refused, or with `overwrite` cleared of the files that a run writes; others
   * stay. Takes the lock on the first rank. Throws an EntryError for `entry` of
   * `section` on all ranks. Collective.
   */
  void prepare_directory(const std::string &directory, const bool overwrite, DirectoryLock &lock,
                         const std::string &section, const std::string &entry, MPI_Comm communicator);

  /** Removes particles_NNNNN.vtu, grid_NNNNN.vtu, ... from number `first` on, and unfinished files. Throws RunError. */
  void remove_numbered_files(const std::string &directory, const unsigned int first);

  /** True for the name of a file that Talus writes into its output directory and may remove there. */
  bool is_output_file(const std::string &name);

  /**
   * Writes a file under a temporary name and renames it: whoever opens `path` sees
   * the old file or the whole new one. Throws RunError.
   */
  void write_complete_file(const std::string &path, const std::function<void(std::ostream &)> &write);

  /** Gives a finished file its final name. Throws RunError. */
  void rename_file(const std::string &temporary, const std::string &path);

  /** As long as one is there, stderr of this rank goes nowhere: MPI writes its own words of a full disk there. */
  class QuietErrors
  {
  public:
    QuietErrors();
    ~QuietErrors();
    QuietErrors(const QuietErrors &) = delete;

  private:
    int stderr_before;
  };

  /** Runs `work` on rank 0; a RunError there is thrown on all ranks. Collective. */
  void run_on_root(const std::function<void()> &work, MPI_Comm communicator);

  /** Appends `value` with as many digits as determine it, 17 at most. */
  void append_number(std::string &text, const double value);
} // namespace Talus

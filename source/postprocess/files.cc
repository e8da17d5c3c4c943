#include <talus/core/exceptions.h>
#include <talus/postprocess/files.h>

#include <deal.II/base/mpi.h>

#include <charconv>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <regex>

#include <fcntl.h>
#include <unistd.h>

namespace Talus
{
  using namespace dealii;
  namespace fs = std::filesystem;

  namespace
  {
    /** Why no directory can be made at `path`; names a file that stands in its way. */
    std::string why_not_created(const fs::path &path, const std::error_code &error)
    {
      std::error_code ignored;
      for (fs::path part = path; !part.empty() && part != part.root_path(); part = part.parent_path())
        if (fs::exists(part, ignored) && !fs::is_directory(part, ignored))
          return "cannot create the directory '" + path.string() + "': '" + part.string() +
                 "' is a file. Choose another directory.";
      return "cannot create the directory '" + path.string() + "': " + error.message() + ". Choose another directory.";
    }

    bool is_writable(const fs::path &directory)
    {
      const fs::path  file = directory / "talus_is_writable.tmp";
      const bool      is_good(std::ofstream(file).good());
      std::error_code ignored;
      fs::remove(file, ignored);
      return is_good;
    }

    /** Removes the files of an old run; returns what is wrong, or nothing. */
    std::string clear(const fs::path &directory)
    {
      std::error_code       error;
      std::vector<fs::path> old_files;
      for (const auto &entry : fs::directory_iterator(directory, error))
        if (is_output_file(entry.path().filename().string()))
          old_files.push_back(entry.path());
      for (const auto &file : old_files)
        if (!error)
          fs::remove(file, error);
      return error ? "cannot remove the old files in '" + directory.string() + "': " + error.message() +
                       ". Choose another directory." :
                     "";
    }

    std::string prepare(const std::string &directory, const bool overwrite, DirectoryLock &lock)
    {
      if (directory.empty())
        return "the directory has no name. Give one; '.' is the one talus is started in.";
      const fs::path  path(directory);
      std::error_code error;
      fs::create_directories(path, error);
      // An old file of this name is no error to create_directories().
      if (error || !fs::is_directory(path))
        return why_not_created(path, error);
      const bool is_empty = fs::is_empty(path, error);
      if (error)
        return "cannot read the directory '" + directory + "': " + error.message() + ". Choose another directory.";
      if (!is_empty && !overwrite)
        return "the directory '" + directory +
               "' is not empty. Set 'Overwrite' to true to replace the files of an old run, "
               "or choose another directory.";
      if (!is_writable(path))
        return "the directory '" + directory + "' is not writable. Change its permissions or choose another directory.";
      const std::string problem = lock.take(directory);
      return problem.empty() ? clear(path) : problem;
    }
  } // namespace

  void prepare_directory(const std::string &directory, const bool overwrite, DirectoryLock &lock,
                         const std::string &section, const std::string &entry, MPI_Comm communicator)
  {
    std::string problem;
    if (Utilities::MPI::this_mpi_process(communicator) == 0)
      problem = prepare(directory, overwrite, lock);
    problem = Utilities::MPI::broadcast(communicator, problem);
    if (!problem.empty())
      throw EntryError(section, entry, problem);
  }

  bool is_output_file(const std::string &name)
  {
    // parameters.prm is not among them: it may be the very file from which the run is repeated.
    static const std::regex pattern(
      "((particles|grid|fem)(_[0-9]{5,})?\\.(vtu|pvtu|pvd|csv|h5|xdmf)|checkpoint_[0-9]{8,10}\\.h5|"
      "failure_(grid_)?[0-9]{8,10}(\\.rank[0-9]+)?\\.(vtu|csv)|"
      "((statistics|safety)(_[^/]+)?|probes|element|comparison|load_curve|verification)\\.csv|log\\.txt|summary\\.json)(\\.tmp)?");
    return std::regex_match(name, pattern);
  }

  void remove_numbered_files(const std::string &directory, const unsigned int first)
  {
    static const std::regex pattern("(?:particles|grid)(?:_([0-9]{5,9}))?\\.(?:vtu|pvd|csv|h5|xdmf)(\\.tmp)?"),
      of_failure("failure_.*\\.tmp");
    std::error_code       error;
    std::vector<fs::path> old;
    for (const auto &entry : fs::directory_iterator(directory, error))
    {
      std::smatch       match;
      const std::string name = entry.path().filename().string();
      if ((std::regex_match(name, match, pattern) &&
           (match[2].matched || (match[1].matched && std::stoul(match[1]) >= first))) ||
          std::regex_match(name, of_failure))
        old.push_back(entry.path());
    }
    for (const auto &file : old)
      if (!error)
        fs::remove(file, error);
    AssertThrow(!error, RunError("Cannot remove old files in '" + directory + "': " + error.message() + "."));
  }

  void rename_file(const std::string &temporary, const std::string &path)
  {
    std::error_code error;
    fs::rename(temporary, path, error);
    AssertThrow(!error, RunError("Cannot write '" + path + "': " + error.message() + "."));
  }

  void write_complete_file(const std::string &path, const std::function<void(std::ostream &)> &write)
  {
    const std::string temporary = path + ".tmp";
    std::ofstream     file(temporary);
    if (file)
      write(file);
    file.close();
    if (!file)
      std::remove(temporary.c_str());
    AssertThrow(file, RunError("Cannot write '" + path + "'. Is the disk full, or the directory gone?"));
    rename_file(temporary, path);
  }

  QuietErrors::QuietErrors() : stderr_before(dup(STDERR_FILENO))
  {
    const int nothing = open("/dev/null", O_WRONLY);
    if (nothing >= 0 && stderr_before >= 0)
      dup2(nothing, STDERR_FILENO);
    if (nothing >= 0)
      close(nothing);
  }

  QuietErrors::~QuietErrors()
  {
    if (stderr_before < 0)
      return;
    dup2(stderr_before, STDERR_FILENO);
    close(stderr_before);
  }

  void run_on_root(const std::function<void()> &work, MPI_Comm communicator)
  {
    std::string problem;
    if (Utilities::MPI::this_mpi_process(communicator) == 0)
      try
      {
        work();
      }
      catch (const RunError &error)
      {
        problem = error.message;
      }
    problem = Utilities::MPI::broadcast(communicator, problem);
    AssertThrow(problem.empty(), RunError(problem));
  }

  void append_number(std::string &text, const double value)
  {
    char       buffer[32];
    const auto end = std::to_chars(buffer, buffer + sizeof(buffer), value).ptr;
    text.append(buffer, end);
  }
} // namespace Talus

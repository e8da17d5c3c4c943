#include <talus/core/exceptions.h>
#include <talus/postprocess/files.h>
#include <talus/postprocess/statistics.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>

#include <sys/stat.h>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    /** 0 if there is none. */
    std::uintmax_t number_of_file(const std::string &path)
    {
      struct stat status;
      return stat(path.c_str(), &status) == 0 ? status.st_ino : 0;
    }

    /** Whether a line holds `n` finite numbers between commas. */
    bool is_row(const std::string &line, const unsigned int n)
    {
      const char *at = line.c_str();
      for (unsigned int c = 0; c < n; ++c)
      {
        char        *end    = nullptr;
        const double number = std::strtod(at, &end);
        if (end == at || !std::isfinite(number) || *end != (c + 1 < n ? ',' : '\0'))
          return false;
        at = end + 1;
      }
      return at == line.c_str() + line.size() + 1;
    }
  } // namespace

  void CsvFile::open(const std::string &path, const std::vector<Column> &columns, MPI_Comm communicator)
  {
    this->path    = path;
    this->columns = columns;
    is_root       = Utilities::MPI::this_mpi_process(communicator) == 0;
    run_on_root(
      [&] {
        file.open(path);
        file << header(columns) << std::endl;
        number = number_of_file(path);
        AssertThrow(file, RunError("Cannot write '" + path + "'. Is the disk full, or the directory gone?"));
      },
      communicator);
  }

  void CsvFile::check_is_there() const
  {
    AssertThrow(number_of_file(path) == number,
                RunError("'" + path +
                         "' was removed or replaced while the run was writing to it. Leave the directory "
                         "of a run alone; 'talus --resume' goes on from the last checkpoint if that is still there."));
  }

  bool CsvFile::is_of(const std::string &path, const std::vector<Column> &columns, MPI_Comm communicator)
  {
    bool is_same = false;
    if (Utilities::MPI::this_mpi_process(communicator) == 0)
    {
      std::ifstream in(path);
      std::string   line;
      std::getline(in, line);
      is_same = in && line == header(columns);
    }
    return Utilities::MPI::broadcast(communicator, is_same);
  }

  std::string CsvFile::header(const std::vector<Column> &columns)
  {
    std::string header;
    for (const auto &column : columns)
      header += (header.empty() ? "" : ",") + column.name + (column.unit.empty() ? "" : " [" + column.unit + "]");
    return header;
  }

  std::uintmax_t CsvFile::length_until(const double time, const std::string &path, std::istream &in,
                                       const unsigned int n_columns)
  {
    std::uintmax_t length = 0;
    std::string    line;
    for (unsigned int number = 2; std::getline(in, line) && !in.eof() && !(std::strtod(line.c_str(), nullptr) > time);
         ++number)
    {
      AssertThrow(is_row(line, n_columns),
                  RunError("line " + std::to_string(number) + " of '" + path + "' is no row of " +
                           std::to_string(n_columns) +
                           " numbers: the file was changed. Mend or remove the line for the run to go on."));
      length += line.size() + 1;
    }
    return length;
  }

  void CsvFile::check(const std::string &path, MPI_Comm communicator)
  {
    run_on_root(
      [&] {
        std::ifstream in(path);
        std::string   line;
        std::getline(in, line);
        AssertThrow(in && line.compare(0, 4, "time") == 0,
                    RunError("'" + path +
                             "' does not begin with the names of its columns: it was changed, or is not of this run."));
        const auto length =
          line.size() + 1 +
          length_until(std::numeric_limits<double>::max(), path, in, std::count(line.begin(), line.end(), ',') + 1);
        AssertThrow(length == std::filesystem::file_size(path),
                    RunError("the last line of '" + path +
                             "' is not complete: the file was changed. Remove the line for the run to go on."));
      },
      communicator);
  }

  void CsvFile::reopen(const std::string &path, const std::vector<Column> &columns, const double time,
                       MPI_Comm communicator)
  {
    this->path    = path;
    this->columns = columns;
    is_root       = Utilities::MPI::this_mpi_process(communicator) == 0;
    run_on_root(
      [&] {
        std::ifstream in(path);
        std::string   line;
        std::getline(in, line);
        AssertThrow(in, RunError("cannot read '" + path + "', to which the run that goes on would add rows."));
        AssertThrow(line == header(columns),
                    RunError("the columns of '" + path + "' are not those of the run that goes on."));
        std::error_code error;
        std::filesystem::resize_file(path, line.size() + 1 + length_until(time, path, in, columns.size()), error);
        file.open(path, std::ios::app);
        file.seekp(0, std::ios::end);
        number = number_of_file(path);
        AssertThrow(!error && file, RunError("Cannot write '" + path + "'. Change its permissions."));
      },
      communicator);
  }

  void CsvFile::write_row(const std::vector<double> &values)
  {
    AssertDimension(values.size(), columns.size());
    std::string row;
    for (unsigned int c = 0; c < values.size(); ++c)
    {
      AssertThrow(std::isfinite(values[c]), RunError("'" + columns[c].name + "' is not a finite number when " +
                                                     columns[0].name + " = " + std::to_string(values[0]) + ", for '" +
                                                     path + "'. The run has diverged: lower the Courant number."));
      row += c == 0 ? "" : ",";
      append_number(row, values[c]);
    }
    if (!is_root)
      return;
    const auto length = file.tellp();
    file << row << std::endl;
    check_is_there();
    if (file)
      return;
    // Half a row would be none.
    std::error_code ignored;
    file.close();
    std::filesystem::resize_file(path, length, ignored);
    throw RunError("Cannot write '" + path + "'. Is the disk full?");
  }
} // namespace Talus

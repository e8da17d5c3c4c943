#include <talus/core/exceptions.h>
#include <talus/postprocess/files.h>
#include <talus/postprocess/statistics.h>

#include <deal.II/base/mpi.h>

#include <cmath>

namespace Talus
{
  using namespace dealii;

  void CsvFile::open(const std::string &path, const std::vector<Column> &columns, MPI_Comm communicator)
  {
    this->path    = path;
    this->columns = columns;
    is_root       = Utilities::MPI::this_mpi_process(communicator) == 0;
    run_on_root(
      [&] {
        std::string header;
        for (const auto &column : columns)
          header += (header.empty() ? "" : ",") + column.name + (column.unit.empty() ? "" : " [" + column.unit + "]");
        file.open(path);
        file << header << std::endl;
        AssertThrow(file, RunError("Cannot write '" + path + "'. Is the disk full, or the directory gone?"));
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
    file << row << std::endl;
    AssertThrow(file, RunError("Cannot write '" + path + "'. Is the disk full?"));
  }
} // namespace Talus

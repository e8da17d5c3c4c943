#pragma once

#include <talus/core/table.h>

#include <mpi.h>

#include <fstream>
#include <string>
#include <vector>

namespace Talus
{
  /**
   * The file of a table to which a run appends rows: first line `time [time],step [1],...`,
   * then numbers with 17 significant digits, each row complete on disk before the
   * run goes on. Rank 0 writes, the others only check. Throws RunError when the
   * file cannot be written or a number is not finite. Test: tests/postprocess.
   */
  class CsvFile
  {
  public:
    /** Creates the file; all ranks throw alike. Collective. */
    void open(const std::string &path, const std::vector<Column> &columns, MPI_Comm communicator = MPI_COMM_WORLD);

    /** One value for each column, the same on all ranks. */
    void write_row(const std::vector<double> &values);

  private:
    std::string         path;
    std::vector<Column> columns;
    std::ofstream       file;
    bool                is_root = false;
  };

  /** `statistics.csv`. */
  template <int dim>
  using Statistics = CsvFile;
} // namespace Talus

#pragma once

#include <talus/core/table.h>

#include <mpi.h>

#include <cstdint>
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

    /**
     * Goes on with a file of the same columns, of which the first is a time: rows later than `time` are cut off, and
     * one that was not finished. Throws InputError where there is no such file; all ranks throw alike. Collective.
     */
    void reopen(const std::string &path, const std::vector<Column> &columns, const double time,
                MPI_Comm communicator = MPI_COMM_WORLD);

    /** Whether there is a file of these columns. Collective. */
    static bool is_of(const std::string &path, const std::vector<Column> &columns,
                      MPI_Comm communicator = MPI_COMM_WORLD);

    /** Throws RunError where a table of other columns, to which no row is added, has been changed. Collective. */
    static void check(const std::string &path, MPI_Comm communicator = MPI_COMM_WORLD);

    /** One value for each column, the same on all ranks. */
    void write_row(const std::vector<double> &values);

  private:
    static std::string header(const std::vector<Column> &columns);

    /** Throws RunError where the file is not there any more, or another one. */
    void check_is_there() const;

    /**
     * The number of bytes of the rows of a file, whose first line has been read, up to the last one that is complete
     * and not later than `time`. Throws RunError for what is no row.
     */
    static std::uintmax_t length_until(const double time, const std::string &path, std::istream &in,
                                       const unsigned int n_columns);

    std::string         path;
    std::vector<Column> columns;
    std::ofstream       file;
    std::uintmax_t      number  = 0; // of the file in its file system
    bool                is_root = false;
  };

  /** `statistics.csv`. */
  template <int dim>
  using Statistics = CsvFile;
} // namespace Talus

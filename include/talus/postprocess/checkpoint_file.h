#pragma once

#include <talus/core/archive.h>
#include <talus/particles/working_set.h>

#include <mpi.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace Talus
{
  /** What a checkpoint says of the run it belongs to. */
  struct CheckpointHead
  {
    std::string  version;    // of the program
    std::string  parameters; // the text of a parameter file
    unsigned int step = 0;
    double       time = 0; // [time]

    unsigned int             stage        = 0; // of the run, in which the next step is
    bool                     begins_stage = false;
    double                   stage_begin  = 0; // [time]
    std::vector<std::string> bodies;           // their names
  };

  /**
   * Writes a checkpoint, an HDF5 file:
   *
   * | group or attribute | holds |
   * |---|---|
   * | attributes `format`, `version`, `parameters`, `step`, `time`, `stage`, `begins stage`, `stage begin`, `bodies`,
   * `ranks` | the head | | `particles` | a data set for each column, the particles of rank 0 first, each rank's in
   * their order in memory | | `numbers` | the archive's numbers that all ranks share, a data set for each name | |
   * `ranks` | those of each rank, one rank after the other | | `begins` | where each rank's part begins, and the end,
   * of each data set in `ranks`, and of the particles |
   *
   * Each data set has the attribute `checksum`. After HDF5's end of the file stands a line with the file's size and a
   * checksum of all its bytes: what is not complete is known before a library reads it. The file is written under a
   * temporary name and renamed. The state of the run is read and not changed. Throws RunError on all ranks. Collective.
   */
  template <int dim>
  void write_checkpoint(const std::string &path, const CheckpointHead &head, const Archive &archive,
                        const WorkingSet<dim> &particles, MPI_Comm communicator);

  /** What is wrong with a file as a checkpoint as far as its bytes tell it, or nothing. Collective. */
  std::string damage_of_checkpoint(const std::string &path, MPI_Comm communicator);

  /** A checkpoint for reading; each rank reads for itself. Throws InputError where the file is not what it should be.
   */
  class CheckpointFile
  {
  public:
    explicit CheckpointFile(const std::string &path);
    ~CheckpointFile();

    CheckpointHead head;
    unsigned int   n_ranks     = 0; // that have written it
    std::uint64_t  n_particles = 0;

    /** What this rank had, if as many ranks have written the file; else what all had: then it cannot be exact. */
    Archive archive(const unsigned int rank, const bool is_exact) const;

    /**
     * Fills the working set with what this rank had, or with an equal share. Columns of `others`, by number, the file
     * need not have. Collective.
     */
    template <int dim>
    void read(WorkingSet<dim> &particles, const bool is_exact, MPI_Comm communicator,
              const std::vector<unsigned int> &others = {}) const;

    /** Whether particles have a column of this name. */
    bool has_column(const std::string &name) const;

    /** Numbers `begin` .. end - 1 of a data set, "particles/mass". */
    std::vector<double> numbers(const std::string &name, const std::uint64_t begin, const std::uint64_t end) const;

  private:
    struct Handle;

    /** The same, into memory that is there. */
    void read_numbers(const std::string &name, const std::uint64_t begin, const std::uint64_t end, double *to) const;

    std::vector<std::string> names(const std::string &group) const;
    std::uint64_t            size(const std::string &name) const;

    /** Where each rank's part of a data set begins, and its end. */
    std::vector<std::uint64_t> begins(const std::string &name) const;

    std::string             path;
    std::unique_ptr<Handle> file;
  };
} // namespace Talus

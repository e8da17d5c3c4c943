#pragma once

#include <talus/grid/grid.h>
#include <talus/particles/particles.h>
#include <talus/postprocess/directory_lock.h>
#include <talus/postprocess/particle_fields.h>

#include <deal.II/base/data_out_base.h>
#include <deal.II/base/parameter_acceptor.h>

#include <limits>

namespace Talus
{
  /**
   * Writes what a run leaves behind for ParaView: particles_NNNNN.vtu and
   * grid_NNNNN.vtu, one file on any number of ranks, and particles.pvd, grid.pvd
   * that make them time series; on request particles_NNNNN.csv, and particles_NNNNN.h5 with particles.xdmf. Every file
   * is complete at any time. Writing reads the working set and changes nothing in it. Throws RunError when a file
   * cannot be written. Test: tests/postprocess.
   */
  template <int dim>
  class Output : public dealii::ParameterAcceptor
  {
  public:
    explicit Output(const std::string &section = "/Output");

    void parse_parameters(dealii::ParameterHandler &prm) override;

    /** Checks and creates the directory; EntryError on all ranks. Collective. */
    void open(MPI_Comm communicator);

    /**
     * The same for a run that goes on in its directory, which is locked, after serialize(): what was written later than
     * the state from which it goes on is removed. Collective.
     */
    void reopen(MPI_Comm communicator);

    /** What has been written. */
    void serialize(Archive &archive);

    /** Drops fields from those that the file chooses, of an object that is switched off; before check(). */
    void leave_out(const std::vector<std::string> &names) { Talus::leave_out(names, field_names); }

    /** Finds the chosen fields; an unknown name is an EntryError. Once, before the first write(). */
    void check(const WorkingSet<dim> &particles);

    /**
     * True in step 0 and whenever an interval has passed since the last output.
     * False once this step is written, and always when both intervals are 0.
     */
    bool is_due(const double time, const unsigned int step) const;

    /** Time of the next output by `Time interval`; infinite when that is off [time]. */
    double next_time() const { return next; }

    /** False once `step` is written; for an output at the end of a run. */
    bool is_written(const unsigned int step) const { return !times.empty() && step == last_step; }

    /** Writes all files of this output. `Particles<dim>` is a working set. Collective. */
    void write(const double time, const unsigned int step, const WorkingSet<dim> &particles, const Grid<dim> &grid);

    /**
     * Writes the state in which a run has failed, apart from the series of good ones: failure_NNNNNNNN.vtu with the
     * number of the step, and failure_grid_NNNNNNNN.vtu if a grid is given. The name of the first. Collective in
     * `communicator`, which may be one rank of several: then it is failure_NNNNNNNN.rank3.vtu.
     */
    std::string write_failure(const double time, const unsigned int step, const WorkingSet<dim> &particles,
                              const Grid<dim> *grid, MPI_Comm communicator) const;

    /** True when the state at the end of the run has yet to be written. */
    bool is_due_at_end(const unsigned int step) const { return with_final_state && !is_written(step); }

    /** Whether the tables get a row after a step of size `dt` that has led to `time`. */
    bool is_statistics_due(const double time, const double dt, const unsigned int step) const;

    /** The first time after `time` at which a step has to end for outputs or rows to be at their times; infinite if
     * none has. */
    double next_stop(const double time) const;

    /** Without a slash at its end. */
    const std::string &directory() const { return path; }

  private:
    void        write_series(const std::string &name) const;
    void        write_hdf5_series() const;
    void        find_next();
    std::string file_name(const std::string &name, const unsigned int number, const std::string &ending) const;

    std::string              path                = "output";
    bool                     overwrite           = false;
    double                   time_interval       = 0; // [time]
    double                   row_interval        = 0; // of the statistics [time]
    bool                     is_exact            = false;
    unsigned int             step_interval       = 0;
    unsigned int             statistics_interval = 1;
    std::vector<std::string> field_names{"velocity", "stress", "von Mises stress", "pressure", "displacement"};
    bool with_grid = true, with_whole_grid = false, with_csv = false, with_hdf5 = false, with_final_state = true;

    DirectoryLock                   lock;
    MPI_Comm                        communicator = MPI_COMM_NULL;
    std::vector<ParticleField<dim>> fields;
    std::vector<double>             times;         // of all outputs so far
    std::vector<double>             numbers;       // of particles in their HDF5 files; -1: there is none
    unsigned int                    last_step = 0; // of the last of them
    double                          next      = std::numeric_limits<double>::infinity();
  };
} // namespace Talus

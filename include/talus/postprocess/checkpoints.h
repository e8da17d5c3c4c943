#pragma once

#include <talus/postprocess/checkpoint_file.h>
#include <talus/steppers/report.h>

#include <deal.II/base/parameter_acceptor.h>

#include <chrono>

namespace Talus
{
  /**
   * When a run writes checkpoints, and which it keeps: checkpoint_NNNNNNNN.h5 with the number of the step, in the
   * directory of its output. Test: tests/checkpoint.
   */
  class Checkpoints : public dealii::ParameterAcceptor
  {
  public:
    explicit Checkpoints(const std::string &section = "/Checkpoints");

    void parse_parameters(dealii::ParameterHandler &prm) override;

    /** Before the first step, which leads on from `now`: removes what was written after it, or not to the end. */
    void start(const std::string &directory, const Moment &now, MPI_Comm communicator);

    /** Whether the time by the clock is over, as this rank sees it. */
    bool is_due_by_clock() const;

    /** Whether a checkpoint is due after a step, but by the clock. */
    bool is_due(const Moment &now) const;

    /** Writes one, then removes those that are too many; the name of the file. Throws RunError. Collective. */
    template <int dim>
    std::string write(const CheckpointHead &head, const Archive &archive, const WorkingSet<dim> &particles);

    struct File
    {
      unsigned long step;
      std::string   path;
    };

    /** The files of a directory, the newest first; none where there is no such directory. */
    static std::vector<File> files(const std::string &directory);

  private:
    using Clock = std::chrono::steady_clock;

    std::string name(const unsigned int step) const;

    unsigned int step_interval = 0, n_kept = 2;
    double       time_interval  = 0;    // [time]
    double       clock_interval = 3600; // [s]

    std::string       directory;
    MPI_Comm          communicator = MPI_COMM_NULL;
    double            last_time    = 0; // of the last checkpoint, or the start [time]
    Clock::time_point last;
  };
} // namespace Talus

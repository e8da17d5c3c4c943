#pragma once

#include <mpi.h>

#include <chrono>
#include <cstdint>
#include <iosfwd>
#include <string>

namespace Talus
{
  /**
   * Tells how far a run is: step, time, percent, particles, remaining time. On a
   * terminal one line that is rewritten at most five times a second, elsewhere (a
   * batch log) a line a minute. Rank 0 alone writes.
   */
  class Progress
  {
  public:
    Progress(MPI_Comm communicator, const double end_time, const std::uint64_t n_particles);

    /** The same to a stream; for tests. A line at most every `interval` seconds. */
    Progress(MPI_Comm communicator, const double end_time, const std::uint64_t n_particles, std::ostream &out,
             const bool is_terminal, const double interval);

    /** Ends an open line, so that a message that follows stands on its own. */
    ~Progress();

    Progress(const Progress &)            = delete;
    Progress &operator=(const Progress &) = delete;

    /** To be called after every step; costs the reading of a clock. */
    void update(const double time, const unsigned int step);

    /** Ends an open line, so that what is written next stands on its own. */
    void end_line();

    /** The last line, with the time that the run took. */
    void finish(const double time, const unsigned int step);

  private:
    using Clock = std::chrono::steady_clock;
    /** What is known of a state, closed by `ending`. */
    std::string line(const double time, const unsigned int step, const std::string &ending) const;
    void        print(const std::string &text);

    double            end_time;
    std::uint64_t     n_particles;
    std::ostream     &out;
    bool              is_root, is_terminal;
    double            interval; // [s]
    Clock::time_point start, last;
    // The first state seen, from which the remaining time is extrapolated.
    Clock::time_point first;
    double            first_time   = 0;
    bool              has_started  = false;
    bool              is_line_open = false;
  };
} // namespace Talus

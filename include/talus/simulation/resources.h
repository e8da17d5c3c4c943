#pragma once

#include <talus/core/communicator.h>

#include <string>

namespace Talus
{
  /** Date and time of the clock, for the log. */
  std::string date();

  /** What a run takes of the machine: memory, and messages between its ranks. */
  class Resources
  {
  public:
    /** Before anything is built. */
    explicit Resources(const Communicator &communicator);

    /** Before the first step. */
    void start_steps();

    /** Two lines on what ranks do in a step and send; empty on one rank. Collective. */
    std::string traffic(const unsigned int n_steps) const;

    /** Resident memory of all ranks, what libraries take included [byte]. Collective. */
    double resident() const;

    /** A line on what a particle takes, the grid's and all other memory included. Collective. */
    std::string memory(const double n_particles) const;

  private:
    const Communicator communicator;
    const double       memory_at_start;             // resident memory of this rank [byte]
    double             processor_time_at_start = 0; // of this rank, before the first step [s]
  };
} // namespace Talus

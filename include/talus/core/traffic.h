#pragma once

#include <cstdint>

namespace Talus
{
  /**
   * What the steps of this process have sent to other ranks, and how long they have
   * waited for them. Ranks wait by turning in a loop, so that the processor time of
   * a process says nothing of its work unless the waiting is taken off.
   */
  struct Traffic
  {
    std::uint64_t bytes    = 0; // sent
    std::uint64_t messages = 0; // sent
    double        waiting  = 0; // processor time inside MPI [s]

    /** Counts the processor time from its construction to its end as waiting. */
    class Wait
    {
    public:
      Wait();
      ~Wait();
      Wait(const Wait &) = delete;

    private:
      const double start;
    };

    /** Counts a message. */
    void sent(const std::uint64_t n_bytes)
    {
      ++messages;
      bytes += n_bytes;
    }

    /** That of this process. */
    static Traffic &here();
  };

  /** Processor time of this process since its start [s]. */
  double processor_time();
} // namespace Talus

#pragma once

#include <mpi.h>

#include <cstdint>
#include <memory>

namespace Talus
{
  /** What the steps of a run have sent from this process to other ranks, and how long they have waited for them. */
  struct Traffic
  {
    std::uint64_t bytes    = 0; // sent
    std::uint64_t messages = 0; // sent
    double        waiting  = 0; // processor time inside MPI [s]
  };

  /** Processor time of this process since its start [s]. */
  double processor_time();

  /**
   * The ranks of a run, and the traffic between them. Copies count together. Stands wherever MPI_Comm does.
   * Test: tests/core/others.cc.
   */
  class Communicator
  {
  public:
    Communicator(MPI_Comm ranks = MPI_COMM_NULL) : ranks(ranks), counted(std::make_shared<Traffic>()) {}

    operator MPI_Comm() const { return ranks; }

    Traffic &traffic() const { return *counted; }

    /** Counts a message. */
    void sent(const std::uint64_t n_bytes) const
    {
      ++counted->messages;
      counted->bytes += n_bytes;
    }

    /**
     * Counts the processor time from its construction to its end as waiting. Ranks wait by turning in a loop, so that
     * the processor time of a process says nothing of its work unless the waiting is taken off.
     */
    class Wait
    {
    public:
      explicit Wait(const Communicator &communicator) : traffic(communicator.traffic()), start(processor_time()) {}
      ~Wait() { traffic.waiting += processor_time() - start; }
      Wait(const Wait &) = delete;

    private:
      Traffic     &traffic;
      const double start;
    };

  private:
    MPI_Comm                 ranks;
    std::shared_ptr<Traffic> counted;
  };
} // namespace Talus

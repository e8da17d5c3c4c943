#pragma once

#include <talus/core/reduction.h>

#include <string>

namespace Talus
{
  /**
   * What a run is asked for from outside while it steps. Ranks are asked apart, and agree in the message that ends each
   * step. Test: tests/checkpoint.
   */
  class Requests
  {
  public:
    /**
     * As long as one is there, SIGTERM, SIGINT and SIGUSR1 are noted and do not end the process; a second SIGINT does,
     * for who does not want to wait.
     */
    class Signals
    {
    public:
      Signals();
      ~Signals();
      Signals(const Signals &) = delete;
    };

    /** Whether a signal has come to this process since the last run began. */
    static bool is_signal_noted();

    /** What this rank asks for, then what any rank does. */
    bool wants_checkpoint = false;

    /** Whether a signal has come to any rank, as of the last step. */
    bool is_stopped() const { return signal > 0; }

    /** Its name: "SIGTERM". */
    std::string signal_name() const;

    int signal_number() const { return static_cast<int>(signal); }

    void add_to(Reduction &reduction);

  private:
    double signal = 0; // the highest number of those that have come to any rank
  };
} // namespace Talus

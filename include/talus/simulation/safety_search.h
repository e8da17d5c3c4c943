#pragma once

#include <talus/simulation/resume.h>
#include <talus/simulation/stages.h>

#include <string>
#include <vector>

namespace Talus
{
  /**
   * A stage that looks for the greatest factor by which strengths can be divided: bisection, each trial a run from the
   * begin of the stage, with files of its own in DIRECTORY/STAGE_FACTOR. What was found is in
   * DIRECTORY/safety_STAGE.csv and in the log. Theory: doc/ground.md. Test: tests/stages.
   */
  template <int dim>
  class SafetySearch
  {
  public:
    SafetySearch(const Stages &stages, const unsigned int stage, const Resume &begin, const std::string &origin,
                 MPI_Comm communicator);

    /** False where a signal has stopped it. Throws RunError where the factor does not lie between the two. Collective.
     */
    bool run();

  private:
    struct Row
    {
      double factor, moved;
      bool   stands;
    };

    /** Whether it stands with strengths over this. */
    bool       stands_with(const double factor);
    Parameters parameters(const double factor) const;
    void       write_table() const;
    void       say(const std::string &text) const;
    void       note(const std::string &text) const; // in the log

    const Stages      &stages;
    const unsigned int stage;
    const Resume      &begin;
    const std::string  origin;
    MPI_Comm           communicator;

    std::vector<Row> rows;
    bool             is_stopped = false;
  };
} // namespace Talus

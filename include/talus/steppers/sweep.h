#pragma once

#include <talus/core/timing.h>

#include <algorithm>
#include <functional>
#include <vector>

namespace Talus
{
  /**
   * What is done with each particle alone: a list of stages that runs block by block, so that what one stage has
   * written the next finds in the cache. Where a stage needs the whole grid, or what others have done to all particles,
   * run() stands before it. An indirect call for each block and stage. Test: tests/steppers.
   */
  class Sweep
  {
  public:
    /** Works on the particles begin .. end - 1. */
    using Stage = std::function<void(const unsigned int begin, const unsigned int end)>;

    explicit Sweep(Timing &timing) : timing(timing) {}

    /** Appends a stage whose time counts in `section`. */
    void add(const unsigned int section, Stage stage) { stages.emplace_back(section, std::move(stage)); }

    /** Runs all stages for n particles in blocks of `block`, and forgets them. */
    void run(const unsigned int n, const unsigned int block)
    {
      for (unsigned int begin = 0; begin < n; begin += block)
        for (const auto &[section, stage] : stages)
        {
          const Timing::Scope scope(timing, section);
          stage(begin, std::min(begin + block, n));
        }
      stages.clear();
    }

  private:
    Timing                                     &timing;
    std::vector<std::pair<unsigned int, Stage>> stages;
  };
} // namespace Talus

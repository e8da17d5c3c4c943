#pragma once

#include <chrono>
#include <string>
#include <utility>
#include <vector>

namespace Talus
{
  /**
   * Wall time by section. A section is opened a few hundred times a step, for one
   * block of particles after the other, so that opening it must cost next to nothing:
   * dealii::TimerOutput asks the operating system for more than the time.
   */
  class Timing
  {
  public:
    using Clock = std::chrono::steady_clock;

    /** Measures from its construction to its end. */
    class Scope
    {
    public:
      Scope(Timing &timing, const unsigned int section) : timing(timing), section(section), start(Clock::now()) {}
      ~Scope() { timing.sections[section].second += Clock::now() - start; }
      Scope(const Scope &) = delete;

    private:
      Timing                 &timing;
      const unsigned int      section;
      const Clock::time_point start;
    };

    /** The number of a section; sections are printed in the order in which they were added. */
    unsigned int add(const std::string &name)
    {
      sections.emplace_back(name, Clock::duration::zero());
      return sections.size() - 1;
    }

    /** Each section's time since construction and its share, as a text. */
    std::string table() const;

  private:
    std::vector<std::pair<std::string, Clock::duration>> sections;
    const Clock::time_point                              start = Clock::now();
  };
} // namespace Talus

#pragma once

#include <string>
#include <vector>

namespace Talus
{
  /**
   * Runs of one file with all combinations of values of some entries: "Section/Entry = a | b | c". They go into
   * numbered directories, and a table says what each was, and how it ended. Test: tests/inputs/outputs.py.
   */
  class ParameterSweep
  {
  public:
    /** Throws InputError where a text cannot be understood. */
    explicit ParameterSweep(const std::vector<std::string> &texts);

    /** How many combinations there are. */
    unsigned int size() const;

    /** Of one of them: "Section/Entry = a" for each entry. The last entry changes first. */
    std::vector<std::string> overrides(const unsigned int number) const;

    /**
     * Adds a row to `directory`/sweep.csv when run `number` has ended: number, values, exit status, and the last row of
     * its statistics, where they have the columns of the first run that had any. Throws RunError. For the first rank.
     */
    void note(const std::string &directory, const unsigned int number, const int status);

    /** Where it writes: "1" to "12" have as many digits as the greatest. */
    std::string name(const unsigned int number) const;

  private:
    struct Entry
    {
      std::string              name; // "Section/Entry"
      std::vector<std::string> values;
    };

    std::vector<unsigned int> indices(const unsigned int number) const;

    std::vector<Entry> entries;
    std::string        columns; // of the statistics
    std::string        rows;
  };
} // namespace Talus

#pragma once

#include <string>
#include <vector>

namespace Talus
{
  /**
   * Rows of numbers in a text file, one point a line, as other programs write them: separated by blanks, or by commas,
   * or by semicolons; a line of names before the first row; exponents of Fortran (1.5D-3); '#' begins a comment. Throws
   * InputError, with file and line, for what is no finite number, for another number of columns than asked for and for
   * what can be read in two ways (decimal commas). Numbers below the smallest normal one are numbers.
   * Test: tests/particles/point_table.cc.
   */
  class PointTable
  {
  public:
    /** `names` of the columns: "x", "y", "volume". */
    explicit PointTable(std::vector<std::string> names) : names(std::move(names)) {}

    /** Reads lines of the file that messages call `file_name`; `has_header`: the first are names that are known. */
    void read(const std::vector<std::string> &lines, const std::string &file_name, const bool has_header = false);

    /**
     * What the columns are called in the first line that is no comment, in small letters, blanks as underscores and
     * without units; empty where that line has numbers.
     */
    static std::vector<std::string> header(const std::vector<std::string> &lines);

    unsigned int n_columns() const { return names.size(); }
    std::size_t  n_rows() const { return numbers.size() / names.size(); }
    double       operator()(const std::size_t row, const unsigned int column) const
    {
      return numbers[row * names.size() + column];
    }
    unsigned int line_of(const std::size_t row) const { return lines_of_rows[row]; }

  private:
    void read_row(const std::vector<std::string> &words, const std::string &where);
    bool is_header(const std::vector<std::string> &words, const std::string &where) const;

    std::vector<std::string>  names;
    std::vector<double>       numbers; // row by row
    std::vector<unsigned int> lines_of_rows;
  };
} // namespace Talus

#pragma once

#include <string>
#include <vector>

namespace Talus
{
  /**
   * The lines of a text file, whichever program has written it: line ends of Unix, Windows and old Macs, a byte order
   * mark at the start, and blanks that only look like one (no-break spaces) become those of plain text. What is no text
   * (a directory, UTF-16, a binary or packed file) is not read; `problem` then names the cause and the remedy, and is
   * empty otherwise. Test: tests/core/text.cc.
   */
  struct TextFile
  {
    /** Messages call the file by what it is for ("the parameter file"), if that is given, and its name. */
    explicit TextFile(const std::string &path, const std::string &purpose = "");

    std::vector<std::string> lines;
    std::string              problem;
  };

  /** The same for bytes in memory; `name` is what messages call them, quoted. */
  void read_text(const std::string &bytes, const std::string &name, std::vector<std::string> &lines,
                 std::string &problem);

  /** Why a file cannot be read, or nothing; `name` is what a message calls it: "the mesh 'a.msh'". */
  std::string why_not_read(const std::string &path, const std::string &name);
  /**
   * Whether all of `word` is a number, infinite or NaN included, which it then is; exponents may be Fortran's, D for E,
   * or nothing at all before three digits.
   */
  bool read_number(const std::string &word, double &number);
} // namespace Talus

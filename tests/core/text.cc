#include <talus/core/text_file.h>

#include "../check.h"

#include <cstdio>
#include <fstream>

using namespace Test;
using namespace Talus;

namespace
{
  std::string problem_of(const std::string &bytes)
  {
    std::vector<std::string> lines;
    std::string              problem;
    read_text(bytes, "'name'", lines, problem);
    return problem;
  }

  void check_lines(const std::string &what, const std::string &bytes, const std::vector<std::string> &expected)
  {
    std::vector<std::string> lines;
    std::string              problem;
    read_text(bytes, "'name'", lines, problem);
    check_true(what, problem.empty() && lines == expected);
  }

  void check_problem(const std::string &what, const std::string &bytes, const std::string &word)
  {
    const std::string problem = problem_of(bytes);
    check_true(what, problem.find(word) != std::string::npos && problem.find("plain text") != std::string::npos);
  }
} // namespace

/** What other programs make of line ends, blanks and the start of a file. */
void text_files()
{
  const std::vector<std::string> two = {"0.5 1", "2 -3"};
  check_lines("Unix", "0.5 1\n2 -3\n", two);
  check_lines("no end of the last line", "0.5 1\n2 -3", two);
  check_lines("Windows", "0.5 1\r\n2 -3\r\n\x1a", two);
  check_lines("old Mac", "0.5 1\r2 -3\r", two);
  check_lines("byte order mark",
              "\xef\xbb\xbf"
              "0.5 1\n2 -3\n",
              two);
  check_lines("no-break space and minus sign",
              "0.5\xc2\xa0"
              "1\n2\xe2\x80\xaf\xe2\x88\x92"
              "3\n",
              two);
  check_lines("no-break space in Latin-1",
              "0.5\xa0"
              "1\n2 -3\n",
              two);
  check_lines("letters stay",
              "Gr\xc3\xb6\xc3\x9f"
              "e\n",
              {"Gr\xc3\xb6\xc3\x9f"
               "e"});
  check_lines("nothing", "", {});
  check_problem("UTF-16 with its mark",
                std::string("\xff\xfe"
                            "0\0.\0",
                            6),
                "UTF-16");
  check_problem("UTF-16, the other order",
                std::string("\xfe\xff\0"
                            "0\0.",
                            6),
                "UTF-16");
  check_problem("UTF-16 without mark",
                std::string("0\0.\0"
                            "5\0 \0",
                            8),
                "UTF-16");
  check_problem("zeros", std::string("abcdefgh\0\1\2", 11), "a binary file");
  check_problem("gzip", "\x1f\x8b\x08", "a packed file");
  check_problem("spreadsheet", "PK\x03\x04", "zip archive");

  const TextFile absent("absent.txt"), directory(".", "the table");
  check_true("missing", absent.problem.find("cannot read 'absent.txt': No such file") == 0);
  check_true("directory", directory.problem.find("cannot read the table '.': it is a directory") == 0);
}

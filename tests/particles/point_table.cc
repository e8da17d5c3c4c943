#include <talus/particles/point_table.h>

#include "../setup.h"

using namespace Test;

namespace
{
  PointTable read(const std::vector<std::string> &lines)
  {
    PointTable table({"x", "y", "volume"});
    table.read(lines, "file");
    return table;
  }

  /** One row of .31, -.25, 2.5e-3. */
  void check_row(const std::string &what, const std::vector<std::string> &lines)
  {
    const PointTable table = read(lines);
    check_true(what, table.n_rows() == 1 && table(0, 0) == 0.31 && table(0, 1) == -0.25 && table(0, 2) == 2.5e-3);
  }
} // namespace

/** Tables as other programs write them, and those that can be read in two ways. */
void point_table()
{
  check_row("blanks", {"  0.31\t-0.25   0.0025 "});
  check_row("commas", {"0.31,-0.25,0.0025"});
  check_row("commas and blanks", {"0.31, -0.25 , 0.0025,"});
  check_row("semicolons", {"0.31; -0.25; 0.0025;"});
  check_row("Fortran", {"3.1D-01 -2.5d-1 2.50000000D-03"});
  check_row("Fortran, three digits", {"31.-002 -25.0-002 25-004"});
  check_row("comments and empty lines", {"# x y volume", "", "0.31 -0.25 0.0025 # here"});
  check_row("names", {"x y volume", "0.31 -0.25 0.0025"});
  check_row("names with units", {"x [m], y [m], volume [m2]", "0.31, -0.25, 0.0025"});
  check_row("other names", {"Easting;Northing;Area", "0.31;-0.25;0.0025"});
  check("smaller than normal", read({"4.94e-324 -1e-310 1"})(0, 1) / -1e-310 - 1, 1e-12);
  check_true("line of a row", read({"# x", "1 2 3", "", "4 5 6"}).line_of(1) == 4);

  const auto error = [](const std::string &what, const std::vector<std::string> &lines, const std::string &message) {
    check_error<InputError>(what, {message}, [&] { read(lines); });
  };
  error("names in another order", {"volume x y", "1 2 3"},
        "file:1: the columns are called 'volume x y', but are read as 'x y volume'");
  error("names twice", {"x y volume", "x y volume"}, "file:2: 'x' is not a finite number");
  error("decimal commas", {"0,31 0,31 0,0025"}, "file:1: '0,31' is not a number. Write decimal points");
  error("decimal commas and semicolons", {"0,31;0,31;0,0025"}, "Write decimal points");
  error("nothing but commas", {"0,31,0,31,0,0025"}, "If commas stand for decimal points, write points");
  error("two separators", {"0.31,0.31 0.0025"}, "all of them by commas");
  error("nothing between commas", {"0.31,,0.0025"}, "file:1: a number is missing between two separators");
  error("one too many", {"1 2 3", "1 2 3 4"}, "file:2: expected 3 numbers (x y volume), found 4");
  error("too large", {"1e400 2 3"}, "'1e400' is too large");
  error("infinite", {"inf 2 3"}, "'inf' is not a finite number");
  error("a word", {"1 o.5 3"}, "'o.5' is not a finite number");
  error("a long word", {"1 2 " + std::string(1000, 'a')}, std::string(60, 'a') + " [...] ");
}

#include <talus/postprocess/progress.h>
#include <talus/postprocess/statistics.h>

#include "fixture.h"

#include <sstream>

using namespace dealii;
using namespace Test;

void test_statistics()
{
  const std::string base = scratch();
  const std::string path = base + "/statistics.csv";
  Statistics<2>     statistics;
  statistics.open(path, {{"time", "time"}, {"step", "1"}, {"kinetic energy", "energy"}});
  check_true("a header before the first row", lines(path).size() == 1);
  statistics.write_row({0.1, 1, 1. / 3});
  const auto first = lines(path);
  check_true("a row is on disk at once", first.size() == 2 && first[1] == "0.1,1,0.3333333333333333");
  statistics.write_row({0.2, 2, -1e-300});
  const auto table = lines(path);
  check_true("names and units", table[0] == "time [time],step [1],kinetic energy [energy]");
  check_true("all digits",
             table.size() == 3 && read_numbers(table[2])[2] == -1e-300 && read_numbers(table[1])[2] == 1. / 3);
  check_throws<RunError>("a number that is not finite", "'kinetic energy' is not a finite number when time = 0.3", [&] {
    statistics.write_row({0.3, 3, std::nan("")});
  });
  check_true("does not reach the file", lines(path).size() == 3);
  check_throws<RunError>("a file that cannot be written", "Cannot write '" + base + "/gone/statistics.csv'", [&] {
    Statistics<3> other;
    other.open(base + "/gone/statistics.csv", {{"time", "time"}});
  });
}

namespace
{
  std::string progress_text(const bool is_terminal, const double interval, const bool is_finished)
  {
    std::ostringstream out;
    {
      Progress progress(MPI_COMM_WORLD, 2., 1000, out, is_terminal, interval);
      for (unsigned int step = 1; step <= 4; ++step)
        progress.update(0.25 * step, step);
      if (is_finished)
        progress.finish(2., 8);
    }
    return out.str();
  }

  unsigned int count(const std::string &text, const char what) { return std::count(text.begin(), text.end(), what); }
} // namespace

void test_progress()
{
  const unsigned int one = is_root() ? 1 : 0; // other ranks say nothing

  const std::string log = progress_text(false, 0, true);
  check_true("a line for each state of a log", count(log, '\n') == 5 * one && count(log, '\r') == 0);
  check_true("says how far it is",
             !is_root() || log.find("step 4, time 1 of 2, 50 %, 1000 particles, 0:00:00 left\n") != std::string::npos);
  check_true("and the end",
             !is_root() || log.find("step 8, time 2 of 2, 100 %, 1000 particles, took 0:00:0") != std::string::npos);
  const std::string seldom = progress_text(false, 60, true);
  check_true("within a minute only the last line", count(seldom, '\n') == one);

  const std::string terminal = progress_text(true, 0, true);
  check_true("a terminal has one line", count(terminal, '\r') == 5 * one && count(terminal, '\n') == one);
  const std::string broken = progress_text(true, 0, false);
  check_true("which ends when the run breaks off", count(broken, '\n') == one && (one == 0 || broken.back() == '\n'));
}

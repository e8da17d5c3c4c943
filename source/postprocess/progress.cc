#include <talus/postprocess/progress.h>

#include <deal.II/base/mpi.h>

#include <cmath>
#include <iomanip>
#include <iostream>
#include <sstream>

#include <unistd.h>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    // mpirun gives its ranks a pseudo terminal to write to even in a batch job, but none to read from.
    bool is_stdout_a_terminal() { return isatty(STDOUT_FILENO) == 1 && isatty(STDIN_FILENO) == 1; }

    /** Hours, minutes and seconds: 1:02:03. */
    std::string clock_time(const double seconds)
    {
      const auto         n = static_cast<std::uint64_t>(std::llround(seconds));
      std::ostringstream text;
      text << n / 3600 << std::setfill('0') << ':' << std::setw(2) << n / 60 % 60 << ':' << std::setw(2) << n % 60;
      return text.str();
    }

    template <class Duration>
    double seconds(const Duration &duration)
    {
      return std::chrono::duration<double>(duration).count();
    }
  } // namespace

  Progress::Progress(MPI_Comm communicator, const double end_time, const std::uint64_t n_particles) :
    Progress(communicator, end_time, n_particles, std::cout, is_stdout_a_terminal(), is_stdout_a_terminal() ? 0.2 : 60.)
  {
  }

  Progress::Progress(MPI_Comm communicator, const double end_time, const std::uint64_t n_particles, std::ostream &out,
                     const bool is_terminal, const double interval) :
    end_time(end_time),
    n_particles(n_particles), out(out), is_root(Utilities::MPI::this_mpi_process(communicator) == 0),
    is_terminal(is_terminal), interval(interval), start(Clock::now()), last(start), first(start)
  {
  }

  Progress::~Progress() { end_line(); }

  void Progress::end_line()
  {
    if (is_line_open)
      out << std::endl;
    is_line_open = false;
  }

  void Progress::update(const double time, const unsigned int step)
  {
    if (!is_root)
      return;
    const auto now = Clock::now();
    if (!has_started)
    {
      has_started = true;
      first       = now;
      first_time  = time;
    }
    if (seconds(now - last) < interval)
      return;
    last = now;
    // The time per step of the steps so far is that of the steps to come.
    const bool   is_known  = time > first_time;
    const double remaining = seconds(now - first) * (end_time - time) / (time - first_time);
    print(line(time, step, is_known ? clock_time(remaining) + " left" : "time left not known yet"));
  }

  void Progress::finish(const double time, const unsigned int step)
  {
    if (!is_root)
      return;
    print(line(time, step, "took " + clock_time(seconds(Clock::now() - start))));
    end_line();
  }

  std::string Progress::line(const double time, const unsigned int step, const std::string &ending) const
  {
    std::ostringstream text;
    text << "step " << step << ", time " << std::setprecision(6) << time << " of " << end_time << ", "
         << std::setprecision(3) << 100 * time / end_time << " %, " << n_particles << " particles, " << ending;
    return text.str();
  }

  void Progress::print(const std::string &text)
  {
    // "\033[K" erases what a longer line has left behind.
    if (is_terminal)
      out << '\r' << text << "\033[K" << std::flush;
    else
      out << text << std::endl;
    is_line_open = is_terminal;
  }
} // namespace Talus

#include <talus/simulation/simulation.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    /** "12 s", "5 min", "3.2 h", "2.1 days". */
    std::string duration(const double seconds)
    {
      std::ostringstream text;
      text << std::setprecision(2);
      if (seconds < 100)
        text << std::max(1., std::round(seconds)) << " s";
      else if (seconds < 6000)
        text << std::round(seconds / 60) << " min";
      else if (seconds < 48 * 3600)
        text << seconds / 3600 << " h";
      else
        text << seconds / 86400 << " days";
      return text.str();
    }

    /** To three digits, without an exponent as long as it can be read. */
    std::string rounded(const double n)
    {
      const double       unit = std::pow(10., std::max(0., std::floor(std::log10(std::max(n, 1.))) - 2));
      std::ostringstream text;
      text << std::setprecision(9) << unit * std::round(n / unit);
      return text.str();
    }
  } // namespace

  template <int dim>
  void Simulation<dim>::try_start()
  {
    set_up();
    output.leave_out(references.idle_fields());
    output.check(model.particles);
    say(summary());
    tell_warnings();

    using Clock          = std::chrono::steady_clock;
    double       seconds = 0; // a step
    unsigned int n_steps = 1;
    // One to see what it takes, and as many as a second allows: the same number on all ranks.
    for (unsigned int part = 0; part < 2 && !is_finished(); ++part)
    {
      const auto         start  = Clock::now();
      const unsigned int before = now.step;
      for (unsigned int n = 0; n < n_steps && !is_finished(); ++n)
      {
        advance();
        check();
      }
      seconds = std::chrono::duration<double>(Clock::now() - start).count() / (now.step - before);
      seconds = Utilities::MPI::max(seconds, communicator);
      n_steps = std::clamp(static_cast<int>(1 / seconds), 1, 20);
    }
    const double end = std::isfinite(end_time) ? end_time : now.time;
    double       n   = std::ceil(end * now.step / std::max(now.time, 1e-300));
    if (max_steps > 0)
      n = std::min(n, static_cast<double>(max_steps));
    std::ostringstream text;
    text
      << std::setprecision(3) << "  steps      about " << rounded(n) << " of " << now.time / now.step
      << " [time] to t = " << end << "\n  time       about " << duration(n * seconds) << " with "
      << Utilities::MPI::n_mpi_processes(communicator) << " rank(s) of this machine, output not counted\n  memory     "
      << resources.resident() / 1e9 << " GB\n"
      << "Nothing was written. Steps get shorter when material moves faster or gets stiffer than in the first ones.\n";
    say(text.str());
  }

  template void Simulation<2>::try_start();
  template void Simulation<3>::try_start();
} // namespace Talus

#include <talus/core/timing.h>

#include <iomanip>
#include <sstream>

namespace Talus
{
  std::string Timing::table() const
  {
    const auto         seconds = [](const Clock::duration &t) { return std::chrono::duration<double>(t).count(); };
    const double       total   = seconds(Clock::now() - start);
    double             rest    = total;
    std::ostringstream text;
    const auto         row = [&](const std::string &name, const double time) {
      text << "  " << std::left << std::setw(30) << name << std::right << std::fixed << std::setprecision(3)
           << std::setw(12) << time << " s" << std::setprecision(1) << std::setw(8) << 100 * time / total << " %\n";
    };
    text << "\nWall time of rank 0\n";
    for (const auto &[name, time] : sections)
    {
      row(name, seconds(time));
      rest -= seconds(time);
    }
    row("everything else", rest);
    row("total", total);
    return text.str();
  }
} // namespace Talus

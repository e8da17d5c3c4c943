#include <talus/simulation/resources.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <array>
#include <ctime>
#include <iomanip>
#include <sstream>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    /** Resident memory of this process, now and at most [byte]. */
    std::pair<double, double> resident_memory()
    {
      Utilities::System::MemoryStats stats;
      Utilities::System::get_memory_stats(stats);
      return {1024. * stats.VmRSS, 1024. * stats.VmHWM};
    }

    /** The same when the first part of a run began: later ones take up the memory that it has left. */
    double first_memory()
    {
      static const double memory = resident_memory().first;
      return memory;
    }
  } // namespace

  std::string date()
  {
    const std::time_t    now = std::time(nullptr);
    std::array<char, 64> text{};
    std::strftime(text.data(), text.size(), "%Y-%m-%d %H:%M:%S %z", std::localtime(&now));
    return text.data();
  }

  Resources::Resources(const Communicator &communicator) : communicator(communicator), memory_at_start(first_memory())
  {
  }

  void Resources::start_steps()
  {
    communicator.traffic()  = {};
    processor_time_at_start = processor_time();
  }

  std::string Resources::traffic(const unsigned int n_steps) const
  {
    const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(communicator);
    if (n_ranks == 1 || n_steps == 0)
      return "";
    const Traffic &here = communicator.traffic();
    const double   busy = Utilities::MPI::max(processor_time() - processor_time_at_start - here.waiting, communicator);
    const double   per_step = 1. / (static_cast<double>(n_steps) * n_ranks);
    const double   bytes    = per_step * Utilities::MPI::sum(static_cast<double>(here.bytes), communicator),
                 messages   = per_step * Utilities::MPI::sum(static_cast<double>(here.messages), communicator);
    std::ostringstream text;
    text << std::fixed << std::setprecision(3) << "  busiest rank: " << busy << " s of processor time outside waiting\n"
         << std::setprecision(1) << "  a rank sends " << messages << " messages and " << bytes / 1000
         << " kB in a step\n";
    return text.str();
  }

  double Resources::resident() const { return Utilities::MPI::sum(resident_memory().first, communicator); }

  std::string Resources::memory(const double n_particles) const
  {
    const auto   here = resident_memory();
    const double now  = Utilities::MPI::sum(here.first - memory_at_start, communicator),
                 most = Utilities::MPI::sum(here.second - memory_at_start, communicator);
    std::ostringstream text;
    text << std::fixed << std::setprecision(0) << "  bytes per particle: " << now / n_particles << " now, "
         << most / n_particles << " at most\n";
    return text.str();
  }
} // namespace Talus

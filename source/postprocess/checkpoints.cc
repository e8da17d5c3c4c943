#include <talus/postprocess/checkpoints.h>

#include <talus/postprocess/files.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <regex>

namespace Talus
{
  using namespace dealii;
  namespace fs = std::filesystem;

  namespace
  {
    const std::regex pattern("checkpoint_([0-9]{8,10})\\.h5");

    void remove(const std::vector<fs::path> &files)
    {
      for (const auto &file : files)
      {
        std::error_code error;
        fs::remove(file, error);
        AssertThrow(!error, RunError("Cannot remove '" + file.string() + "': " + error.message() + "."));
      }
    }
  } // namespace

  Checkpoints::Checkpoints(const std::string &section) : ParameterAcceptor(section)
  {
    add_parameter("Step interval", step_interval, "Steps between two checkpoints [1]; 0: off.", prm,
                  Patterns::Integer(0));
    add_parameter("Time interval", time_interval, "Time between two checkpoints [time]; 0: off.", prm,
                  Patterns::Double(0));
    add_parameter("Clock interval", clock_interval, "Seconds on the clock between two checkpoints; 0: off.", prm,
                  Patterns::Double(0));
    add_parameter("Kept", n_kept, "Number of checkpoints that are kept, the last ones [1].", prm, Patterns::Integer(1));
  }

  void Checkpoints::parse_parameters(ParameterHandler &)
  {
    for (const auto &[entry, interval] :
         {std::make_pair("Time interval", time_interval), {"Clock interval", clock_interval}})
      if (!std::isfinite(interval))
        throw EntryError(get_section_name(), entry, "it must be a finite number. Set it to 0 to switch it off.");
  }

  std::vector<Checkpoints::File> Checkpoints::files(const std::string &directory)
  {
    std::vector<File> found;
    std::error_code   error;
    std::smatch       match;
    for (const auto &entry : fs::directory_iterator(directory, error))
    {
      const std::string name = entry.path().filename().string();
      if (std::regex_match(name, match, pattern))
        found.push_back({std::stoul(match[1]), entry.path().string()});
    }
    std::sort(found.begin(), found.end(), [](const File &a, const File &b) { return a.step > b.step; });
    return found;
  }

  std::string Checkpoints::name(const unsigned int step) const
  {
    return directory + "/checkpoint_" + Utilities::int_to_string(step, 8) + ".h5";
  }

  void Checkpoints::start(const std::string &directory, const Moment &now, MPI_Comm communicator)
  {
    this->directory    = directory;
    this->communicator = communicator;
    last_time          = now.time;
    last               = Clock::now();
    run_on_root(
      [&] {
        std::vector<fs::path> old;
        for (const auto &file : files(directory))
          if (file.step > now.step)
            old.push_back(file.path);
        std::error_code error;
        for (const auto &entry : fs::directory_iterator(directory, error))
          if (std::regex_match(entry.path().stem().string(), pattern) && entry.path().extension() == ".tmp")
            old.push_back(entry.path());
        remove(old);
      },
      communicator);
  }

  bool Checkpoints::is_due_by_clock() const
  {
    return clock_interval > 0 && std::chrono::duration<double>(Clock::now() - last).count() > clock_interval;
  }

  bool Checkpoints::is_due(const Moment &now) const
  {
    if (step_interval > 0 && now.step % step_interval == 0)
      return true;
    // Round-off may put a step this part of an interval too early.
    constexpr double tolerance = 1e-6;
    const auto       n_before  = [&](const double time) { return std::floor(time / time_interval + tolerance); };
    return time_interval > 0 && n_before(now.time) > n_before(last_time);
  }

  template <int dim>
  std::string Checkpoints::write(const CheckpointHead &head, const Archive &archive, const WorkingSet<dim> &particles)
  {
    const std::string path = name(head.step);
    write_checkpoint(path, head, archive, particles, communicator);
    last_time = head.time;
    last      = Clock::now();
    run_on_root(
      [&] {
        std::vector<fs::path> old;
        for (const auto &file : files(directory))
          old.push_back(file.path);
        old.erase(old.begin(), old.begin() + std::min<std::size_t>(n_kept, old.size()));
        remove(old);
      },
      communicator);
    return path;
  }

  template std::string Checkpoints::write(const CheckpointHead &, const Archive &, const WorkingSet<2> &);
  template std::string Checkpoints::write(const CheckpointHead &, const Archive &, const WorkingSet<3> &);
} // namespace Talus

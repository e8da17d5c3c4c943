#include <talus/simulation/resume.h>

#include <talus/core/parameter_names.h>
#include <talus/postprocess/checkpoints.h>
#include <talus/simulation/stages.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <algorithm>

namespace Talus
{
  using namespace dealii;
  using namespace ParameterNames;

  namespace
  {
    /** The key of "Section/Entry = value". */
    std::string key_of(const std::string &override_text)
    {
      return join(split(Utilities::trim(override_text.substr(0, override_text.find('=')))));
    }

    std::string value_of(const std::string &override_text)
    {
      const auto equal = override_text.find('=');
      return equal == std::string::npos ? "" : Utilities::trim(override_text.substr(equal + 1));
    }

    /** Whether a run that goes on may change it: what nothing in its state hangs on. */
    bool may_change(const std::string &key)
    {
      const auto starts = [&](const std::string &with) { return key.compare(0, with.size(), with) == 0; };
      if (starts("Output/"))
        return key != "Output/Directory" && !starts("Output/Probes/");
      return starts("Checkpoints/") || key == "Run/End time" || key == "Run/Number of steps" ||
             key == "Run/Local damping";
    }

    std::string without_slash(std::string directory)
    {
      while (directory.size() > 1 && directory.back() == '/')
        directory.pop_back();
      return directory;
    }
  } // namespace

  Resume::Resume(const std::string &name, MPI_Comm communicator) : directory(without_slash(name))
  {
    std::vector<std::string> files;
    std::string              problem;
    if (Utilities::MPI::this_mpi_process(communicator) == 0 && !Checkpoints::files(directory).empty())
    {
      problem = lock.take(directory);
      for (const auto &found : Checkpoints::files(directory))
        files.push_back(found.path);
    }
    problem = Utilities::MPI::broadcast(communicator, problem);
    AssertThrow(problem.empty(), InputError("--resume " + name + ": " + problem));
    files = Utilities::MPI::broadcast(communicator, files);
    AssertThrow(!files.empty(), InputError("--resume " + name +
                                           ": there is no checkpoint in this directory. Give the "
                                           "directory of the output of a run that has written one."));
    for (const auto &candidate : files)
    {
      const std::string damage = damage_of_checkpoint(candidate, communicator);
      if (damage.empty())
      {
        file = candidate;
        head = CheckpointFile(file).head;
        return;
      }
      warnings.push_back(damage);
    }
    throw InputError("--resume " + name + ": " + warnings.front() + ", and there is no other one.");
  }

  bool Resume::changes(const std::vector<std::string> &overrides, const std::string &key)
  {
    return std::any_of(overrides.begin(), overrides.end(), [&](const auto &text) { return key_of(text) == key; });
  }

  Parameters Resume::parameters(const std::vector<std::string> &overrides) const
  {
    const Parameters before = Parameters::from_text(head.parameters, file);
    const Stages     stages(before);
    for (const auto &text : overrides)
    {
      const std::string key   = key_of(text);
      const int         stage = stages.stage_of(key), next = head.stage + (head.begins_stage ? 0 : 1);
      const bool        is_to_come = stage >= next;
      if (!may_change(key) && !is_to_come &&
          !(before.is_set(parent(key), leaf(key)) && before.value(parent(key), leaf(key), "") == value_of(text)))
        throw InputError(
          "--set \"" + shortened(text) + "\": a run that goes on cannot change " + describe(key) +
          ". It may change 'End time', 'Number of steps' and 'Local damping' in section 'Run', and the "
          "sections 'Checkpoints' and 'Output', but 'Directory' and 'Probes' there, and what stages to come change. "
          "Start a new run.");
    }
    auto all = overrides;
    all.push_back("Output/Directory = " + directory);
    return Parameters::from_text(head.parameters, file, all);
  }
} // namespace Talus

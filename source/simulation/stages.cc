#include <talus/simulation/stages.h>

#include <talus/core/exceptions.h>
#include <talus/core/parameter_names.h>

#include <deal.II/base/utilities.h>

#include <algorithm>

namespace Talus
{
  using namespace dealii;
  using namespace ParameterNames;

  namespace
  {
    bool starts_with(const std::string &key, const std::string &start)
    {
      return key.compare(0, start.size(), start) == 0;
    }

    std::vector<std::string> list(const Parameters &parameters, const std::string &section)
    {
      return Utilities::split_string_list(parameters.value(section, "Names", ""));
    }

    bool is_in(const std::string &name, const std::vector<std::string> &names)
    {
      return std::find(names.begin(), names.end(), name) != names.end();
    }

    /** Why no stage can change an entry, or nothing. */
    std::string why_fixed(const std::string &key)
    {
      for (const std::string section : {"Grid/", "Kernel/", "Stages/"})
        if (starts_with(key, section))
          return "it is one for all stages. Set it in section '" + split(key)[0] + "' of the file itself.";
      for (const std::string section : {"FEM reference/", "Verification/", "Element/"})
        if (starts_with(key, section))
          return "runs in stages have no reference. Remove the stages, or the reference.";
      if (starts_with(key, "Output/Probes/") || key == "Output/Directory" || key == "Output/Overwrite")
        return "the files of a run are the same in all stages. Set it in section 'Output' of the file itself.";
      if (key == "Run/End time" || key == "Run/Number of steps")
        return "a stage ends after its 'Duration'. Set that in the stage's own section.";
      return "";
    }
  } // namespace

  Stage::Stage(const std::string &name) : ParameterAcceptor("/Stages/" + name), name(name)
  {
    add_parameter("Duration", duration, "Time after which it ends, if it does not come to rest before [time].", prm,
                  Patterns::Double());
    add_parameter("Rest", rest,
                  "It ends when the kinetic energy is below this share of the energy put in since its begin, and the "
                  "forces are balanced [1]; 0: it lasts for 'Duration'.",
                  prm, Patterns::Double(0, 1));
    add_parameter("Unbalanced force", largest_unbalanced,
                  "At rest the nodes' masses times their accelerations add up to less than this share of the weight "
                  "and loads [1].",
                  prm, Patterns::Double(0));
    add_parameter("Strength reduction", factors,
                  "The stage is a search: two factors, between which lies the one by which strengths can be divided. "
                  "Each is tried from its begin, and the next stage goes on from there as well [1].",
                  prm, Patterns::List(Patterns::Double(), 0, 2));
    add_parameter("Tolerance", tolerance, "Of the factor, over it [1].", prm, Patterns::Double());
    add_parameter("Watched probe", probe, "The probe of kind 'particle' that says whether it has failed.");
    add_parameter("Largest displacement", largest_moved,
                  "What has moved by more than that since the begin of the stage has failed [length].", prm,
                  Patterns::Double());
    add_parameter("Reset displacements", resets_displacement, "Displacements count from its begin.");
    add_parameter("Reset plastic strains", resets_plastic_strain,
                  "Plastic strains are zero at its begin; softening begins anew.");
  }

  void Stage::parse_parameters(ParameterHandler &)
  {
    if (!(duration > 0 && std::isfinite(duration)))
      throw EntryError(get_section_name(), "Duration",
                       "it must be positive: how long the stage lasts, at most if it ends at rest.");
    if (searches())
      check_search();
  }

  void Stage::check_search() const
  {
    const auto check = [&](const bool holds, const std::string &entry, const std::string &message) {
      if (!holds)
        throw EntryError(get_section_name(), entry, message);
    };
    check(factors.size() == 2 && factors[0] > 0 && factors[1] > factors[0], "Strength reduction",
          "give two factors, both positive, the first below the second, for instance 1, 2.");
    check(tolerance >= 1e-4 && tolerance < 1, "Tolerance",
          "it must lie between 1e-4 and 1; 0.005 takes about ten runs.");
    check(largest_moved > 0, "Largest displacement",
          "it must be positive, for instance a fiftieth of the height of a slope.");
  }

  Stages::Stages(const Parameters &file) : file(file), names(list(file, "Stages"))
  {
    auto bodies = list(file, "Bodies");
    for (const auto &stage : names)
    {
      const std::string section = "/Stages/" + stage;
      const auto        before  = bodies;
      if (file.is_set(section + "/Bodies", "Names"))
        bodies = list(file, section + "/Bodies");
      for (const auto &key : file.changed_by(stage))
      {
        std::string why  = why_fixed(key);
        const auto  path = split(key);
        if (path[0] == "Bodies" && path.size() > 2 && is_in(path[1], before) && is_in(path[1], bodies) &&
            stage != names.front() && path.back() != "Material")
          why = "the body is there already, and only its 'Material' can change. Take another name for a new body.";
        if (!why.empty())
          throw InputError(file.locate(EntryError(section + "/" + parent(key), leaf(key), why)));
      }
    }
    for (unsigned int n = 0; n < names.size(); ++n)
      if (searches(n))
        check_search(n);
  }

  void Stages::check_search(const unsigned int n) const
  {
    const std::string section = "/Stages/" + names[n], probe = file.value(section, "Watched probe", "");
    const auto        check = [&](const bool holds, const std::string &entry, const std::string &message) {
      if (!holds)
        throw InputError(file.locate(EntryError(section, entry, message)));
    };
    check(n > 0, "Strength reduction",
          "a search begins from a state of rest. Put a stage before it that comes to rest under the same loads.");
    check(is_in(probe, list(file, "Output/Probes")) &&
            file.value("/Output/Probes/" + probe, "Kind", "point") == "particle",
          "Watched probe",
          "name a probe of section 'Output/Probes' whose 'Kind' is 'particle', for instance at the crest of a slope.");
  }

  std::vector<std::unique_ptr<Stage>> Stages::declare(Parameters &parameters)
  {
    std::vector<std::unique_ptr<Stage>> stages;
    for (const auto &name : parameters.names("/Stages", "Names of the parts of a run, in their order; each has a "
                                                        "subsection of its name. None: the run has one part."))
      stages.push_back(std::make_unique<Stage>(name));
    return stages;
  }

  int Stages::stage_of(const std::string &key) const
  {
    const auto path = split(key);
    if (path.size() < 3 || path[0] != "Stages")
      return -1;
    const auto found = std::find(names.begin(), names.end(), path[1]);
    return found == names.end() ? -1 : static_cast<int>(found - names.begin());
  }
} // namespace Talus

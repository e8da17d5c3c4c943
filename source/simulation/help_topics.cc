#include <talus/simulation/help_topics.h>

#include <talus/core/exceptions.h>
#include <talus/core/libraries.h>
#include <talus/core/parameter_names.h>
#include <talus/simulation/simulation.h>

#include <sstream>

namespace Talus
{
  using namespace ParameterNames;

  namespace
  {
    /** Where a file chooses an object of a section, and what it has to have besides. */
    struct Kind
    {
      std::string section, object, entry, more;
    };

    const std::vector<Kind> &kinds()
    {
      static const std::vector<Kind> all = {{"Materials", "Materials/material", "Type", ""},
                                            {"Bodies", "Bodies/body", "Shape", ""},
                                            {"Conditions", "Conditions/condition", "Type", ""},
                                            {"Tractions", "Tractions/traction", "Type", ""},
                                            {"Contacts", "Contacts/contact", "Surface", ""},
                                            {"Obstacles", "Obstacles/obstacle", "Surface", ""},
                                            {"Grid", "Grid", "Type", ""},
                                            {"Kernel", "Kernel", "Type", ""},
                                            {"Transfer", "Transfer", "Type", ""},
                                            {"Verification", "Verification", "Solution", ""},
                                            {"FEM reference", "FEM reference", "Model", "FEM reference/Compare = yes"},
                                            {"Output/Probes", "Output/Probes/probe", "Kind", ""},
                                            {"Stages", "Stages/stage", "", "Stages/Names = stage"},
                                            {"Run", "Run", "", ""},
                                            {"Output", "Output", "", ""},
                                            {"Checkpoints", "Checkpoints", "", ""}};
      return all;
    }

    /** One of everything that has a name. */
    std::vector<std::string> one_of_each()
    {
      return {"Materials/Names = material", "Bodies/Names = body",      "Conditions/Names = condition",
              "Tractions/Names = traction", "Contacts/Names = contact", "Obstacles/Names = obstacle",
              "Output/Probes/Names = probe"};
    }

    std::string printed(const std::vector<std::string> &entries)
    {
      Parameters parameters = Parameters::from_text("", "a topic", entries);
      References<2>::allow_idle_entries(parameters);
      parameters.choose_from("", "Dimension", "2", "2|3", "Number of space dimensions; 2 is plane strain.");
      declare_libraries();
      const Simulation<2> simulation(parameters, MPI_COMM_SELF);
      parameters.enter_values();
      std::ostringstream text;
      parameters.print(text, /* with_help = */ true);
      return text.str();
    }

    /** The lines of a subsection of a text, with those that open and close it. */
    std::string part_of(const std::string &text, const std::string &section)
    {
      std::istringstream       in(text);
      std::vector<std::string> path;
      std::string              line, found;
      while (std::getline(in, line))
      {
        const std::string word = dealii::Utilities::trim(line);
        if (word.rfind("subsection ", 0) == 0)
          path.push_back(word.substr(11));
        const std::string here = join(path);
        if (here == section || here.rfind(section + "/", 0) == 0)
          found += line + '\n';
        if (word == "end")
          path.pop_back();
      }
      return found;
    }
  } // namespace

  std::string parameters_on(const std::string &topic)
  {
    auto entries = one_of_each();
    if (topic.empty())
      return printed(entries);
    std::string sections;
    for (const Kind &kind : kinds())
    {
      sections += (sections.empty() ? "" : ", ") + kind.section;
      const bool is_section = topic == kind.section;
      if (!is_section && (topic.rfind(kind.section + "/", 0) != 0 || kind.entry.empty()))
        continue;
      const std::string object = is_section ? "" : topic.substr(kind.section.size() + 1);
      if (object == "Probes")
        continue;
      if (!kind.more.empty())
        entries.push_back(kind.more);
      if (!object.empty())
        entries.push_back(kind.object + "/" + kind.entry + " = " + object);
      // Kernels of meshes.
      if (kind.section == "Kernel" && (object == "P1" || object.find("UMLS") != std::string::npos))
        entries.emplace_back("Grid/Type = mesh");
      return part_of(printed(entries), object.empty() ? kind.section : kind.object);
    }
    throw InputError("There is no help on '" + shortened(topic) +
                     "'. Give a section, or an object of a section as in " +
                     "\"Materials/Drucker-Prager\". Sections: " + sections + ". talus --list has the objects.");
  }
} // namespace Talus

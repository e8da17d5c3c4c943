#include <talus/core/parameter_names.h>
#include <talus/core/parameters.h>
#include <talus/core/pattern_text.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <sstream>

namespace Talus
{
  using namespace dealii;
  using namespace ParameterNames;

  namespace
  {
    void enter(ParameterHandler &prm, const std::vector<std::string> &path)
    {
      for (const auto &part : path)
        prm.enter_subsection(part);
    }

    void leave(ParameterHandler &prm, const std::vector<std::string> &path)
    {
      for (unsigned int i = 0; i < path.size(); ++i)
        prm.leave_subsection();
    }
  } // namespace

  const Parameters::Setting *Parameters::find(const std::string &section, const std::string &entry) const
  {
    const auto setting = settings.find(parameter_key(section, entry));
    return setting == settings.end() ? nullptr : &setting->second;
  }

  bool Parameters::is_left_out(const std::string &key) const
  {
    for (const auto &[section, names] : other_names)
    {
      const auto now = Utilities::split_string_list(value(section, "Names", ""));
      for (const auto &name : Utilities::split_string_list(names))
        if (key.rfind(section + "/" + name + "/", 0) == 0 && std::find(now.begin(), now.end(), name) == now.end())
          return true;
    }
    return false;
  }

  std::string Parameters::choose_from(const std::string &section, const std::string &entry,
                                      const std::string &default_value, const std::string &selection,
                                      const std::string &help)
  {
    auto      &prm  = ParameterAcceptor::prm;
    const auto path = split(section);
    enter(prm, path);
    prm.declare_entry(entry, default_value, Patterns::Selection(selection), help);
    leave(prm, path);

    const Setting *setting = find(section, entry);
    if (setting == nullptr)
      return default_value;
    const auto choices = Utilities::split_string_list(selection, '|');
    if (std::find(choices.begin(), choices.end(), setting->value) == choices.end())
    {
      std::string list;
      for (const auto &choice : choices)
        list += (list.empty() ? "" : ", ") + choice;
      throw InputError(setting->origin + ": " + describe(parameter_key(section, entry)) + ": there is no '" +
                       shortened(setting->value) + "'." + did_you_mean(setting->value, choices) + " Choices: " + list +
                       ".");
    }
    return setting->value;
  }

  std::vector<std::string> Parameters::names(const std::string &section, const std::string &help)
  {
    auto      &prm  = ParameterAcceptor::prm;
    const auto path = split(section);
    enter(prm, path);
    prm.declare_entry("Names", "", Patterns::List(Patterns::Anything()), help);
    leave(prm, path);

    const Setting *setting = find(section, "Names");
    if (setting == nullptr)
      return {};
    const auto list = Utilities::split_string_list(setting->value);
    for (unsigned int i = 0; i < list.size(); ++i)
    {
      const std::string where = setting->origin + ": " + describe(parameter_key(section, "Names")) + ": ";
      AssertThrow(list[i].find_first_of("/|=") == std::string::npos,
                  InputError(where + "the name '" + list[i] + "' must not contain '/', '|' or '='."));
      AssertThrow(std::find(list.begin(), list.begin() + i, list[i]) == list.begin() + i,
                  InputError(where + "'" + list[i] + "' stands there twice. Give each object its own name."));
    }
    return list;
  }

  bool Parameters::has_section(const std::string &section) const
  {
    const std::string start   = parameter_key(section, "");
    const auto        setting = settings.lower_bound(start);
    return setting != settings.end() && setting->first.compare(0, start.size(), start) == 0;
  }

  void Parameters::allow(const std::string &section, const std::string &entry, const std::string &reason)
  {
    idle[parameter_key(section, entry)] = reason;
    if (!reason.empty() && is_set(section, entry))
      warn(EntryError(section, entry, "it has no effect: " + reason));
  }

  std::vector<std::string> Parameters::declared_by(const std::function<void()> &build)
  {
    ParameterAcceptor::prm.clear();
    build();
    std::ostringstream text;
    ParameterAcceptor::prm.print_parameters(text, ParameterHandler::PRM | ParameterHandler::Short);
    ParameterAcceptor::prm.clear();
    std::istringstream       in(text.str());
    Parameters               declared;
    std::vector<std::string> path, entries;
    declared.scan(in, "declared", path);
    for (const auto &setting : declared.settings)
      entries.push_back(setting.first);
    return entries;
  }

  void Parameters::reject_unknown(const std::string &key, const Setting &setting) const
  {
    std::ostringstream text;
    ParameterAcceptor::prm.print_parameters(text, ParameterHandler::PRM | ParameterHandler::Short);
    std::istringstream       in(text.str());
    Parameters               declared;
    std::vector<std::string> path, siblings, known_sections;
    declared.scan(in, "declared", path);
    for (const auto &other : declared.settings)
      if (parent(other.first) == parent(key))
        siblings.push_back(leaf(other.first));
    for (const auto &[other, reason] : idle)
    {
      if (parent(other) == parent(key))
        siblings.push_back(leaf(other));
      known_sections.push_back(parent(other));
    }
    // Looking for the entry has made its section and those around it.
    for (const auto &section : declared.sections)
      if ((key + "/").find(section.first + "/") != 0)
        known_sections.push_back(section.first);

    if (siblings.empty())
    {
      std::string message = setting.origin + ": nothing reads the section '" + parent(key) + "'." +
                            did_you_mean(parent(key), known_sections);
      if (declared.settings.count(parameter_key(parent(parent(key)), "Names")))
        message += " If it belongs to an object, list '" + leaf(parent(key)) + "' in 'Names' of section '" +
                   parent(parent(key)) + "'.";
      throw InputError(message);
    }
    std::string list;
    for (const auto &sibling : siblings)
      list += (list.empty() ? "" : ", ") + sibling;
    throw InputError(setting.origin + ": unknown " + describe(key) + "." + did_you_mean(leaf(key), siblings) +
                     " Known there: " + list + ".");
  }

  void Parameters::enter_values()
  {
    auto &prm = ParameterAcceptor::prm;
    for (const auto &[key, setting] : settings)
    {
      if (idle.count(key) > 0 || is_left_out(key))
        continue;
      const auto path = split(parent(key));
      // set() finds out what is not declared; get() would do so in Debug builds only.
      enter(prm, path);
      std::string problem;
      bool        is_known = true;
      try
      {
        prm.set(leaf(key), setting.value);
      }
      catch (const ParameterHandler::ExcEntryUndeclared &)
      {
        is_known = false;
      }
      catch (const ParameterHandler::ExcValueDoesNotMatchPattern &error)
      {
        std::ostringstream text;
        error.print_info(text);
        problem = text.str();
      }
      leave(prm, path);
      if (!is_known && of_others.count(key) == 0)
        reject_unknown(key, setting);
      AssertThrow(problem.empty(), InputError(setting.origin + ": " + describe(key) + ": '" + shortened(setting.value) +
                                              "' is not a valid value. Give " + describe_pattern(problem) + "."));
    }
  }

  void Parameters::parse()
  {
    enter_values();
    auto &prm = ParameterAcceptor::prm;
    try
    {
      ParameterAcceptor::parse_all_parameters(prm);
    }
    catch (const EntryError &error)
    {
      // It was thrown inside its section, and clear() would not leave that for the next Parameters (in tests).
      leave(prm, split(error.section));
      throw;
    }
  }

  std::string Parameters::locate(const EntryError &error) const
  {
    const std::string key     = parameter_key(error.section, error.entry);
    const auto        setting = settings.find(key);
    const std::string where   = setting == settings.end() ? file_name : setting->second.origin;
    return where + ": " + describe(key) + ": " + error.message +
           (setting == settings.end() ? " (The entry is not set in the file; its default was used.)" : "");
  }

  void Parameters::print(std::ostream &out, const bool with_help) const
  {
    ParameterAcceptor::prm.print_parameters(
      out, (with_help ? ParameterHandler::PRM : ParameterHandler::PRM | ParameterHandler::Short) |
             ParameterHandler::KeepDeclarationOrder);
  }
} // namespace Talus

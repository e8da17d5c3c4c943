#include <talus/core/parameters.h>

#include <talus/core/pattern_text.h>
#include <talus/core/text_file.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cctype>
#include <numeric>
#include <sstream>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    std::string join(const std::vector<std::string> &path)
    {
      std::string key;
      for (const auto &part : path)
        key += (key.empty() ? "" : "/") + part;
      return key;
    }

    /** The parts of "/A/B" or "A/B"; none for "" and "/". */
    std::vector<std::string> split(const std::string &key)
    {
      std::vector<std::string> parts;
      for (const auto &part : Utilities::split_string_list(key, '/'))
        if (!part.empty())
          parts.push_back(part);
      return parts;
    }

    std::string parent(const std::string &key)
    {
      const auto slash = key.rfind('/');
      return slash == std::string::npos ? "" : key.substr(0, slash);
    }

    std::string leaf(const std::string &key)
    {
      const auto slash = key.rfind('/');
      return slash == std::string::npos ? key : key.substr(slash + 1);
    }

    /** "entry 'x' in section 'y'". */
    std::string describe(const std::string &key)
    {
      return "entry '" + leaf(key) + "'" + (parent(key).empty() ? "" : " in section '" + parent(key) + "'");
    }

    /** What follows `keyword` in `line`, or false when the line does not begin with it. */
    bool starts_with(const std::string &line, const std::string &keyword, std::string &rest)
    {
      if (line.size() < keyword.size())
        return false;
      for (unsigned int i = 0; i < keyword.size(); ++i)
        if (std::tolower(line[i]) != keyword[i])
          return false;
      if (line.size() > keyword.size() && !std::isspace(line[keyword.size()]))
        return false;
      rest = Utilities::trim(line.substr(keyword.size()));
      return true;
    }

    unsigned int edit_distance(const std::string &a, const std::string &b)
    {
      std::vector<unsigned int> row(b.size() + 1);
      std::iota(row.begin(), row.end(), 0);
      for (unsigned int i = 0; i < a.size(); ++i)
      {
        unsigned int diagonal = row[0]++;
        for (unsigned int j = 0; j < b.size(); ++j)
        {
          const bool         is_same = std::tolower(a[i]) == std::tolower(b[j]);
          const unsigned int best    = std::min({row[j] + 1, row[j + 1] + 1, diagonal + !is_same});
          diagonal                   = row[j + 1];
          row[j + 1]                 = best;
        }
      }
      return row.back();
    }

    std::string did_you_mean(const std::string &word, const std::vector<std::string> &candidates)
    {
      const std::string best = closest(word, candidates);
      return best.empty() ? "" : " Did you mean '" + best + "'?";
    }

    /** The text of a file; `where` begins the message of one that cannot be read or is empty. */
    std::string read(const std::string &file_name, const std::string &where, const std::string &purpose)
    {
      TextFile    file(file_name, purpose);
      std::string text;
      for (const auto &line : file.lines)
        text += line + '\n';
      if (file.problem.empty() && text.find_first_not_of(" \t\n") == std::string::npos)
        file.problem = purpose + " '" + file_name + "' is empty. Check the name.";
      if (where.empty() && !file.problem.empty())
        file.problem[0] = std::toupper(file.problem[0]);
      AssertThrow(file.problem.empty(), InputError(where + file.problem));
      return text;
    }

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

  std::string parameter_key(const std::string &section, const std::string &entry)
  {
    std::string key = section;
    while (!key.empty() && key.front() == '/')
      key.erase(0, 1);
    return key.empty() ? entry : key + "/" + entry;
  }

  std::string closest(const std::string &word, const std::vector<std::string> &candidates)
  {
    std::string  best;
    unsigned int distance = std::max<unsigned int>(3, word.size() / 3 + 1);
    for (const auto &candidate : candidates)
      if (const unsigned int d = edit_distance(word, candidate); d < distance)
      {
        distance = d;
        best     = candidate;
      }
    return best;
  }

  Parameters::Parameters(const std::string &file_name, const std::vector<std::string> &overrides) : file_name(file_name)
  {
    ParameterAcceptor::prm.clear();
    std::istringstream       in(read(file_name, "", "the parameter file"));
    std::vector<std::string> path;
    scan(in, file_name, path);
    for (const auto &text : overrides)
      add_override(text);
  }

  Parameters Parameters::from_text(const std::string &text)
  {
    ParameterAcceptor::prm.clear();
    Parameters               parameters;
    std::istringstream       in(text);
    std::vector<std::string> path;
    parameters.file_name = "text";
    parameters.scan(in, "text", path);
    return parameters;
  }

  void Parameters::scan(std::istream &in, const std::string &file_name, std::vector<std::string> &path)
  {
    const std::size_t depth = path.size();
    open_files.push_back(file_name);
    std::vector<std::string> opened_at;
    std::string              line, next, rest;
    for (unsigned int number = 1; std::getline(in, line); ++number)
    {
      const std::string origin = file_name + ":" + std::to_string(number);
      const auto        strip = [](const std::string &text) { return Utilities::trim(text.substr(0, text.find('#'))); };
      line                    = strip(line);
      while (!line.empty() && line.back() == '\\' && std::getline(in, next))
      {
        line.back() = ' ';
        line        = Utilities::trim(line + strip(next));
        ++number;
      }

      if (line.empty())
        continue;
      else if (starts_with(line, "subsection", rest))
      {
        AssertThrow(!rest.empty() && rest.find('/') == std::string::npos,
                    InputError(origin + ": a subsection needs a name without '/'."));
        path.push_back(rest);
        opened_at.push_back(origin);
        sections.emplace(join(path), origin);
      }
      else if (starts_with(line, "end", rest))
      {
        AssertThrow(rest.empty(), InputError(origin + ": nothing may follow 'end'."));
        AssertThrow(path.size() > depth, InputError(origin + ": this 'end' closes no subsection. Remove it."));
        path.pop_back();
        opened_at.pop_back();
      }
      else if (starts_with(line, "include", rest))
      {
        AssertThrow(!rest.empty(), InputError(origin + ": 'include' needs the name of a file."));
        const auto        slash = file_name.rfind('/');
        const std::string included =
          rest.front() == '/' || slash == std::string::npos ? rest : file_name.substr(0, slash + 1) + rest;
        AssertThrow(std::find(open_files.begin(), open_files.end(), included) == open_files.end(),
                    InputError(origin + ": '" + included + "' includes itself, directly or through another file."));
        std::istringstream file(read(included, origin + ": ", "the included file"));
        scan(file, included, path);
      }
      else if (starts_with(line, "set", rest))
      {
        const auto equal = rest.find('=');
        AssertThrow(equal != std::string::npos,
                    InputError(origin + ": expected 'set entry = value', found '" + line + "'."));
        auto here = path;
        here.push_back(Utilities::trim(rest.substr(0, equal)));
        const auto known = settings.find(join(here));
        AssertThrow(known == settings.end(), InputError(origin + ": " + describe(join(here)) + " was set before, at " +
                                                        known->second.origin + ". Remove one of the two."));
        settings[join(here)] = {Utilities::trim(rest.substr(equal + 1)), origin};
      }
      else
        throw InputError(origin + ": cannot understand '" + line +
                         "'. A line is 'subsection name', 'set entry = value', 'include file', 'end' or a # comment.");
    }
    AssertThrow(path.size() == depth, InputError(opened_at.back() + ": subsection '" + path.back() +
                                                 "' is never closed. Add 'end' where it stops."));
    open_files.pop_back();
  }

  void Parameters::add_override(const std::string &text)
  {
    const auto equal = text.find('=');
    AssertThrow(equal != std::string::npos, InputError("--set \"" + text + "\": expected \"Section/Entry = value\"."));
    settings[join(split(text.substr(0, equal)))] = {Utilities::trim(text.substr(equal + 1)), "--set \"" + text + "\""};
  }

  const Parameters::Setting *Parameters::find(const std::string &section, const std::string &entry) const
  {
    const auto setting = settings.find(parameter_key(section, entry));
    return setting == settings.end() ? nullptr : &setting->second;
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
                       setting->value + "'." + did_you_mean(setting->value, choices) + " Choices: " + list + ".");
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

  void Parameters::parse()
  {
    auto &prm = ParameterAcceptor::prm;
    for (const auto &[key, setting] : settings)
    {
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
      if (!is_known)
        reject_unknown(key, setting);
      AssertThrow(problem.empty(), InputError(setting.origin + ": " + describe(key) + ": '" + setting.value +
                                              "' is not a valid value. Give " + describe_pattern(problem) + "."));
    }
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

#include <talus/core/parameter_names.h>
#include <talus/core/parameters.h>
#include <talus/core/text_file.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cctype>
#include <sstream>

namespace Talus
{
  using namespace dealii;
  using namespace ParameterNames;

  namespace
  {
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

    /** The next line without comment, with those that a backslash joins to it; counts the lines read. */
    bool read_statement(std::istream &in, std::string &statement, unsigned int &n_read)
    {
      std::string line;
      const auto  read_line = [&] {
        if (!std::getline(in, line))
          return false;
        line = Utilities::trim(line.substr(0, line.find('#')));
        ++n_read;
        return true;
      };
      if (!read_line())
        return false;
      statement = line;
      while (!statement.empty() && statement.back() == '\\' && read_line())
      {
        statement.back() = ' ';
        statement        = Utilities::trim(statement + line);
      }
      return true;
    }

    /** A file named in another one: relative names begin where that lies. */
    std::string name_beside(const std::string &file_name, const std::string &name)
    {
      const auto slash = file_name.rfind('/');
      return name.front() == '/' || slash == std::string::npos ? name : file_name.substr(0, slash + 1) + name;
    }
  } // namespace

  Parameters::Parameters(const std::string &file_name, const std::vector<std::string> &overrides) : file_name(file_name)
  {
    ParameterAcceptor::prm.clear();
    std::istringstream       in(read(file_name, "", "the parameter file"));
    std::vector<std::string> path;
    scan(in, file_name, path);
    for (const auto &text : overrides)
      add_override(text);
  }

  Parameters Parameters::from_text(const std::string &text, const std::string &name,
                                   const std::vector<std::string> &overrides)
  {
    ParameterAcceptor::prm.clear();
    Parameters               parameters;
    std::istringstream       in(text);
    std::vector<std::string> path;
    parameters.file_name = name;
    parameters.scan(in, name, path);
    for (const auto &override_text : overrides)
      parameters.add_override(override_text);
    return parameters;
  }

  std::string Parameters::settings_text() const
  {
    if (!text_of_all.empty())
      return text_of_all;
    std::ostringstream       text;
    std::vector<std::string> open;
    for (const auto &[key, setting] : settings)
    {
      if (is_left_out(key))
        continue;
      const auto  path   = split(parent(key));
      std::size_t common = 0;
      while (common < std::min(path.size(), open.size()) && path[common] == open[common])
        ++common;
      for (; open.size() > common; open.pop_back())
        text << "end\n";
      for (; open.size() < path.size(); open.push_back(path[open.size()]))
        text << "subsection " << path[open.size()] << '\n';
      text << "set " << leaf(key) << " = " << setting.value << '\n';
    }
    for (; !open.empty(); open.pop_back())
      text << "end\n";
    return text.str();
  }

  std::vector<std::string> Parameters::changed_by(const std::string &stage) const
  {
    const std::string        start = parameter_key("/Stages/" + stage, "");
    std::vector<std::string> changed;
    for (auto setting = settings.lower_bound(start);
         setting != settings.end() && setting->first.compare(0, start.size(), start) == 0; ++setting)
      if (const std::string key = setting->first.substr(start.size()); key.find('/') != std::string::npos)
        changed.push_back(key);
    return changed;
  }

  Parameters Parameters::after_changes(const std::vector<std::string> &stages, const unsigned int n) const
  {
    ParameterAcceptor::prm.clear();
    Parameters result  = *this;
    result.text_of_all = settings_text();
    // What any stage lists, whether the run has it or not, may be described outside of stages.
    for (const auto &[key, setting] : settings)
      if (const auto path = split(key); path.size() > 3 && path.front() == "Stages" && path.back() == "Names")
      {
        const std::string section = join({path.begin() + 2, path.end() - 1});
        std::string      &others  = result.other_names[section];
        others += (others.empty() ? "" : ", ") + value(section, "Names", "") + ", " + setting.value;
      }
    for (unsigned int s = 0; s < stages.size(); ++s)
    {
      // Another law does not read what was said of the one before.
      for (const auto &key : changed_by(stages[s]))
        if (const std::string section = parent(key) + "/"; s < n && (leaf(key) == "Type" || leaf(key) == "Surface"))
          for (auto other = result.settings.lower_bound(section);
               other != result.settings.end() && other->first.compare(0, section.size(), section) == 0; ++other)
            result.of_others.insert(other->first);
      for (const auto &key : changed_by(stages[s]))
      {
        const std::string of_stage = parameter_key("/Stages/" + stages[s], key);
        result.settings.erase(of_stage);
        if (s < n)
        {
          result.settings[key] = settings.at(of_stage);
          result.of_others.erase(key);
        }
      }
    }
    return result;
  }

  void Parameters::scan(std::istream &in, const std::string &file_name, std::vector<std::string> &path)
  {
    const std::size_t depth = path.size();
    open_files.push_back(file_name);
    std::vector<std::string> opened_at;
    std::string              line, rest;
    for (unsigned int n_read = 0, number = 1; read_statement(in, line, n_read); number = n_read + 1)
    {
      const std::string origin = file_name + ":" + std::to_string(number);
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
        // "End time = 1" is meant as an entry.
        AssertThrow(rest.empty(),
                    InputError(origin + (line.find('=') == std::string::npos ?
                                           ": nothing may follow 'end'." :
                                           ": cannot understand '" + shortened(line) +
                                             "'. Is 'set' missing before it? Nothing may follow 'end'.")));
        AssertThrow(path.size() > depth, InputError(origin + ": this 'end' closes no subsection. Remove it."));
        path.pop_back();
        opened_at.pop_back();
      }
      else if (starts_with(line, "include", rest))
      {
        AssertThrow(!rest.empty(), InputError(origin + ": 'include' needs the name of a file."));
        const std::string included = name_beside(file_name, rest);
        AssertThrow(std::find(open_files.begin(), open_files.end(), included) == open_files.end(),
                    InputError(origin + ": '" + included + "' includes itself, directly or through another file."));
        std::istringstream file(read(included, origin + ": ", "the included file"));
        scan(file, included, path);
      }
      else if (starts_with(line, "set", rest))
      {
        const auto equal = rest.find('=');
        AssertThrow(equal != std::string::npos,
                    InputError(origin + ": expected 'set entry = value', found '" + shortened(line) + "'."));
        auto here = path;
        here.push_back(Utilities::trim(rest.substr(0, equal)));
        const auto known = settings.find(join(here));
        AssertThrow(known == settings.end(), InputError(origin + ": " + describe(join(here)) + " was set before, at " +
                                                        known->second.origin + ". Remove one of the two."));
        settings[join(here)] = {Utilities::trim(rest.substr(equal + 1)), origin};
      }
      else
        throw InputError(origin + ": cannot understand '" + shortened(line) + "'." +
                         (line.find('=') == std::string::npos ? "" : " Is 'set' missing before it?") +
                         " A line is 'subsection name', 'set entry = value', 'include file', 'end' or a # comment.");
    }
    AssertThrow(path.size() == depth, InputError(opened_at.back() + ": subsection '" + path.back() +
                                                 "' is never closed. Add 'end' where it stops."));
    open_files.pop_back();
  }

  void Parameters::add_override(const std::string &text)
  {
    const auto equal = text.find('=');
    AssertThrow(equal != std::string::npos,
                InputError("--set \"" + shortened(text) + "\": expected \"Section/Entry = value\"."));
    const std::string key   = join(split(text.substr(0, equal)));
    const auto        known = settings.find(key);
    if (known != settings.end() && leaf(key) == "Names")
      other_names.emplace(parent(key), known->second.value);
    settings[key] = {Utilities::trim(text.substr(equal + 1)), "--set \"" + shortened(text) + "\""};
  }
} // namespace Talus

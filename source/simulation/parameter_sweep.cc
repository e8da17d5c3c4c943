#include <talus/core/exceptions.h>
#include <talus/postprocess/files.h>
#include <talus/simulation/parameter_sweep.h>

#include <deal.II/base/utilities.h>

#include <fstream>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    /** Values between single bars: a formula may hold "||". */
    std::vector<std::string> values_of(const std::string &text)
    {
      std::vector<std::string> values(1);
      for (std::size_t i = 0; i < text.size(); ++i)
        if (text.compare(i, 2, "||") == 0)
        {
          values.back() += "||";
          ++i;
        }
        else if (text[i] == '|')
          values.emplace_back();
        else
          values.back() += text[i];
      for (auto &value : values)
        value = Utilities::trim(value);
      return values;
    }

    /** A cell of a CSV table. */
    std::string cell(const std::string &text)
    {
      if (text.find_first_of(",\"") == std::string::npos)
        return text;
      std::string quoted = "\"";
      for (const char letter : text)
        quoted += letter == '"' ? std::string("\"\"") : std::string(1, letter);
      return quoted + '"';
    }
  } // namespace

  ParameterSweep::ParameterSweep(const std::vector<std::string> &texts)
  {
    double n = 1;
    for (const auto &text : texts)
    {
      const auto equals = text.find('=');
      AssertThrow(
        equals != std::string::npos && equals > 0,
        InputError("--sweep needs \"Section/Entry = value | value\" after it, not '" + shortened(text) + "'."));
      entries.push_back({Utilities::trim(text.substr(0, equals)), values_of(text.substr(equals + 1))});
      n *= entries.back().values.size();
    }
    AssertThrow(n <= 10000, InputError("--sweep: these are more than 10000 runs."));
  }

  unsigned int ParameterSweep::size() const
  {
    unsigned int n = 1;
    for (const auto &entry : entries)
      n *= entry.values.size();
    return n;
  }

  std::vector<unsigned int> ParameterSweep::indices(unsigned int number) const
  {
    std::vector<unsigned int> result(entries.size());
    for (unsigned int e = entries.size(); e-- > 0; number /= entries[e].values.size())
      result[e] = number % entries[e].values.size();
    return result;
  }

  std::vector<std::string> ParameterSweep::overrides(const unsigned int number) const
  {
    const auto               chosen = indices(number);
    std::vector<std::string> result;
    for (unsigned int e = 0; e < entries.size(); ++e)
      result.push_back(entries[e].name + " = " + entries[e].values[chosen[e]]);
    return result;
  }

  std::string ParameterSweep::name(const unsigned int number) const
  {
    return Utilities::int_to_string(number + 1, std::to_string(size()).size());
  }

  void ParameterSweep::note(const std::string &directory, const unsigned int number, const int status)
  {
    std::ifstream file(directory + "/" + name(number) + "/statistics.csv");
    std::string   head, line, last;
    for (std::getline(file, head); std::getline(file, line);)
      last = line;
    if (columns.empty())
      columns = head;
    rows += name(number);
    const auto chosen = indices(number);
    for (unsigned int e = 0; e < entries.size(); ++e)
      rows += ',' + cell(entries[e].values[chosen[e]]);
    rows += ',' + std::to_string(status);
    if (!last.empty() && head == columns)
      rows += ',' + last;
    rows += '\n';
    write_complete_file(directory + "/sweep.csv", [&](std::ostream &out) {
      out << "run";
      for (const auto &entry : entries)
        out << ',' << cell(entry.name);
      out << ",exit status" << (columns.empty() ? "" : ",") << columns << '\n' << rows;
    });
  }
} // namespace Talus

#include <talus/core/exceptions.h>
#include <talus/core/text_file.h>
#include <talus/particles/point_table.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <regex>

namespace Talus
{
  namespace
  {
    const std::string blanks = " \t\v\f";

    std::string trim(const std::string &text)
    {
      const auto first = text.find_first_not_of(blanks);
      return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(blanks) - first + 1);
    }

    std::vector<std::string> split_at_blanks(const std::string &line)
    {
      std::vector<std::string> words;
      for (std::size_t begin = 0, end; (begin = line.find_first_not_of(blanks, begin)) != std::string::npos;
           begin             = end)
      {
        end = std::min(line.find_first_of(blanks, begin), line.size());
        words.push_back(line.substr(begin, end - begin));
      }
      return words;
    }

    std::vector<std::string> split_at(const std::string &line, const char separator)
    {
      std::vector<std::string> words;
      std::size_t              begin = 0;
      for (std::size_t end; (end = line.find(separator, begin)) != std::string::npos; begin = end + 1)
        words.push_back(trim(line.substr(begin, end - begin)));
      // What ends with a separator ends there.
      const std::string last = trim(line.substr(begin));
      if (!last.empty())
        words.push_back(last);
      return words;
    }

    /**
     * The parts of a line, which has one kind of separator: with two, commas may as well stand for decimal points, and
     * the parts between blanks will be no numbers.
     */
    std::vector<std::string> split(const std::string &line)
    {
      for (const char separator : {';', ','})
        if (line.find(separator) != std::string::npos)
        {
          const auto words = split_at(line, separator);
          for (const auto &word : words)
            if (word.find_first_of(blanks) != std::string::npos)
              return split_at_blanks(line);
          return words;
        }
      return split_at_blanks(line);
    }

    /** A column's name in small letters, without quotes. */
    std::string plain_name(const std::string &word)
    {
      std::string name;
      for (const unsigned char letter : word)
        if (letter != '"' && letter != '\'')
          name += static_cast<char>(std::tolower(letter));
      return name;
    }

    /** Whether a column that is called so can be what is read as `name`. */
    bool may_be(const std::string &called, const std::string &name, const std::vector<std::string> &names)
    {
      if (called == name)
        return true;
      // V, vol, dv, area: of a volume; anything else is something else.
      if (name == "volume")
        return called[0] == 'v' || called.rfind("dv", 0) == 0 || called[0] == 'a' || called.find("vol") != called.npos;
      const std::vector<std::string> others = {"id",      "index", "number", "nr",  "no",      "node",
                                               "element", "mass",  "m",      "rho", "density", "pressure"};
      return std::find(names.begin(), names.end(), called) == names.end() &&
             std::find(others.begin(), others.end(), called) == others.end() && called.rfind("vol", 0) != 0;
    }

    std::string list(const std::vector<std::string> &words)
    {
      std::string text;
      for (const auto &word : words)
        text += (text.empty() ? "" : " ") + word;
      return text;
    }
  } // namespace

  bool PointTable::is_header(const std::vector<std::string> &words, const std::string &where) const
  {
    double number = 0;
    for (const auto &word : words)
      if (read_number(word, number))
        return false;
    // "x [m]": units are no names.
    std::vector<std::string> found;
    for (const auto &word : words)
      if (word.find_first_of("[(") != 0)
        found.push_back(plain_name(word));
    for (unsigned int i = 0; i < names.size() && i < found.size(); ++i)
      AssertThrow(found[i].empty() || may_be(found[i], names[i], names),
                  InputError(where + ": the columns are called '" + shortened(list(found)) + "', but are read as '" +
                             list(names) + "'. Put them into this order, and call them so."));
    return true;
  }

  void PointTable::read_row(const std::vector<std::string> &words, const std::string &where)
  {
    const std::string wanted = std::to_string(names.size()) + " numbers (" + list(names) + ")";
    for (const auto &word : words)
    {
      double     number = 0;
      const bool is_one = read_number(word, number);
      AssertThrow(!word.empty(),
                  InputError(where + ": a number is missing between two separators. Complete the line."));
      if (!is_one && word.find(',') != std::string::npos)
        throw InputError(where + ": '" + shortened(word) +
                         "' is not a number. Write decimal points, not commas; separate numbers by blanks, or all of "
                         "them by commas, or by semicolons.");
      if (is_one && std::isinf(number) && word.find_first_of("iI") == std::string::npos)
        throw InputError(where + ": '" + shortened(word) + "' is too large for a number. Correct the line.");
      AssertThrow(is_one && std::isfinite(number),
                  InputError(where + ": '" + shortened(word) + "' is not a finite number. Correct the line."));
      numbers.push_back(number);
    }
    AssertThrow(words.size() == names.size(),
                InputError(where + ": expected " + wanted + ", found " + std::to_string(words.size()) +
                           (words.size() == 2 * names.size() ?
                              ". If commas stand for decimal points, write points. If not, correct the line." :
                              ". Complete or remove the line.")));
  }

  std::vector<std::string> PointTable::header(const std::vector<std::string> &lines)
  {
    for (const std::string &whole : lines)
    {
      const std::string line = trim(whole.substr(0, whole.find('#')));
      if (line.empty())
        continue;
      std::vector<std::string> names;
      // Units may have blanks.
      for (const auto &word : split(std::regex_replace(line, std::regex("\\[[^\\]]*\\]"), "")))
      {
        double      number = 0;
        std::string name   = plain_name(trim(word));
        if (read_number(name, number))
          return {};
        std::replace(name.begin(), name.end(), ' ', '_');
        names.push_back(name);
      }
      return names;
    }
    return {};
  }

  void PointTable::read(const std::vector<std::string> &lines, const std::string &file_name, const bool has_header)
  {
    bool is_first = true;
    for (unsigned int number = 1; number <= lines.size(); ++number)
    {
      const std::string &whole = lines[number - 1];
      const std::string  line  = trim(whole.substr(0, whole.find('#')));
      if (line.empty())
        continue;
      const std::string where = file_name + ":" + std::to_string(number);
      const bool        is_named =
        is_first &&
        (has_header || is_header(split_at_blanks(std::regex_replace(line, std::regex("[,;]"), " ")), where));
      is_first = false;
      if (is_named)
        continue;
      read_row(split(line), where);
      lines_of_rows.push_back(number);
    }
  }
} // namespace Talus

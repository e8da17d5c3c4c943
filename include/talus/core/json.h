#pragma once

#include <cmath>
#include <iomanip>
#include <sstream>
#include <string>
#include <vector>

namespace Talus
{
  /** An object in JSON, member by member, for other programs to read. Test: tests/core/json.cc. */
  class JsonObject
  {
  public:
    void add(const std::string &name, const std::string &text)
    {
      members.push_back(quoted(name) + ": " + quoted(text));
    }
    void add(const std::string &name, const char *text) { add(name, std::string(text)); }
    void add(const std::string &name, const double number) { members.push_back(quoted(name) + ": " + written(number)); }
    void add(const std::string &name, const JsonObject &object)
    {
      members.push_back(quoted(name) + ": " + object.text(/* indent = */ "  "));
    }
    void add(const std::string &name, const std::vector<std::string> &list)
    {
      std::string text;
      for (const auto &word : list)
        text += (text.empty() ? "" : ", ") + quoted(word);
      members.push_back(quoted(name) + ": [" + text + "]");
    }

    /** Without a line's end behind it. */
    std::string text(const std::string &indent = "") const
    {
      std::string text;
      for (const auto &member : members)
        text += (text.empty() ? "\n" : ",\n") + indent + "  " + member;
      return "{" + text + "\n" + indent + "}";
    }

  private:
    /** JSON has no infinity and no NaN. */
    static std::string written(const double number)
    {
      std::ostringstream text;
      text << std::setprecision(17) << number;
      return std::isfinite(number) ? text.str() : "null";
    }

    static std::string quoted(const std::string &text)
    {
      std::ostringstream quoted;
      quoted << '"';
      for (const char letter : text)
        if (letter == '"' || letter == '\\')
          quoted << '\\' << letter;
        else if (static_cast<unsigned char>(letter) < 32)
          quoted << "\\u" << std::hex << std::setw(4) << std::setfill('0') << static_cast<int>(letter);
        else
          quoted << letter;
      quoted << '"';
      return quoted.str();
    }

    std::vector<std::string> members;
  };
} // namespace Talus

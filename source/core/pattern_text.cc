#include <talus/core/pattern_text.h>

#include <deal.II/base/utilities.h>

#include <regex>

namespace Talus
{
  namespace
  {
    /** "a number between a and b", with only the bounds that are none of `unbounded`. */
    std::string range(const std::string &noun, const std::string &lower, const std::string &upper,
                      const std::string &unbounded)
    {
      const bool has_lower = lower != "-" + unbounded, has_upper = upper != unbounded;
      if (has_lower && has_upper)
        return noun + " between " + lower + " and " + upper;
      return noun + (has_lower ? " of at least " + lower : has_upper ? " of at most " + upper : "");
    }
  } // namespace

  std::string describe_pattern(const std::string &description)
  {
    // The value itself, which deal.II quotes first, may hold brackets.
    const auto        pattern = description.find("pattern");
    const auto        bracket = description.find('[', pattern == std::string::npos ? 0 : pattern);
    const auto        last    = description.rfind(']');
    const std::string text    = bracket == std::string::npos || last == std::string::npos ?
                                  description :
                                  description.substr(bracket, last - bracket + 1);
    std::smatch       m;
    if (std::regex_match(text, m, std::regex(R"(\[Double (\S+)\.\.\.(\S+) \(inclusive\)\])")))
      return range("a finite number", m[1], m[2], "MAX_DOUBLE");
    if (std::regex_match(text, std::regex(R"(\[Double\])")))
      return "a finite number";
    if (std::regex_match(text, m, std::regex(R"(\[Integer range (\S+)\.\.\.(\S+) \(inclusive\)\])")))
      return range("a whole number", m[1] == "-2147483648" ? "-2147483647" : m[1].str(), m[2], "2147483647");
    if (std::regex_match(text, std::regex(R"(\[Integer\])")))
      return "a whole number";
    if (std::regex_match(text, m, std::regex(R"(\[List of <(.*)> of length (\d+)\.\.\.(\d+) \(inclusive\).*\])")))
      return "a list, separated by commas, of " + (m[2] == m[3] ? m[2].str() : m[2].str() + " to " + m[3].str()) +
             " of this kind: " + describe_pattern(m[1]);
    if (std::regex_match(text, m, std::regex(R"(\[Selection (.*?)\s*\])")))
      return "one of " + dealii::Utilities::replace_in_string(m[1], "|", ", ");
    if (std::regex_match(text, std::regex(R"(\[Bool\])")))
      return "true or false";
    return text;
  }
} // namespace Talus

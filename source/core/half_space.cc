#include <talus/core/half_space.h>

#include <cmath>
#include <cstdlib>
#include <regex>

namespace Talus
{
  std::optional<HalfSpace> read_half_space(const std::string &text, const unsigned int dim)
  {
    const std::regex pattern("\\s*([xyz])\\s*(<=|>=)\\s*(\\S+)\\s*");
    std::smatch      parts;
    if (!std::regex_match(text, parts, pattern))
      return {};
    const std::string  number = parts[3];
    const unsigned int axis   = parts[1].str()[0] - 'x';
    char              *end    = nullptr;
    const double       x      = std::strtod(number.c_str(), &end);
    if (*end != '\0' || !std::isfinite(x) || axis >= dim)
      return {};
    return HalfSpace{axis, parts[2] == ">=", x};
  }
} // namespace Talus

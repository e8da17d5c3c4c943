#pragma once

#include <optional>
#include <string>

namespace Talus
{
  /** What lies at and beyond a plane across an axis, as users write it: "x <= 0.1". */
  struct HalfSpace
  {
    unsigned int axis;
    bool         is_upper; // beyond greater coordinates, ">="
    double       position; // [length]
  };

  /** Nothing where the text is none in `dim` dimensions. Test: tests/core/text.cc. */
  std::optional<HalfSpace> read_half_space(const std::string &text, const unsigned int dim);
} // namespace Talus

#pragma once

#include <string>

namespace Talus
{
  /**
   * What a dealii::Patterns::PatternBase allows, in words, from its description:
   * "a finite number of at least 0" for "[Double 0...MAX_DOUBLE (inclusive)]". deal.II's
   * sentence before it is skipped. Test: tests/errors.
   */
  std::string describe_pattern(const std::string &description);
} // namespace Talus

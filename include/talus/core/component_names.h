#pragma once

#include <string>
#include <vector>

namespace Talus
{
  /** Names of the n components of a field: "velocity_x", ...; blanks become underscores. */
  std::vector<std::string> component_names(const std::string &name, const unsigned int dim, const unsigned int n);
} // namespace Talus

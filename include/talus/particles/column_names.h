#pragma once

#include <talus/core/component_names.h>
#include <talus/particles/working_set.h>

#include <string>
#include <utility>
#include <vector>

namespace Talus
{
  /** Names of all columns of particles, and their numbers: "velocity_x", .... */
  template <int dim>
  std::vector<std::pair<std::string, unsigned int>> column_names(const WorkingSet<dim> &particles)
  {
    std::vector<std::pair<std::string, unsigned int>> names;
    for (const auto &field : particles.fields)
    {
      const auto components = component_names(field.name, dim, field.n_components);
      for (unsigned int c = 0; c < components.size(); ++c)
        names.emplace_back(components[c], field.first + c);
    }
    return names;
  }
} // namespace Talus

#pragma once

#include <talus/postprocess/checksum.h>
#include <talus/postprocess/particle_fields.h>

#include <cstdio>
#include <string>
#include <utility>
#include <vector>

namespace Talus
{
  /** Grows when older files cannot be read any more. */
  constexpr unsigned int checkpoint_format = 1;

  /** The line after HDF5's part of the file, of a length that hangs on nothing. */
  inline std::string end_of_checkpoint(const std::uint64_t n_bytes, const std::uint64_t checksum)
  {
    char number[24];
    std::snprintf(number, sizeof(number), "%020llu", static_cast<unsigned long long>(n_bytes));
    return "\nTalus checkpoint of " + std::string(number) + " bytes, checksum " + hexadecimal(checksum) + '\n';
  }

  /** Names of all columns, and their numbers. */
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

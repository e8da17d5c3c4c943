#pragma once

#include <talus/materials/material.h>
#include <talus/particles/working_set.h>

#include <algorithm>

namespace Talus
{
  /** What material `m` sees of its particles. The arrays are valid until particles are sorted or migrate. */
  template <int dim>
  MaterialRange material_range(WorkingSet<dim> &particles, const unsigned int m, const double dt);

  /** The same for all materials. */
  template <int dim>
  std::vector<MaterialRange> material_ranges(WorkingSet<dim> &particles, const double dt);

  /** The particles of a range that lie in [begin, end). */
  inline MaterialRange intersection(MaterialRange range, const unsigned int begin, const unsigned int end)
  {
    range.begin = std::max(range.begin, begin);
    range.end   = std::max(range.begin, std::min(range.end, end));
    return range;
  }
} // namespace Talus

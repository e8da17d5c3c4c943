#pragma once

#include <talus/materials/material.h>
#include <talus/particles/working_set.h>

#include <algorithm>

namespace Talus
{
  /** Fields of what materials see of the deformation where that is not the particles' own: see FBar. */
  struct SeenFields
  {
    unsigned int F, grad_v, volume;
  };

  /** Adds them. Before the first particle exists. */
  template <int dim>
  SeenFields add_seen_fields(WorkingSet<dim> &particles);

  /** Those that have been added, else the particles' own. */
  template <int dim>
  SeenFields seen_fields(const WorkingSet<dim> &particles);

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

#pragma once

#include <talus/materials/material.h>
#include <talus/particles/working_set.h>

#include <algorithm>

namespace Talus
{
  /** Adds a field for the velocity gradient by which particles deform where that is not their own: see FBar. Before the
   * first particle exists. */
  template <int dim>
  void add_seen_gradient(WorkingSet<dim> &particles);

  /** The field if it has been added, else that of the particles' own. */
  template <int dim>
  unsigned int seen_gradient(const WorkingSet<dim> &particles);

  /** What material `m` sees of its particles. The arrays are valid until particles are sorted or migrate. */
  template <int dim>
  MaterialRange material_range(WorkingSet<dim> &particles, const unsigned int m, const double dt);

  /** The same for all materials; `is_plain`: see MaterialRange. */
  template <int dim>
  std::vector<MaterialRange> material_ranges(WorkingSet<dim> &particles, const double dt, const bool is_plain = false);

  /** The particles of a range that lie in [begin, end). */
  inline MaterialRange intersection(MaterialRange range, const unsigned int begin, const unsigned int end)
  {
    range.begin = std::max(range.begin, begin);
    range.end   = std::max(range.begin, std::min(range.end, end));
    return range;
  }
} // namespace Talus

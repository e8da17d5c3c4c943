#pragma once

#include <talus/particles/working_set.h>

#include <algorithm>

namespace Talus
{
  /** Where the particles were, for a second look with the kernels of that place. Test: tests/steppers, MUSL. */
  template <int dim>
  class KeptPositions
  {
  public:
    void keep(const WorkingSet<dim> &particles)
    {
      for (unsigned int d = 0; d < dim; ++d)
      {
        const double *x = particles.component(particles.position, d);
        position[d].assign(x, x + particles.size());
      }
    }

    /** Puts the particles where they were, and back the second time; none may have come, gone or changed places. */
    void exchange(WorkingSet<dim> &particles)
    {
      for (unsigned int d = 0; d < dim; ++d)
        std::swap_ranges(position[d].begin(), position[d].end(), particles.component(particles.position, d));
    }

  private:
    std::array<std::vector<double>, dim> position;
  };
} // namespace Talus

#pragma once

#include <talus/particles/material_range.h>
#include <talus/particles/particles.h>

namespace Talus
{
  /** Eq. (27) of particles begin .. end - 1: deformation gradient and volume from grad v. */
  template <int dim>
  void deform(Particles<dim> &particles, const std::vector<std::unique_ptr<Material>> &materials,
              const std::vector<MaterialRange> &ranges, const unsigned int begin, const unsigned int end);

  /** Eqs. (27)-(30) of particles begin .. end - 1: deformation gradient and volume from grad v, then stress and state.
   */
  template <int dim>
  void update_stress(Particles<dim> &particles, const std::vector<std::unique_ptr<Material>> &materials,
                     const std::vector<MaterialRange> &ranges, const unsigned int begin, const unsigned int end);

  /** The same for all particles. */
  template <int dim>
  void update_stress(Particles<dim> &particles, const std::vector<std::unique_ptr<Material>> &materials,
                     const double dt);
} // namespace Talus

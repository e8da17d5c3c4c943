#pragma once

#include <talus/core/timing.h>
#include <talus/steppers/survey.h>

namespace Talus
{
  /** The sections of a step in the timing table. */
  struct StepTiming
  {
    explicit StepTiming(Timing &timing);

    Timing            &timing;
    const unsigned int particle_to_grid, grid, grid_to_particle, stress, relocate;
  };

  /** One explicit step in the order of Fig. 1, stress last; returns what the next one needs to know. Collective. */
  template <int dim>
  Survey<dim> explicit_step(Model<dim> &model, const double time, const double dt, const StepTiming &timing);

  /** Eqs. (27)-(30) of particles begin .. end - 1: deformation gradient, volume, stress and state from grad v. */
  template <int dim>
  void update_stress(Particles<dim> &particles, const std::vector<std::unique_ptr<Material>> &materials,
                     const std::vector<MaterialRange> &ranges, const unsigned int begin, const unsigned int end);

  /** The same for all particles. */
  template <int dim>
  void update_stress(Particles<dim> &particles, const std::vector<std::unique_ptr<Material>> &materials,
                     const double dt);
} // namespace Talus

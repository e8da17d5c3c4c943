#pragma once

#include <talus/boundary/condition.h>
#include <talus/materials/material.h>
#include <talus/particles/particles.h>
#include <talus/transfer/transfer.h>

#include <deal.II/base/timer.h>

namespace Talus
{
  /** The parts of a run that a step works on. */
  template <int dim>
  struct Model
  {
    Grid<dim>                              &grid;
    Particles<dim>                         &particles;
    Kernel<dim>                            &kernel;
    Transfer<dim>                          &transfer;
    Boundary<dim>                          &boundary;
    std::vector<std::unique_ptr<Material>> &materials;
    ParsedVector<dim>                      &acceleration; // body force per mass
  };

  /** One explicit step in the order of Fig. 1, stress last. */
  template <int dim>
  void explicit_step(Model<dim> &model, const double time, const double dt, dealii::TimerOutput &timer);

  /** Eqs. (27)-(30): deformation gradient, volume, stress and state from the new velocity gradients. */
  template <int dim>
  void update_stress(Particles<dim> &particles, const std::vector<std::unique_ptr<Material>> &materials,
                     const double dt);

  /** What material `m` sees of the particles. */
  template <int dim>
  MaterialRange material_range(Particles<dim> &particles, const Material &material, const unsigned int m,
                               const double dt);
} // namespace Talus

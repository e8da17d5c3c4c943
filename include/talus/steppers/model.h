#pragma once

#include <talus/boundary/condition.h>
#include <talus/core/body_force.h>
#include <talus/particles/material_range.h>
#include <talus/particles/particles.h>
#include <talus/transfer/tractions.h>
#include <talus/transfer/transfer.h>

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
    BodyForce<dim>                         &acceleration; // body force per mass
    Tractions<dim>                         &tractions;
  };
} // namespace Talus

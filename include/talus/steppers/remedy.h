#pragma once

#include <talus/steppers/model.h>

#include <string>

namespace Talus
{
  /** What helps against an instability of this run: its kernel, and how its steps are chosen, say what. */
  template <int dim>
  std::string remedy_of_instability(const Model<dim> &model);

  /** What helps where a particle has left the grid at x: a condition on a face that has none, or something else.
   * Collective. */
  template <int dim>
  std::string remedy_of_exit(const Model<dim> &model, const dealii::Tensor<1, dim> &x);
} // namespace Talus

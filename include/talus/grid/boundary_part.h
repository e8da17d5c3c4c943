#pragma once

#include <deal.II/base/tensor.h>

#include <vector>

namespace Talus
{
  /** A named part of a grid's boundary as conditions see it. */
  template <int dim>
  struct BoundaryPart
  {
    std::vector<unsigned int> nodes; // that this rank owns

    /**
     * For each of them the outward unit normals of the part's faces that meet there: one on a plane, several where it
     * turns.
     */
    std::vector<std::vector<dealii::Tensor<1, dim>>> normals;
  };
} // namespace Talus

#pragma once

#include <talus/core/simd.h>

#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>

namespace dealii
{
  /** Makes Talus::Simd a number type of deal.II's tensors: one tensor for each lane. */
  template <int width>
  struct EnableIfScalar<Talus::Simd<width>>
  {
    using type = Talus::Simd<width>;
  };
} // namespace dealii

namespace Talus
{
  /** One lane of a tensor. */
  template <int dim, typename Number>
  dealii::Tensor<2, dim> lane(const dealii::Tensor<2, dim, Number> &value, const int l)
  {
    dealii::Tensor<2, dim> result;
    for (unsigned int c = 0; c < dim * dim; ++c)
      result[c / dim][c % dim] = lane(value[c / dim][c % dim], l);
    return result;
  }
} // namespace Talus

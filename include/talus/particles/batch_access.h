#pragma once

#include <talus/core/batch.h>
#include <talus/core/tensors.h>

#include <array>

namespace Talus
{
  /** A vector field of the particles of a batch. */
  template <int dim, class Batch, typename Pointer>
  dealii::Tensor<1, dim, typename Batch::Number> load_vector(const Batch                    &batch,
                                                             const std::array<Pointer, dim> &columns)
  {
    dealii::Tensor<1, dim, typename Batch::Number> value;
    for (unsigned int d = 0; d < dim; ++d)
      value[d] = batch.load(columns[d]);
    return value;
  }

  /** A tensor field, stored row by row. */
  template <int dim, class Batch, typename Pointer>
  dealii::Tensor<2, dim, typename Batch::Number> load_matrix(const Batch                          &batch,
                                                             const std::array<Pointer, dim * dim> &columns)
  {
    dealii::Tensor<2, dim, typename Batch::Number> value;
    for (unsigned int c = 0; c < dim * dim; ++c)
      value[c / dim][c % dim] = batch.load(columns[c]);
    return value;
  }

  /** A symmetric tensor field, stored as xx, yy, zz, xy (, xz, yz). */
  template <int dim, class Batch, std::size_t n>
  dealii::Tensor<2, dim, typename Batch::Number> symmetric_matrix(const Batch                   &batch,
                                                                  const std::array<double *, n> &columns)
  {
    dealii::Tensor<2, dim, typename Batch::Number> value;
    for (unsigned int d = 0; d < dim; ++d)
      for (unsigned int e = 0; e < dim; ++e)
        value[d][e] = batch.load(columns[d == e ? d : 2 + d + e]);
    return value;
  }

  template <int dim, class Batch>
  void store_vector(const Batch &batch, const std::array<double *, dim> &columns,
                    const dealii::Tensor<1, dim, typename Batch::Number> &value)
  {
    for (unsigned int d = 0; d < dim; ++d)
      batch.store(columns[d], value[d]);
  }

  template <int dim, class Batch>
  void store_matrix(const Batch &batch, const std::array<double *, dim * dim> &columns,
                    const dealii::Tensor<2, dim, typename Batch::Number> &value)
  {
    for (unsigned int c = 0; c < dim * dim; ++c)
      batch.store(columns[c], value[c / dim][c % dim]);
  }
} // namespace Talus

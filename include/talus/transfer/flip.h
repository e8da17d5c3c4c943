#pragma once

#include <talus/transfer/affine_transfer.h>

namespace Talus
{
  /** FLIP, Eq. (22): the velocity changes by the grid's acceleration. */
  template <int dim>
  struct Flip : Scheme<dim>
  {
    static constexpr bool gathers_increment = true;

    template <class Batch>
    void update(const TransferArrays<dim> &arrays, const Batch &batch,
                const Gathered<dim, typename Batch::Number> &sum) const
    {
      store_vector<dim>(batch, arrays.velocity, load_vector<dim>(batch, arrays.velocity) + sum.increment);
    }
  };
} // namespace Talus

#pragma once

#include <talus/core/communicator.h>

#include <deal.II/base/tensor.h>

#include <vector>

namespace Talus
{
  /**
   * The numbers that are wanted of all ranks at once. Each part of a run registers its own; run() then replaces them
   * all by their greatest or their sum, with one message, and deterministically: in the order of MPI's ranks.
   *
   *     Reduction reduction;
   *     reduction.max(speed);
   *     reduction.sum(energy);
   *     reduction.run(communicator);
   *
   * Numbers must stay where they are until then. Test: tests/core/others.cc.
   */
  class Reduction
  {
  public:
    void max(double &value) { maxima.push_back(&value); }
    void sum(double &value) { sums.push_back(&value); }

    template <int dim>
    void sum(dealii::Tensor<1, dim> &vector)
    {
      for (unsigned int d = 0; d < dim; ++d)
        sums.push_back(&vector[d]);
    }

    void sum(std::vector<double> &values)
    {
      for (double &value : values)
        sums.push_back(&value);
    }

    /** True on all ranks if it is on one. */
    void any(bool &flag) { flags.push_back(&flag); }

    /** Collective; every rank has registered the same. */
    void run(const Communicator &communicator);

  private:
    std::vector<double *> maxima, sums;
    std::vector<bool *>   flags;
  };
} // namespace Talus

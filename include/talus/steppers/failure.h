#pragma once

#include <talus/steppers/model.h>

namespace Talus
{
  /** What each particle must keep; the order is that in which a particle's failures are told. */
  enum class Limit
  {
    finite,       // velocity and stress are finite numbers
    volume_ratio, // 0 < J <= the material's largest
    increment,    // |grad v| dt <= 0.5
    inside        // it lies in the grid
  };

  constexpr double largest_increment = 0.5; // of |grad v| dt in a step [1]

  /** A particle of this rank, by its place in the working set, that broke a limit in the last step. */
  struct Failure
  {
    unsigned int p;
    Limit        limit;
  };

  /**
   * Says which particle broke which limit where, as a RunError on all ranks: of those in `failures`, which the step has
   * found, and those that have left the grid the one with the lowest id. It decides nothing by itself: what was found is
   * what is told. Collective.
   */
  template <int dim>
  [[noreturn]] void report_failure(const Model<dim> &model, const std::vector<Failure> &failures,
                                   const unsigned int step, const double time, const double dt);
} // namespace Talus

#pragma once

#include <talus/steppers/model.h>
#include <talus/steppers/report.h>

namespace Talus
{
  /**
   * What is done now and then so that a step finds particles and nodes in good
   * shape: migration to other ranks, the order of the particles in memory, and the
   * list of nodes near material. All of it is due when particles have gone some way.
   */
  template <int dim>
  class Upkeep
  {
  public:
    /** Does what is due before the next step, of what the last one reports. Collective. */
    void run(Model<dim> &model, const Report &last);

    unsigned int n_migrations = 0, n_sorts = 0;

  private:
    // Displacements since the last time, of the fastest particle of each step [spacing].
    static constexpr double far        = 1e300;
    double                  since_sort = 0, since_activation = far;
    double                  staleness = 0; // the sum of since_sort over the steps
  };
} // namespace Talus

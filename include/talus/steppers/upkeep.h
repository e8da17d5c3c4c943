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

    void serialize(Archive &archive);

    /** Particles of the rank that has most over the mean, beyond which cells are shared out anew [1]; 0: never. */
    double largest_imbalance = 0;

    unsigned int n_migrations = 0, n_sorts = 0, n_balances = 0;
    std::string  news; // of the last run(), a sentence or nothing

  private:
    /** Shares the cells out anew if some rank has too many particles. Returns whether it has. Collective. */
    bool balance(Model<dim> &model, const Report &last);

    // Displacements since the last time, of the fastest particle of each step [spacing].
    static constexpr double far        = 1e300;
    double                  since_sort = 0, since_activation = far;
    double                  staleness      = 0; // the sum of since_sort over the steps
    unsigned int            since_balance  = 0; // steps
    double                  best_imbalance = 1; // what the last time led to
  };
} // namespace Talus

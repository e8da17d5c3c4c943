#include <talus/steppers/upkeep.h>

#include <algorithm>
#include <chrono>
#include <iomanip>
#include <sstream>

namespace Talus
{
  using namespace dealii;

  template <int dim>
  void Upkeep<dim>::run(Model<dim> &model, const Report &last)
  {
    since_sort += last.displacement;
    staleness += since_sort;
    since_activation += last.displacement;

    bool has_new_nodes = false;
    news.clear();
    if (balance(model, last))
    {
      since_sort = staleness = 0;
      since_activation       = far;
    }
    else if (last.needs_migration)
    {
      model.particles.migrate();
      ++n_migrations;
      const Communicator::Wait wait(model.grid.communicator);
      has_new_nodes = Utilities::MPI::logical_or(model.particles.brings_new_nodes, model.grid.communicator);
    }
    // Each spacing of drift makes a step some 3 ns per particle longer, and a sort takes 22 (measured in 2D): it is due
    // when what the present order has cost would have paid for it.
    if (staleness > 7)
    {
      model.particles.sort();
      since_sort = staleness = 0;
      ++n_sorts;
    }
    // Active nodes reach one spacing beyond the stencils, as far as the particle's rank knows them: who comes from
    // another rank may bring new ones.
    if (since_activation > 1 || has_new_nodes || last.needs_activation)
    {
      model.grid.activate(model.particles.used_places());
      model.particles.update_open_places();
      model.boundary.select(model.grid);
      model.walls.select();
      since_activation = 0;
    }
  }

  template <int dim>
  bool Upkeep<dim>::balance(Model<dim> &model, const Report &last)
  {
    // A partition is as good as cells allow: what is hardly worse than the last one will not get better.
    constexpr double       worth_it      = 1.05;
    constexpr unsigned int n_least_steps = 20;
    const double           n_ranks       = Utilities::MPI::n_mpi_processes(model.grid.communicator),
                 mean                    = model.particles.n_global / n_ranks;
    if (++since_balance < n_least_steps || n_ranks == 1 || !(largest_imbalance > 0) ||
        !(last.most_particles > mean * std::max(largest_imbalance, worth_it * best_imbalance)))
      return false;
    const auto start = std::chrono::steady_clock::now();
    model.particles.migrate();
    model.repartition(model.particles.counts());
    since_balance  = 0;
    best_imbalance = Utilities::MPI::max(model.particles.size(), model.grid.communicator) / mean;
    ++n_balances;
    std::ostringstream text;
    text << std::setprecision(3) << "cells shared out anew: the busiest rank had " << last.most_particles / mean
         << " times the mean number of particles, and has " << best_imbalance << " now; took "
         << std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() << " s";
    news = text.str();
    return true;
  }

  template <int dim>
  void Upkeep<dim>::serialize(Archive &archive)
  {
    const Archive::Scope scope(archive, "upkeep");
    archive("migrations", n_migrations);
    archive("sorts", n_sorts);
    archive("balances", n_balances);
    archive("since balance", since_balance);
    archive("best imbalance", best_imbalance);
    archive("since sort", since_sort);
    archive("staleness", staleness);
    archive("since activation", since_activation);
    if (archive.is_exact())
      return;
    since_sort = staleness = 0; // the particles have just been sorted, and nobody knows of their nodes
    since_activation       = far;
  }

  template class Upkeep<2>;
  template class Upkeep<3>;
} // namespace Talus

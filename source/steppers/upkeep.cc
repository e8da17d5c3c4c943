#include <talus/steppers/upkeep.h>

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
    if (last.needs_migration)
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

  template class Upkeep<2>;
  template class Upkeep<3>;
} // namespace Talus

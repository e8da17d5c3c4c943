#include <talus/steppers/musl.h>
#include <talus/transfer/velocity_gradient.h>

namespace Talus
{
  using namespace dealii;

  template <int dim>
  Musl<dim>::Musl()
  {
    no_force.initialize(dim == 2 ? "0; 0" : "0; 0; 0", "/", "");
  }

  template <int dim>
  void Musl<dim>::apply(Model<dim> &model, const double time, const double dt)
  {
    Grid<dim> &grid          = model.grid;
    const auto lost_momentum = grid.lost_momentum;
    positions.exchange(model.particles);
    grid.clear();
    model.walls.clear();
    model.transfer->particle_to_grid(model.particles, *model.kernel, no_force, time, grid);
    grid.fields.add_copies_to_owners();
    model.walls.collect();
    model.transfer->complete(grid);
    model.account.restart(grid, model.walls);
    if (!model.walls.has_ghosts())
      grid.update_velocity(/* dt = */ 0.); // v = p / m
    model.boundary.repeat(time + dt, dt, model.walls, grid);
    grid.fields.update_copies();
    model.walls.fill();
    model.account.repeat(dt, grid, model.walls);
    gather_velocity_gradient(grid, *model.kernel, model.transfer->is_plain, model.particles);
    positions.exchange(model.particles);
    grid.lost_momentum = lost_momentum;
  }

  template class Musl<2>;
  template class Musl<3>;
} // namespace Talus

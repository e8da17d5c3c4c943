#include <talus/core/exceptions.h>
#include <talus/particles/particles.h>

#include <unordered_map>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    /** This rank's cells by the grid's numbers for them. */
    template <int dim>
    std::unordered_map<std::size_t, typename Grid<dim>::CellIterator> owned_cells(const Grid<dim> &grid)
    {
      std::unordered_map<std::size_t, typename Grid<dim>::CellIterator> cells;
      for (const auto &cell : grid.triangulation.active_cell_iterators())
        if (cell->is_locally_owned())
          cells[grid.cell_number(cell->center())] = cell;
      return cells;
    }
  } // namespace

  template <int dim>
  dealii::Particles::ParticleHandler<dim> &Particles<dim>::home()
  {
    synchronise();
    const auto          cells = owned_cells(*grid);
    std::vector<double> properties(this->n_columns());
    for (unsigned int p = 0; p < this->size(); ++p)
    {
      const Point<dim>  x(this->vector(this->position, p)), location = grid->inside_cell(x);
      const std::size_t number = this->keeps_places ? this->place[p] : grid->cell_number(x);
      for (unsigned int c = 0; c < this->n_columns(); ++c)
        properties[c] = this->column(c)[p];
      const auto &cell = cells.at(number);
      handler->insert_particle(location, grid->unit_point(cell, location), this->id[p], cell,
                               make_array_view(properties));
    }
    handler->update_cached_numbers();
    this->resize(0);
    std::fill(this->material_begin.begin(), this->material_begin.end(), 0);
    ++arrangement;
    return *handler;
  }

  template <int dim>
  void Particles<dim>::take_back()
  {
    handler->update_cached_numbers();
    const double n_now = Utilities::MPI::sum<double>(handler->n_locally_owned_particles(), grid->communicator);
    AssertThrow(n_now <= n_global,
                RunError("Particles were added to the ParticleHandler of the run. Add a body instead."));
    // Where a particle lies is what its cell says; position and place follow from it where they can.
    std::vector<std::size_t> number;
    for (const auto &particle : *handler)
    {
      const auto &cell = particle.get_surrounding_cell();
      number.push_back(grid->cell_number(cell->center()));
    }
    load(number.size());
    for (unsigned int p = 0; p < this->size(); ++p)
      if (this->keeps_places)
        this->place[p] = number[p];
      else
        AssertThrow(grid->cell_number(Point<dim>(this->vector(this->position, p))) == number[p],
                    RunError("Particle " + std::to_string(this->id[p]) +
                             " was moved while deal.II's ParticleHandler held it. Change its velocity instead."));
    n_global = static_cast<std::uint64_t>(n_now);
    sort();
  }

#define INSTANTIATE(dim)                                                                                               \
  template dealii::Particles::ParticleHandler<dim> &Particles<dim>::home();                                            \
  template void                                     Particles<dim>::take_back();
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Talus

#include <talus/core/exceptions.h>
#include <talus/core/memory.h>
#include <talus/particles/amount.h>
#include <talus/particles/particles.h>

#include <algorithm>
#include <limits>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    /** Visits what a body puts into a cell: where a point lies is the grid's arithmetic alone. */
    template <int dim, class Visitor>
    void visit_cell(const Grid<dim> &grid, const Body<dim> &body, const typename Grid<dim>::CellIterator &cell,
                    const Visitor &visitor)
    {
      const auto number = grid.cell_number(cell->center());
      body.shape->visit(grid.cell_box(cell), [&](const std::uint64_t i, Point<dim> x, double volume) {
        volume *= body.is_clipped ? grid.share_inside(x) : grid.enter(x);
        if (volume > 0 && grid.cell_number(x) == number)
          visitor(i, x, volume);
      });
    }

    /** Numbers the points of all shapes in their order; what each body shall have. */
    template <int dim>
    std::vector<Amount> number_points(const Grid<dim> &grid, std::vector<std::unique_ptr<Body<dim>>> &bodies)
    {
      std::vector<Amount>     wanted;
      std::uint64_t           next_id = 0;
      constexpr std::uint64_t n_ids   = std::numeric_limits<types::particle_index>::max();
      for (const auto &body : bodies)
      {
        wanted.push_back(amount_of_shape(grid, *body));
        body->first_id = next_id;
        next_id += body->shape->n_indices();
        AssertThrow(next_id <= n_ids,
                    InputError("The bodies have " + std::to_string(next_id) +
                               " points, more than this deal.II can number (" + std::to_string(n_ids) +
                               "). Use one with 64-bit indices, or fewer particles."));
      }
      return wanted;
    }
  } // namespace

  template <int dim>
  unsigned int Particles<dim>::count(const Grid<dim> &grid, const std::vector<std::unique_ptr<Body<dim>>> &bodies,
                                     const typename Grid<dim>::CellIterator &cell)
  {
    unsigned int n = 0;
    for (const auto &body : bodies)
      visit_cell(grid, *body, cell, [&](auto...) { ++n; });
    return n;
  }

  template <int dim>
  void Particles<dim>::create(Grid<dim> &grid, std::vector<std::unique_ptr<Body<dim>>> &bodies,
                              const std::vector<std::unique_ptr<Material>> &materials, const double smallest_share)
  {
    this->grid = &grid;
    handler =
      std::make_unique<dealii::Particles::ParticleHandler<dim>>(grid.triangulation, grid.mapping, this->n_columns());

    // A rank's share and some more: what is reserved too much is never touched, and growing step by step costs time.
    double n_indices = 0;
    for (const auto &body : bodies)
      n_indices += body->shape->n_indices();
    this->reserve(1.1 * n_indices / Utilities::MPI::n_mpi_processes(grid.communicator));
    constexpr unsigned int portion   = 1 << 14; // by which the handler is emptied: one fits into the cache
    unsigned int           n_handled = 0;

    std::vector<double>        properties(this->n_columns());
    std::vector<std::uint64_t> n_created(bodies.size(), 0);
    std::vector<double>        volume_created(bodies.size(), 0);
    const std::vector<Amount>  wanted       = number_points(grid, bodies);
    double                     largest_mass = 0;
    for (unsigned int b = 0; b < bodies.size(); ++b)
    {
      Body<dim> &body = *bodies[b];
      body.find_given_columns(*this);
      body_begin.push_back(body.first_id);
      body_material.push_back(body.material);
      for (const auto &cell : grid.triangulation.active_cell_iterators())
        if (cell->is_locally_owned())
          visit_cell(grid, body, cell, [&](const std::uint64_t i, const Point<dim> &x, const double volume) {
            const Point<dim> location = grid.inside_cell(x);
            body.initialize(i, x, volume, *materials[body.material], *this, properties);
            handler->insert_particle(location, grid.unit_point(cell, location), body.first_id + i, cell,
                                     make_array_view(properties));
            largest_mass = std::max(largest_mass, volume * materials[body.material]->density);
            ++n_created[b];
            volume_created[b] += volume;
            if (++n_handled == portion)
            {
              load(n_handled);
              n_handled = 0;
            }
          });
    }
    load(n_handled);
    if (this->keeps_places)
      for (unsigned int p = 0; p < this->size(); ++p)
        this->place[p] = grid.cell_number(Point<dim>(this->vector(this->position, p)));

    Utilities::MPI::sum(n_created, grid.communicator, n_created);
    Utilities::MPI::sum(volume_created, grid.communicator, volume_created);
    for (unsigned int b = 0; b < bodies.size(); ++b)
    {
      check_amount(*bodies[b], {n_created[b], volume_created[b]}, wanted[b]);
      n_global += n_created[b];
    }
    // The largest nodal mass is that of a few particles.
    grid.mass_floor                = smallest_share * Utilities::MPI::max(largest_mass, grid.communicator);
    const unsigned int n_materials = *std::max_element(body_material.begin(), body_material.end()) + 1;
    this->material_begin.assign(n_materials + 1, 0);
    sort();
    if (reach.at_corners)
      check_initial_corners(bodies);
    return_free_memory(); // of the handler's particles
  }

  template <int dim>
  void Particles<dim>::load(const unsigned int n)
  {
    unsigned int p = this->size();
    this->resize(p + n);
    for (auto &particle : *handler)
    {
      this->id[p]           = particle.get_id();
      this->body[p]         = body_of(this->id[p]);
      const auto properties = particle.get_properties();
      for (unsigned int c = 0; c < this->n_columns(); ++c)
        this->column(c)[p] = properties[c];
      ++p;
    }
    AssertDimension(p, this->size());
    handler->clear();
  }

#define INSTANTIATE(dim)                                                                                               \
  template unsigned int Particles<dim>::count(const Grid<dim> &, const std::vector<std::unique_ptr<Body<dim>>> &,      \
                                              const typename Grid<dim>::CellIterator &);                               \
  template void         Particles<dim>::create(Grid<dim> &, std::vector<std::unique_ptr<Body<dim>>> &,                 \
                                               const std::vector<std::unique_ptr<Material>> &, const double);          \
  template void         Particles<dim>::load(const unsigned int);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Talus

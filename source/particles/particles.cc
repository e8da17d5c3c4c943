#include <talus/core/batch.h>
#include <talus/core/exceptions.h>
#include <talus/particles/particles.h>

#include <algorithm>
#include <limits>
#include <sstream>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    /** The cell that contains x, as a position in the lattice's tables; only for x near this rank. */
    template <int dim>
    typename Lattice<dim>::Index cell_index(const Lattice<dim> &lattice, const double *x)
    {
      typename Lattice<dim>::Index index;
      for (unsigned int d = 0; d < dim; ++d)
        index[d] = static_cast<int>(std::floor(lattice.coordinate(x[d], d)));
      return index;
    }

    /** x, moved off the faces of its cell, on which deal.II may lose a particle. */
    template <int dim>
    Point<dim> inside_cell(const Lattice<dim> &lattice, const double *x)
    {
      constexpr double margin = 1e-6;
      Point<dim>       inside;
      const auto       cell = cell_index(lattice, x);
      for (unsigned int d = 0; d < dim; ++d)
      {
        const double local = lattice.coordinate(x[d], d) - cell[d];
        inside[d] = lattice.origin[d] + lattice.h[d] * (cell[d] + std::min(std::max(local, margin), 1 - margin));
      }
      return inside;
    }

    /** Visits what the bodies put into a cell. */
    template <int dim, class Visitor>
    void visit_cell(const Grid<dim> &grid, const Body<dim> &body, const typename Grid<dim>::CellIterator &cell,
                    const Visitor &visitor)
    {
      const auto index = cell_index(grid.lattice, &cell->center()[0]);
      body.shape->visit(cell->bounding_box(), [&](const unsigned int i, const Point<dim> &x, const double volume) {
        if (cell_index(grid.lattice, &x[0]) == index)
          visitor(i, x, volume);
      });
    }

    /** Throws unless all points of the body lie in the grid. Looks beyond the grid's faces only; all ranks alike. */
    template <int dim>
    void check_inside(const Grid<dim> &grid, const Body<dim> &body)
    {
      constexpr double far  = 1e300;
      const auto       look = [&](const unsigned int, const Point<dim> &x, const double) {
        bool is_inside = true;
        for (unsigned int d = 0; d < dim; ++d)
          is_inside = is_inside && grid.lattice.is_inside(grid.lattice.coordinate(x[d], d), d);
        if (!is_inside)
          throw EntryError(body.get_section_name(), body.shape->position_entry(),
                                 "the body's point " + to_text<dim>(x) + " lies outside the grid, which reaches from " +
                                   to_text<dim>(grid.lower) + " to " + to_text<dim>(grid.upper) +
                                   ", upper faces excluded. Move the body, or enlarge the grid.");
      };
      for (unsigned int face = 0; face < 2 * dim; ++face)
      {
        Point<dim> lower, upper;
        for (unsigned int d = 0; d < dim; ++d)
        {
          lower[d] = -far;
          upper[d] = far;
        }
        (face % 2 == 0 ? upper : lower)[face / 2] = (face % 2 == 0 ? grid.lower : grid.upper)[face / 2];
        body.shape->visit(BoundingBox<dim>({lower, upper}), look);
      }
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
                              const std::vector<std::unique_ptr<Material>> &materials)
  {
    this->grid = &grid;
    mapping    = std::make_unique<MappingCartesian<dim>>();
    home = std::make_unique<dealii::Particles::ParticleHandler<dim>>(grid.triangulation, *mapping, this->n_columns());

    std::vector<double>        properties(this->n_columns());
    std::vector<std::uint64_t> n_created(bodies.size(), 0);
    std::uint64_t              next_id      = 0;
    double                     largest_mass = 0;
    for (unsigned int b = 0; b < bodies.size(); ++b)
    {
      Body<dim> &body = *bodies[b];
      check_inside(grid, body);
      body.first_id = next_id;
      next_id += body.shape->n_indices();
      AssertThrow(
        next_id <= std::numeric_limits<types::particle_index>::max(),
        InputError("The bodies have more particles than this deal.II can number. Use one with 64-bit indices."));
      body_begin.push_back(body.first_id);
      body_material.push_back(body.material);
      for (const auto &cell : grid.triangulation.active_cell_iterators())
        if (cell->is_locally_owned())
          visit_cell(grid, body, cell, [&](const unsigned int i, const Point<dim> &x, const double volume) {
            const Point<dim> location = inside_cell(grid.lattice, &x[0]);
            body.initialize(x, volume, *materials[body.material], *this, properties);
            home->insert_particle(location, mapping->transform_real_to_unit_cell(cell, location), body.first_id + i,
                                  cell, make_array_view(properties));
            largest_mass = std::max(largest_mass, volume * materials[body.material]->density);
            ++n_created[b];
          });
    }
    home->update_cached_numbers();

    Utilities::MPI::sum(n_created, grid.communicator, n_created);
    for (unsigned int b = 0; b < bodies.size(); ++b)
    {
      if (n_created[b] == 0)
        throw EntryError(
          bodies[b]->get_section_name(), bodies[b]->shape->position_entry(),
          "the body is empty: no particle lies in it. Check its corners, its lattice offset or its particles per cell.");
      n_global += n_created[b];
    }
    // Of the order of 1e-12 of the largest nodal mass, which is that of a few particles.
    grid.mass_floor = 1e-12 * Utilities::MPI::max(largest_mass, grid.communicator);
    load();
  }

  template <int dim>
  void Particles<dim>::set_stencil(const Grid<dim> &grid, const unsigned int n, const double shift)
  {
    // deal.II loses a particle beyond this rank's ghost cells, so one must be noticed well before: linear functions
    // (n = 2), which could do with the ghost cell alone, keep the distance of the quadratic ones.
    this->grid    = &grid;
    coverage      = grid.lattice.coverage(std::max(n, 3u));
    stencil_shift = n < 3 ? 0.5 : shift;

    knows_all_stencils = Utilities::MPI::n_mpi_processes(grid.communicator) == 1;
  }

  template <int dim>
  void Particles<dim>::start_relocation()
  {
    outside           = none;
    needs_synchronise = false;
  }

  template <int dim>
  void Particles<dim>::relocate(const unsigned int begin, const unsigned int end)
  {
    using Number        = Simd<native_width>;
    const auto &lattice = grid->lattice;
    const auto  x       = this->template components<dim>(this->position);
    bool        strays  = false;
    for_each_batch(begin, end, [&](const auto batch) {
      std::array<Number, dim> coordinate;
      auto                    is_outside = Number(1.) < Number(0.);
      for (unsigned int d = 0; d < dim; ++d)
      {
        coordinate[d] = (batch.load(x[d]) - lattice.origin[d]) * lattice.inverse_h[d];
        is_outside    = is_outside | !(coordinate[d] >= Number(0.) & coordinate[d] < Number(lattice.n_cells[d]));
      }
      if (any(is_outside))
      {
        for (unsigned int l = 0; l < batch.size(); ++l)
          if (is_outside[l])
            outside = std::min(outside, batch.p + l);
      }
      else if (!knows_all_stencils)
      {
        alignas(64) int base[dim][Number::n_lanes];
        for (unsigned int d = 0; d < dim; ++d)
          floor(coordinate[d] - Number(stencil_shift), base[d]);
        for (unsigned int l = 0; l < batch.size(); ++l)
        {
          typename Lattice<dim>::Index index;
          for (unsigned int d = 0; d < dim; ++d)
            index[d] = base[d][l];
          strays = strays || !lattice.is_in_table(index) || !coverage[lattice.table_index(index)];
        }
      }
    });
    needs_synchronise = needs_synchronise || strays;
  }

  template <int dim>
  void Particles<dim>::synchronise()
  {
    store();
    home->sort_particles_into_subdomains_and_cells();
    AssertThrow(home->n_global_particles() == n_global,
                RunError("Particles were lost between ranks: " + std::to_string(home->n_global_particles()) + " of " +
                         std::to_string(n_global) + " are left. Lower the Courant number."));
    load();
    needs_synchronise = false;
  }

  template <int dim>
  void Particles<dim>::store()
  {
    std::vector<double> properties(this->n_columns());
    const auto          x = this->template components<dim>(this->position);
    unsigned int        k = 0;
    for (auto &particle : *home)
    {
      const unsigned int p = slot[k++];
      for (unsigned int c = 0; c < this->n_columns(); ++c)
        properties[c] = this->column(c)[p];
      double position[dim];
      for (unsigned int d = 0; d < dim; ++d)
        position[d] = x[d][p];
      particle.set_location(inside_cell(grid->lattice, position));
      particle.set_properties(make_array_view(properties));
    }
  }

  template <int dim>
  void Particles<dim>::load()
  {
    struct Entry
    {
      unsigned int          material;
      std::uint64_t         cell;
      types::particle_index id;
      unsigned int          k; // number in the home's order
      unsigned int          body;
      const double         *properties;
      bool                  operator<(const Entry &other) const
      {
        return std::tie(material, cell, id) < std::tie(other.material, other.cell, other.id);
      }
    };
    std::vector<Entry> entries;
    entries.reserve(home->n_locally_owned_particles());
    const auto &lattice = grid->lattice;
    for (auto &particle : *home)
    {
      Entry entry;
      entry.id         = particle.get_id();
      entry.k          = entries.size();
      entry.body       = std::upper_bound(body_begin.begin(), body_begin.end(), entry.id) - body_begin.begin() - 1;
      entry.material   = body_material[entry.body];
      entry.properties = particle.get_properties().data();
      const auto cell  = cell_index(lattice, entry.properties + this->fields[this->position].first);
      entry.cell       = 0;
      for (int d = dim - 1; d >= 0; --d)
        entry.cell = entry.cell * lattice.n_cells[d] + cell[d];
      entries.push_back(entry);
    }
    std::sort(entries.begin(), entries.end());

    this->resize(entries.size());
    slot.resize(entries.size());
    const unsigned int n_materials = *std::max_element(body_material.begin(), body_material.end()) + 1;
    this->material_begin.assign(n_materials + 1, 0);
    for (unsigned int p = 0; p < entries.size(); ++p)
    {
      const Entry &entry = entries[p];
      slot[entry.k]      = p;
      this->id[p]        = entry.id;
      this->body[p]      = entry.body;
      ++this->material_begin[entry.material + 1];
      for (unsigned int c = 0; c < this->n_columns(); ++c)
        this->column(c)[p] = entry.properties[c];
    }
    for (unsigned int m = 0; m < n_materials; ++m)
      this->material_begin[m + 1] += this->material_begin[m];
  }

  template class Particles<2>;
  template class Particles<3>;
} // namespace Talus

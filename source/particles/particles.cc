#include <talus/core/batch.h>
#include <talus/core/exceptions.h>
#include <talus/particles/particles.h>

#ifdef __GLIBC__
#include <malloc.h>
#endif

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

  namespace
  {
    /** The home's particles were many small pieces, which the C library would keep for later. */
    void return_free_memory()
    {
#ifdef __GLIBC__
      malloc_trim(0);
#endif
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

    // A rank's share and some more: what is reserved too much is never touched, and growing step by step costs time.
    double n_indices = 0;
    for (const auto &body : bodies)
      n_indices += body->shape->n_indices();
    this->reserve(1.1 * n_indices / Utilities::MPI::n_mpi_processes(grid.communicator));
    // The home is emptied by portions that fit into the cache.
    constexpr unsigned int portion = 1 << 14;
    unsigned int           n_home  = 0;

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
            if (++n_home == portion)
            {
              load(n_home);
              n_home = 0;
            }
          });
    }
    load(n_home);

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
    grid.mass_floor                = 1e-12 * Utilities::MPI::max(largest_mass, grid.communicator);
    const unsigned int n_materials = *std::max_element(body_material.begin(), body_material.end()) + 1;
    this->material_begin.assign(n_materials + 1, 0);
    sort();
    return_free_memory();
  }

  template <int dim>
  void Particles<dim>::set_stencil(Grid<dim> &grid, const unsigned int n, const double shift)
  {
    this->grid      = &grid;
    coverage        = grid.lattice.coverage(n);
    stencil_shift   = shift;
    n_stencil_nodes = n;

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
          store_integers(floor(coordinate[d] - Number(stencil_shift)), base[d]);
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
  unsigned int Particles<dim>::body_of(const types::particle_index id) const
  {
    return std::upper_bound(body_begin.begin(), body_begin.end(), id) - body_begin.begin() - 1;
  }

  template <int dim>
  std::vector<unsigned int> Particles<dim>::ranks_of(const std::vector<unsigned int> &particles) const
  {
    std::vector<unsigned int> ranks(particles.size()), far;
    std::vector<Point<dim>>   far_points;
    for (unsigned int i = 0; i < particles.size(); ++i)
    {
      const Point<dim> x(this->vector(this->position, particles[i]));
      const auto       cell = cell_index(grid->lattice, &x[0]);
      ranks[i] = grid->lattice.is_in_table(cell) ? grid->lattice.owner[grid->lattice.table_index(cell)] : none;
      if (ranks[i] == none)
      {
        far.push_back(i);
        far_points.push_back(inside_cell(grid->lattice, &x[0]));
      }
    }
    // Seldom: a particle has crossed all cells that this rank knows.
    if (Utilities::MPI::max<unsigned int>(far.size(), grid->communicator) > 0)
    {
      const auto found = grid->triangulation.find_point_owner_rank(far_points);
      for (unsigned int i = 0; i < far.size(); ++i)
      {
        AssertThrow(found[i] < Utilities::MPI::n_mpi_processes(grid->communicator),
                    RunError("Particle " + std::to_string(this->id[particles[far[i]]]) + " at " +
                             to_text<dim>(far_points[i]) +
                             " was lost between ranks: no cell holds it. Lower the Courant number."));
        ranks[far[i]] = found[i];
      }
    }
    return ranks;
  }

  template <int dim>
  void Particles<dim>::migrate()
  {
    needs_synchronise          = false;
    const unsigned int my_rank = Utilities::MPI::this_mpi_process(grid->communicator);
    if (Utilities::MPI::n_mpi_processes(grid->communicator) == 1)
      return;
    const auto &lattice = grid->lattice;
    const auto  x       = this->template components<dim>(this->position);

    std::vector<unsigned int> leavers;
    for (unsigned int p = 0; p < this->size(); ++p)
    {
      typename Lattice<dim>::Index cell;
      for (unsigned int d = 0; d < dim; ++d)
        cell[d] = static_cast<int>(std::floor(lattice.coordinate(x[d][p], d)));
      if (!lattice.is_in_table(cell) || lattice.owner[lattice.table_index(cell)] != my_rank)
        leavers.push_back(p);
    }
    const auto ranks = ranks_of(leavers);

    // A particle is its id and its columns.
    const unsigned int                          n = 1 + this->n_columns();
    std::map<unsigned int, std::vector<double>> messages;
    for (unsigned int i = 0; i < leavers.size(); ++i)
    {
      auto &message = messages[ranks[i]];
      message.push_back(this->id[leavers[i]]);
      for (unsigned int c = 0; c < this->n_columns(); ++c)
        message.push_back(this->column(c)[leavers[i]]);
    }
    std::vector<const double *> arrivals;
    const auto                  received = Utilities::MPI::some_to_some(grid->communicator, messages);
    for (const auto &[rank, message] : received)
      for (unsigned int i = 0; i + n <= message.size(); i += n)
        arrivals.push_back(&message[i]);
    ++arrangement;
    std::sort(arrivals.begin(), arrivals.end(), [](const double *a, const double *b) { return a[0] < b[0]; });

    // Arrivals take the places of leavers; what is left over is at the end.
    const unsigned int n_before = this->size(), n_filled = std::min(leavers.size(), arrivals.size());
    if (arrivals.size() > leavers.size())
      this->resize(n_before + arrivals.size() - leavers.size());
    for (unsigned int i = 0; i < arrivals.size(); ++i)
    {
      const unsigned int p = i < n_filled ? leavers[i] : n_before + i - n_filled;
      this->id[p]          = static_cast<types::particle_index>(arrivals[i][0]);
      this->body[p]        = body_of(this->id[p]);
      for (unsigned int c = 0; c < this->n_columns(); ++c)
        this->column(c)[p] = arrivals[i][1 + c];
    }
    if (this->material_begin.size() > 2)
    {
      // Materials must stay together, so that places are not free to choose.
      std::vector<bool> is_gone(this->size(), false);
      for (unsigned int i = n_filled; i < leavers.size(); ++i)
        is_gone[leavers[i]] = true;
      sort(is_gone);
      return;
    }
    for (unsigned int i = leavers.size(); i-- > n_filled;)
    {
      // From behind, so that what moves into the gap is not itself a leaver.
      move(this->size() - 1, leavers[i]);
      this->resize(this->size() - 1);
    }
    this->material_begin.back() = this->size();
  }

  template <int dim>
  void Particles<dim>::move(const unsigned int from, const unsigned int to)
  {
    this->id[to]   = this->id[from];
    this->body[to] = this->body[from];
    for (unsigned int c = 0; c < this->n_columns(); ++c)
      this->column(c)[to] = this->column(c)[from];
  }

  template <int dim>
  void Particles<dim>::sort()
  {
    sort({});
  }

  template <int dim>
  void Particles<dim>::sort(const std::vector<bool> &is_gone)
  {
    ++arrangement;
    // Counting sort by material and first node; particles are few for each, and mostly in order.
    const auto               &lattice = grid->lattice;
    const unsigned int        n_cells = lattice.cell.size(), n_materials = this->material_begin.size() - 1;
    const auto                x = this->template components<dim>(this->position);
    std::vector<unsigned int> begin(static_cast<std::size_t>(n_materials) * n_cells + 1, 0), key(this->size());
    for (unsigned int p = 0; p < this->size(); ++p)
    {
      if (!is_gone.empty() && is_gone[p])
        continue;
      typename Lattice<dim>::Index first;
      for (unsigned int d = 0; d < dim; ++d)
        first[d] = static_cast<int>(std::floor(lattice.coordinate(x[d][p], d) - stencil_shift));
      Assert(lattice.is_in_table(first), ExcMessage("migrate() comes before sort()."));
      key[p] = body_material[this->body[p]] * n_cells + lattice.table_index(first);
      ++begin[key[p] + 1];
    }
    for (unsigned int k = 0; k + 1 < begin.size(); ++k)
      begin[k + 1] += begin[k];
    std::vector<unsigned int> order(begin.back()), next(begin.begin(), begin.end() - 1);
    for (unsigned int p = 0; p < this->size(); ++p)
      if (is_gone.empty() || !is_gone[p])
        order[next[key[p]]++] = p;
    for (unsigned int k = 0; k + 1 < begin.size(); ++k)
      std::sort(order.begin() + begin[k], order.begin() + begin[k + 1],
                [&](const unsigned int a, const unsigned int b) { return this->id[a] < this->id[b]; });
    for (unsigned int m = 0; m <= n_materials; ++m)
      this->material_begin[m] = begin[m * n_cells];
    this->permute(order);
  }

  template <int dim>
  std::vector<char> Particles<dim>::stencil_beginnings() const
  {
    const auto       &lattice = grid->lattice;
    const auto        x       = this->template components<dim>(this->position);
    std::vector<char> begins(lattice.node.size(), 0);
    for (unsigned int p = 0; p < this->size(); ++p)
    {
      typename Lattice<dim>::Index first;
      for (unsigned int d = 0; d < dim; ++d)
        first[d] = static_cast<int>(std::floor(lattice.coordinate(x[d][p], d) - stencil_shift));
      begins[lattice.table_index(first)] = 1;
    }
    return begins;
  }

  template <int dim>
  void Particles<dim>::load(const unsigned int n)
  {
    unsigned int p = this->size();
    this->resize(p + n);
    for (auto &particle : *home)
    {
      this->id[p]           = particle.get_id();
      this->body[p]         = body_of(this->id[p]);
      const auto properties = particle.get_properties();
      for (unsigned int c = 0; c < this->n_columns(); ++c)
        this->column(c)[p] = properties[c];
      ++p;
    }
    AssertDimension(p, this->size());
    home->clear();
  }

  template class Particles<2>;
  template class Particles<3>;
} // namespace Talus

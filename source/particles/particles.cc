#include <talus/core/batch.h>
#include <talus/core/exceptions.h>
#include <talus/particles/corners.h>
#include <talus/particles/particles.h>

#include <algorithm>
#include <limits>
#include <sstream>

namespace Talus
{
  using namespace dealii;

  template <int dim>
  void Particles<dim>::set_reach(Grid<dim> &grid, const Reach &reach)
  {
    this->grid      = &grid;
    this->reach     = reach;
    coverage        = grid.lattice.coverage(reach.n);
    stencil_shift   = reach.shift;
    n_stencil_nodes = reach.n;
    if (reach.at_corners)
      half_edges = Corners<dim>::add_field(*this);

    knows_all_stencils = Utilities::MPI::n_mpi_processes(grid.communicator) == 1;
    update_open_places();
  }

  template <int dim>
  void Particles<dim>::start_relocation()
  {
    outside           = none;
    needs_synchronise = false;
    needs_activation  = false;
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
      const auto              find = [&] {
        auto is_outside = Number(1.) < Number(0.);
        for (unsigned int d = 0; d < dim; ++d)
        {
          coordinate[d] = (batch.load(x[d]) - lattice.origin[d]) * lattice.inverse_h[d];
          is_outside    = is_outside | !(coordinate[d] >= Number(0.) & coordinate[d] < Number(lattice.n_cells[d]));
        }
        return is_outside;
      };
      auto is_outside = find();
      if (any(is_outside))
      {
        for (unsigned int l = 0; l < batch.size(); ++l)
          if (is_outside[l])
            put_on_face(batch.p + l);
        is_outside = find();
      }
      if (any(is_outside))
      {
        for (unsigned int l = 0; l < batch.size(); ++l)
          if (is_outside[l] && (outside == none || this->id[batch.p + l] < this->id[outside]))
            outside = batch.p + l;
      }
      else if (!knows_all_stencils)
      {
        Number place     = 0.; // in the tables, a whole number below 2^31
        auto   is_beyond = Number(1.) < Number(0.);
        for (unsigned int d = 0; d < dim; ++d)
        {
          const Number index = floor(coordinate[d] - Number(stencil_shift)) - Number(lattice.first[d]);
          is_beyond          = is_beyond | (index < Number(0.)) | (index >= Number(lattice.extent[d]));
          place += index * Number(lattice.stride[d]);
        }
        if (any(is_beyond))
          strays = true;
        else
        {
          alignas(64) int places[Number::n_lanes];
          store_integers(place, places);
          bool is_covered = true;
          for (const int at : places)
            is_covered = is_covered & (coverage[at] != 0);
          strays = strays || !is_covered;
        }
      }
    });
    needs_synchronise = needs_synchronise || strays;
    if (reach.at_corners)
      look_at_corners(begin, end);
  }

  template <int dim>
  void Particles<dim>::put_on_face(const unsigned int p)
  {
    Tensor<1, dim> x = this->vector(this->position, p);
    if (grid->lattice.enter(x))
      for (unsigned int d = 0; d < dim; ++d)
        this->component(this->position, d)[p] = x[d];
  }

  template <int dim>
  unsigned int Particles<dim>::place(const unsigned int p) const
  {
    const auto &lattice  = grid->lattice;
    int         entry    = 0;
    bool        is_known = true;
    for (unsigned int d = 0; d < dim; ++d)
    {
      const double coordinate = lattice.coordinate(this->component(this->position, d)[p], d);
      const double index      = std::floor(coordinate - stencil_shift) - lattice.first[d];
      is_known                = is_known && index >= 0 && index < lattice.extent[d];
      entry += is_known ? static_cast<int>(index) * lattice.stride[d] : 0;
    }
    AssertThrow(is_known && coverage[entry],
                RunError("Particle " + std::to_string(this->id[p]) + " at " + to_text(this->vector(this->position, p)) +
                         " lies beyond the nodes that its rank knows. It must migrate, or the run end, before."));
    return entry;
  }

  template <int dim>
  unsigned int Particles<dim>::body_of(const std::uint64_t id) const
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
      const auto       cell = grid->lattice.cell_index(x);
      ranks[i] = grid->lattice.is_in_table(cell) ? grid->lattice.owner[grid->lattice.table_index(cell)] : none;
      if (ranks[i] == none)
      {
        far.push_back(i);
        far_points.push_back(grid->lattice.inside_cell(x));
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
    brings_new_nodes           = false;
    const unsigned int my_rank = Utilities::MPI::this_mpi_process(grid->communicator);
    if (Utilities::MPI::n_mpi_processes(grid->communicator) == 1)
      return;
    const auto &lattice = grid->lattice;
    const auto  x       = this->template components<dim>(this->position);

    std::vector<unsigned int> leavers;
    for_each_batch(0, this->size(), [&](const auto batch) {
      using Number = typename decltype(batch)::Number;
      alignas(64) int cells[dim][Number::n_lanes];
      for (unsigned int d = 0; d < dim; ++d)
        store_integers(floor((batch.load(x[d]) - lattice.origin[d]) * lattice.inverse_h[d]), cells[d]);
      for (unsigned int l = 0; l < batch.size(); ++l)
      {
        typename Lattice<dim>::Index cell;
        for (unsigned int d = 0; d < dim; ++d)
          cell[d] = cells[d][l];
        if (!lattice.is_in_table(cell) || lattice.owner[lattice.table_index(cell)] != my_rank)
          leavers.push_back(batch.p + l);
      }
    });
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
    for (const auto &[rank, message] : messages)
      grid->communicator.sent(message.size() * sizeof(double));
    std::vector<const double *> arrivals;
    const auto                  received = [&] {
      const Communicator::Wait wait(grid->communicator);
      return Utilities::MPI::some_to_some(grid->communicator, messages);
    }();
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
    for (unsigned int i = 0; i < arrivals.size() && !brings_new_nodes; ++i)
    {
      const unsigned int p = i < n_filled ? leavers[i] : n_before + i - n_filled;
      brings_new_nodes     = !grid->is_active_around(lattice.table_entry(place(p)), n_stencil_nodes);
    }
    if (this->material_begin.size() > 2)
    {
      // Materials must stay together, so that places are not free to choose.
      std::vector<bool> is_gone(this->size(), false);
      for (unsigned int i = n_filled; i < leavers.size(); ++i)
        is_gone[leavers[i]] = true;
      sort(is_gone);
      if (reach.at_corners)
        check_corners_are_known();
      return;
    }
    for (unsigned int i = leavers.size(); i-- > n_filled;)
    {
      // From behind, so that what moves into the gap is not itself a leaver.
      move(this->size() - 1, leavers[i]);
      this->resize(this->size() - 1);
    }
    this->material_begin.back() = this->size();
    if (reach.at_corners)
      check_corners_are_known();
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
    std::vector<unsigned int> begin(static_cast<std::size_t>(n_materials) * n_cells + 1, 0);
    std::vector<std::size_t>  key(this->size());
    for (unsigned int p = 0; p < this->size(); ++p)
    {
      if (!is_gone.empty() && is_gone[p])
        continue;
      key[p] = static_cast<std::size_t>(body_material[this->body[p]]) * n_cells + place(p);
      ++begin[key[p] + 1];
    }
    for (std::size_t k = 0; k + 1 < begin.size(); ++k)
      begin[k + 1] += begin[k];
    std::vector<unsigned int> order(begin.back()), next(begin.begin(), begin.end() - 1);
    for (unsigned int p = 0; p < this->size(); ++p)
      if (is_gone.empty() || !is_gone[p])
        order[next[key[p]]++] = p;
    for (std::size_t k = 0; k + 1 < begin.size(); ++k)
      std::sort(order.begin() + begin[k], order.begin() + begin[k + 1],
                [&](const unsigned int a, const unsigned int b) { return this->id[a] < this->id[b]; });
    for (unsigned int m = 0; m <= n_materials; ++m)
      this->material_begin[m] = begin[static_cast<std::size_t>(m) * n_cells];
    this->permute(order);
  }

  template <int dim>
  std::vector<char> Particles<dim>::stencil_beginnings() const
  {
    std::vector<char> begins(grid->lattice.node.size(), 0);
    for (unsigned int p = 0; p < this->size(); ++p)
      begins[place(p)] = 1;
    if (reach.at_corners)
    {
      const auto &lattice = grid->lattice;
      Corners<dim>(*this, half_edges)
        .for_each(lattice, reach.shift, 0, this->size(),
                  [&](const unsigned int, const auto &index) { begins[lattice.table_index(index)] = 1; });
    }
    return begins;
  }

  template class Particles<2>;
  template class Particles<3>;
} // namespace Talus

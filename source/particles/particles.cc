#include <talus/core/exceptions.h>
#include <talus/particles/particles.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    struct Key
    {
      std::size_t  number; // of material and place
      unsigned int particle;
    };

    /** Sorts keys by their numbers, digit by digit from the lowest: what that takes hangs on the keys alone. */
    void sort_by_number(std::vector<Key> &keys)
    {
      constexpr unsigned int n_bits = 11, n_digits = 1u << n_bits;
      std::size_t            largest = 0;
      for (const Key &key : keys)
        largest = std::max(largest, key.number);
      std::vector<Key> sorted(keys.size());
      for (unsigned int shift = 0; largest >> shift != 0; shift += n_bits)
      {
        const auto digit = [shift](const Key &key) { return key.number >> shift & (n_digits - 1); };
        std::array<unsigned int, n_digits + 1> begin{};
        for (const Key &key : keys)
          ++begin[digit(key) + 1];
        for (unsigned int k = 0; k < n_digits; ++k)
          begin[k + 1] += begin[k];
        for (const Key &key : keys)
          sorted[begin[digit(key)]++] = key;
        keys.swap(sorted);
      }
    }

    /** A particle in a message is its id and its columns, and its place where it keeps that. */
    template <int dim>
    unsigned int message_size(const WorkingSet<dim> &particles)
    {
      return 1 + particles.n_columns() + particles.keeps_places;
    }

    /** What leaves, by the rank to which it goes. */
    template <int dim>
    std::map<unsigned int, std::vector<double>> pack(const WorkingSet<dim>     &particles,
                                                     const std::vector<Leaver> &leavers)
    {
      std::map<unsigned int, std::vector<double>> messages;
      for (const Leaver &leaver : leavers)
      {
        const unsigned int p = leaver.particle;
        AssertThrow(leaver.rank != numbers::invalid_unsigned_int,
                    RunError("Particle " + std::to_string(particles.id[p]) + " at " +
                             to_text(particles.vector(particles.position, p)) +
                             " was lost between ranks: no cell holds it. Lower the Courant number."));
        auto &message = messages[leaver.rank];
        message.push_back(particles.id[p]);
        for (unsigned int c = 0; c < particles.n_columns(); ++c)
          message.push_back(particles.column(c)[p]);
        if (particles.keeps_places)
          message.push_back(leaver.place);
      }
      return messages;
    }
  } // namespace

  template <int dim>
  void Particles<dim>::set_reach(Grid<dim> &grid, const Reach &reach)
  {
    this->grid         = &grid;
    this->reach        = reach;
    this->keeps_places = grid.keeps_places();
    n_stencil_nodes    = reach.n;
    if (reach.at_corners)
    {
      box        = &box_grid(grid, "/Kernel", "Type");
      half_edges = this->add_half_edges();
    }
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
    found = {};
    grid->look(this->template components<dim>(this->position), begin, end, this->place.data(), found);
    for (const unsigned int p : found.outside)
      if (outside == none || this->id[p] < this->id[outside])
        outside = p;
    needs_synchronise = needs_synchronise || found.strays;
    needs_activation  = needs_activation || found.needs_activation;
    if (reach.at_corners)
      look_at_corners(begin, end);
  }

  template <int dim>
  std::vector<unsigned int> Particles<dim>::places() const
  {
    std::vector<unsigned int> result(this->size());
    grid->places(this->template components<dim>(this->position), this->place.data(), 0, this->size(), result.data());
    return result;
  }

  template <int dim>
  void Particles<dim>::check_place(const unsigned int p, const unsigned int place) const
  {
    AssertThrow(place != none,
                RunError("Particle " + std::to_string(this->id[p]) + " at " + to_text(this->vector(this->position, p)) +
                         " lies beyond the nodes that its rank knows. It must migrate, or the run end, before."));
  }

  template <int dim>
  unsigned int Particles<dim>::body_of(const std::uint64_t id) const
  {
    return std::upper_bound(body_begin.begin(), body_begin.end(), id) - body_begin.begin() - 1;
  }

  template <int dim>
  void Particles<dim>::migrate()
  {
    needs_synchronise = false;
    brings_new_nodes  = false;
    if (Utilities::MPI::n_mpi_processes(grid->communicator) == 1)
      return;
    const auto leavers =
      grid->leavers(std::as_const(*this).template components<dim>(this->position), this->place.data(), this->size());

    const unsigned int n        = message_size(*this);
    const auto         messages = pack(*this, leavers);
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
      const unsigned int p = i < n_filled ? leavers[i].particle : n_before + i - n_filled;
      unpack(arrivals[i], p);
      if (brings_new_nodes)
        continue;
      unsigned int place;
      grid->places(std::as_const(*this).template components<dim>(this->position), this->place.data(), p, p + 1, &place);
      check_place(p, place);
      brings_new_nodes = !grid->is_active_around(place);
    }
    if (this->material_begin.size() > 2)
    {
      // Materials must stay together, so that places are not free to choose.
      std::vector<bool> is_gone(this->size(), false);
      for (unsigned int i = n_filled; i < leavers.size(); ++i)
        is_gone[leavers[i].particle] = true;
      sort(is_gone);
      if (reach.at_corners)
        check_corners_are_known();
      return;
    }
    for (unsigned int i = leavers.size(); i-- > n_filled;)
    {
      // From behind, so that what moves into the gap is not itself a leaver.
      move(this->size() - 1, leavers[i].particle);
      this->resize(this->size() - 1);
    }
    this->material_begin.back() = this->size();
    if (reach.at_corners)
      check_corners_are_known();
  }

  template <int dim>
  void Particles<dim>::unpack(const double *message, const unsigned int p)
  {
    this->id[p]   = static_cast<types::particle_index>(message[0]);
    this->body[p] = body_of(this->id[p]);
    for (unsigned int c = 0; c < this->n_columns(); ++c)
      this->column(c)[p] = message[1 + c];
    if (this->keeps_places)
      this->place[p] = static_cast<unsigned int>(message[1 + this->n_columns()]);
  }

  template <int dim>
  void Particles<dim>::move(const unsigned int from, const unsigned int to)
  {
    this->id[to]   = this->id[from];
    this->body[to] = this->body[from];
    for (unsigned int c = 0; c < this->n_columns(); ++c)
      this->column(c)[to] = this->column(c)[from];
    if (this->keeps_places)
      this->place[to] = this->place[from];
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
    const auto        at       = places();
    const std::size_t n_places = grid->n_places(), n_materials = this->material_begin.size() - 1;
    std::vector<Key>  keys;
    keys.reserve(this->size());
    for (unsigned int p = 0; p < this->size(); ++p)
      if (is_gone.empty() || !is_gone[p])
      {
        check_place(p, at[p]);
        keys.push_back({body_material[this->body[p]] * n_places + at[p], p});
      }
    sort_by_number(keys);
    // Particles are few for each place, and mostly in order.
    for (auto begin = keys.begin(), end = begin; begin != keys.end(); begin = end)
    {
      end = std::find_if(begin, keys.end(), [&](const Key &key) { return key.number != begin->number; });
      std::sort(begin, end, [&](const Key &a, const Key &b) { return this->id[a.particle] < this->id[b.particle]; });
    }
    for (std::size_t m = 0; m <= n_materials; ++m)
      this->material_begin[m] =
        std::partition_point(keys.begin(), keys.end(), [&](const Key &key) { return key.number < m * n_places; }) -
        keys.begin();
    std::vector<unsigned int> order;
    order.reserve(keys.size());
    for (const Key &key : keys)
      order.push_back(key.particle);
    this->permute(order);
  }

  template <int dim>
  std::vector<char> Particles<dim>::used_places() const
  {
    std::vector<char> is_used(grid->n_places(), 0);
    const auto        at = places();
    for (unsigned int p = 0; p < this->size(); ++p)
    {
      check_place(p, at[p]);
      is_used[at[p]] = 1;
    }
    mark_places_of_corners(is_used);
    return is_used;
  }

  template class Particles<2>;
  template class Particles<3>;
} // namespace Talus

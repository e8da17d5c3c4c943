#include <talus/core/exceptions.h>
#include <talus/particles/overlaps.h>

#include <algorithm>
#include <limits>
#include <numeric>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    /** Two particles, or a particle and a body, that are in each other's way: the first of all ranks counts. */
    template <int dim>
    struct Pair
    {
      std::uint64_t           id     = std::numeric_limits<std::uint64_t>::max();
      std::uint64_t           number = 0; // of pairs with the same bodies
      unsigned int            body = 0, other = 0;
      std::uint64_t           other_id = 0;
      std::array<double, dim> x        = {};

      bool is_found() const { return id != std::numeric_limits<std::uint64_t>::max(); }

      std::string place() const
      {
        Tensor<1, dim> point;
        for (unsigned int d = 0; d < dim; ++d)
          point[d] = x[d];
        return to_text(point);
      }
    };

    template <int dim>
    Pair<dim> pair_of(const Particles<dim> &particles, const unsigned int p, const unsigned int other)
    {
      Pair<dim> pair;
      pair.id    = particles.id[p];
      pair.body  = particles.body[p];
      pair.other = other;
      for (unsigned int d = 0; d < dim; ++d)
        pair.x[d] = particles.component(particles.position, d)[p];
      return pair;
    }

    /** The pair of lowest id of all ranks. */
    template <int dim>
    Pair<dim> first_of_all(Pair<dim> pair, const Communicator &communicator)
    {
      std::uint64_t n = 0;
      for (const auto &other : Utilities::MPI::all_gather(communicator, pair))
      {
        n += other.number;
        if (other.id < pair.id)
          pair = other;
      }
      pair.number = n;
      return pair;
    }

    /** Points of one body in the region of another. */
    template <int dim>
    Pair<dim> find_in_regions(const Particles<dim> &particles, const std::vector<std::unique_ptr<Body<dim>>> &bodies)
    {
      Pair<dim>     first;
      std::uint64_t n = 0;
      for (unsigned int p = 0; p < particles.size(); ++p)
      {
        const Point<dim> x(particles.vector(particles.position, p));
        for (unsigned int b = 0; b < bodies.size(); ++b)
          if (b != particles.body[p] && bodies[b]->shape->covers(x))
          {
            ++n;
            if (particles.id[p] < first.id)
              first = pair_of(particles, p, b);
          }
      }
      first.number = n;
      return first;
    }

    /** Particles that reach into the region of another body by more than a tenth of their size, though not with their
     * middle. */
    template <int dim>
    Pair<dim> find_across_surfaces(const Particles<dim>                          &particles,
                                   const std::vector<std::unique_ptr<Body<dim>>> &bodies)
    {
      constexpr double share = 0.8; // of the way from the middle to a side: the rest is a tenth of the size
      Pair<dim>        first;
      std::uint64_t    n = 0;
      for (unsigned int p = 0; bodies.size() > 1 && p < particles.size(); ++p)
      {
        const Point<dim> x(particles.vector(particles.position, p));
        const auto      &own   = *bodies[particles.body[p]]->shape;
        const auto       edges = own.half_edges(x, particles.component(particles.volume, 0)[p]);
        for (unsigned int b = 0; b < bodies.size(); ++b)
          for (unsigned int side = 0; b != particles.body[p] && side < 2 * dim; ++side)
            if (const Point<dim> y = x + (side % 2 == 0 ? -share : share) * edges[side / 2];
                bodies[b]->shape->covers(y) && own.covers(y))
            {
              ++n;
              if (particles.id[p] < first.id)
                first = pair_of(particles, p, b);
              break;
            }
      }
      first.number = n;
      return first;
    }

    /**
     * Calls visitor(members) for lists of this rank's particles: two that are less than `margin` grid spacings apart
     * are in a list together. A list holds a box as wide as the grid's spacing, and may hold others.
     */
    template <int dim, class Visitor>
    void for_each_box(const Particles<dim> &particles, const Grid<dim> &grid, const double margin,
                      const Visitor &visitor)
    {
      const std::size_t n_lists   = std::max(particles.size(), 1u);
      const auto        for_lists = [&](const unsigned int p, const auto &enter) {
        std::array<std::int64_t, dim> box;
        unsigned int                  lower_faces = 0; // bits of the axes
        for (unsigned int d = 0; d < dim; ++d)
        {
          const double c = (particles.component(particles.position, d)[p] - grid.lower[d]) * grid.inverse_spacing[d];
          box[d]         = static_cast<std::int64_t>(std::floor(c));
          lower_faces |= (c - box[d] < margin) << d;
        }
        for (unsigned int shift = 0; shift < (1u << dim); ++shift)
          if ((shift & lower_faces) == shift)
          {
            std::uint64_t number = 0; // neighbours along x have neighbouring lists, others hash
            for (unsigned int d = dim; d-- > 0;)
              number = number * 0x9e3779b97f4a7c15ull + static_cast<std::uint64_t>(box[d] - (shift >> d & 1));
            enter(number % n_lists);
          }
      };
      std::vector<unsigned int> end(n_lists + 1, 0);
      for (unsigned int p = 0; p < particles.size(); ++p)
        for_lists(p, [&](const std::size_t list) { ++end[list + 1]; });
      std::partial_sum(end.begin(), end.end(), end.begin());
      std::vector<unsigned int> members(end.back());
      for (unsigned int p = 0; p < particles.size(); ++p)
        for_lists(p, [&](const std::size_t list) { members[end[list]++] = p; });
      for (std::size_t list = 0, begin = 0; list < n_lists; begin = end[list++])
        if (end[list] > begin + 1)
          visitor(members.begin() + begin, members.begin() + end[list]);
    }

    /** Two particles at the same place: nearer than a millionth of a particle's size. */
    template <int dim>
    Pair<dim> find_twins(const Particles<dim> &particles, const Grid<dim> &grid)
    {
      constexpr double near  = 1e-6;
      const auto       x     = particles.template components<dim>(particles.position);
      const double    *V     = particles.component(particles.volume, 0);
      const auto       reach = [&](const unsigned int p) {
        return near * std::min(std::pow(V[p], 1. / dim), grid.smallest_spacing);
      };
      using Ids = std::pair<std::uint64_t, std::uint64_t>;
      std::vector<std::pair<Ids, std::pair<unsigned int, unsigned int>>> twins;
      const double                                                       farthest = near * grid.smallest_spacing;
      for_each_box(particles, grid, near, [&](const auto begin, const auto end) {
        std::sort(begin, end, [&](const unsigned int a, const unsigned int b) { return x[0][a] < x[0][b]; });
        for (auto a = begin; a != end; ++a)
          for (auto b = a + 1; b != end && x[0][*b] - x[0][*a] <= farthest; ++b)
          {
            double square = 0;
            for (unsigned int d = 0; d < dim; ++d)
              square += (x[d][*a] - x[d][*b]) * (x[d][*a] - x[d][*b]);
            if (*a == *b || square > farthest * farthest)
              continue;
            const double distance = std::min(reach(*a), reach(*b));
            if (square > distance * distance)
              continue;
            const bool is_ordered = particles.id[*a] < particles.id[*b];
            const auto low = is_ordered ? *a : *b, high = is_ordered ? *b : *a;
            twins.push_back({{particles.id[low], particles.id[high]}, {low, high}});
          }
      });
      std::sort(twins.begin(), twins.end());
      Pair<dim> first;
      if (!twins.empty())
      {
        const auto &[ids, pair] = twins.front();
        first                   = pair_of(particles, pair.first, particles.body[pair.second]);
        first.other_id          = ids.second;
        first.number            = std::unique(twins.begin(), twins.end()) - twins.begin();
      }
      return first;
    }
  } // namespace

  template <int dim>
  Overlaps<dim>::Overlaps(const std::string &section) : ParameterAcceptor(section)
  {
    add_parameter("Allow overlap", are_allowed,
                  "Whether bodies may overlap and points lie at the same place: their mass then counts twice.");
  }

  template <int dim>
  void Overlaps<dim>::refuse(const Body<dim> &body, const std::string &message)
  {
    throw EntryError(body.get_section_name(), body.shape->position_entry(),
                     message + " Move or cut one of them; 'Allow overlap = true' in section 'Bodies' allows it.");
  }

  template <int dim>
  void Overlaps<dim>::check(const Particles<dim> &particles, const std::vector<std::unique_ptr<Body<dim>>> &bodies,
                            const Grid<dim> &grid) const
  {
    if (are_allowed)
      return;
    const auto blame = [&](const Pair<dim> &found, const std::string &what) {
      const auto pair = first_of_all(found, grid.communicator);
      if (pair.is_found())
        refuse(*bodies[pair.body], "the bodies '" + bodies[pair.body]->name + "' and '" + bodies[pair.other]->name +
                                     "' overlap: " + std::to_string(pair.number) + what + pair.place() + ".");
    };
    blame(find_in_regions(particles, bodies), " points of one lie in the other, the first at ");
    blame(find_across_surfaces(particles, bodies), " particles of one reach into the other, the first at ");
    const auto twins = first_of_all(find_twins(particles, grid), grid.communicator);
    if (twins.is_found())
    {
      const auto name = [&](const unsigned int b, const std::uint64_t id) {
        return std::to_string(id - bodies[b]->first_id + 1) + " of '" + bodies[b]->name + "'";
      };
      refuse(*bodies[twins.body], "the points number " + name(twins.body, twins.id) + " and " +
                                    name(twins.other, twins.other_id) + " lie at the same place, " + twins.place() +
                                    ", and " + std::to_string(twins.number - 1) + " more pairs do.");
    }
    check_lists(particles, bodies, grid);
  }

  template class Overlaps<2>;
  template class Overlaps<3>;
} // namespace Talus

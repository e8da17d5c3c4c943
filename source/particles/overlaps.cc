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
    const std::string allowed = " Move or cut one of them; 'Allow overlap = true' in section 'Bodies' allows it.";

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

    /** A point of one body in the region of another. */
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

    /**
     * Lists of points that fill the same space: the volumes of all lists, spread to the nodes as quadratic splines do,
     * exceed those of the cells. Of equal points that fill a cell it is exactly one.
     */
    template <int dim>
    class Filling
    {
    public:
      Filling(const Particles<dim> &particles, const std::vector<bool> &is_list, const BoxGrid<dim> &grid) : grid(grid)
      {
        nodes.reinit(grid.nodes);
        for (unsigned int p = 0; p < particles.size(); ++p)
          if (is_list[particles.body[p]])
            spread(particles.vector(particles.position, p), particles.component(particles.volume, 0)[p],
                   particles.body[p]);
        nodes.add_copies_to_owners();
      }

      /** The owned node with most that has points of several bodies, and how often it is filled. */
      std::pair<double, Tensor<1, dim>> fullest() const
      {
        std::pair<double, Tensor<1, dim>> result;
        double                            cell = 1;
        for (const double h : grid.spacing)
          cell *= h;
        for (unsigned int i = 0; i < nodes.n_owned(); ++i)
        {
          const double V = nodes[i][0], mean = nodes[i][1] / V, square = nodes[i][2] / V;
          if (square - mean * mean > 0.05 && V / cell > result.first)
            result = {V / cell, grid.node_position(i)};
        }
        return result;
      }

    private:
      void spread(const Tensor<1, dim> &x, const double volume, const unsigned int body)
      {
        grid.for_each_around(x, [&](const unsigned int node, const double weight) {
          const double w = volume * weight;
          nodes[node][0] += w;
          nodes[node][1] += w * body;
          nodes[node][2] += w * body * body;
        });
      }

      const BoxGrid<dim> &grid;
      NodalArray<4>       nodes; // volume, times body, times its square
    };

    /** Names of the lists that have points within a spacing and a half of x. */
    template <int dim>
    std::vector<unsigned int> lists_around(const Particles<dim> &particles, const std::vector<bool> &is_list,
                                           const Tensor<1, dim> &x, const Grid<dim> &grid)
    {
      std::vector<unsigned int> has_points(is_list.size(), 0);
      for (unsigned int p = 0; p < particles.size(); ++p)
        if ((particles.vector(particles.position, p) - x).norm() < 1.5 * grid.largest_spacing)
          has_points[particles.body[p]] = is_list[particles.body[p]];
      Utilities::MPI::max(has_points, grid.communicator, has_points);
      std::vector<unsigned int> bodies;
      for (unsigned int b = 0; b < has_points.size(); ++b)
        if (has_points[b] > 0)
          bodies.push_back(b);
      return bodies;
    }
  } // namespace

  template <int dim>
  Overlaps<dim>::Overlaps(const std::string &section) : ParameterAcceptor(section)
  {
    add_parameter("Allow overlap", are_allowed,
                  "Whether bodies may overlap and points lie at the same place: their mass then counts twice.");
  }

  template <int dim>
  void Overlaps<dim>::check(const Particles<dim> &particles, const std::vector<std::unique_ptr<Body<dim>>> &bodies,
                            const Grid<dim> &grid) const
  {
    if (are_allowed)
      return;
    const auto blame = [&](const unsigned int b, const std::string &message) {
      throw EntryError(bodies[b]->get_section_name(), bodies[b]->shape->position_entry(), message + allowed);
    };
    const auto inside = first_of_all(find_in_regions(particles, bodies), grid.communicator);
    if (inside.is_found())
      blame(inside.body, "the bodies '" + bodies[inside.body]->name + "' and '" + bodies[inside.other]->name +
                           "' overlap: " + std::to_string(inside.number) +
                           " points of one lie in the other, the first at " + inside.place() + ".");
    const auto twins = first_of_all(find_twins(particles, grid), grid.communicator);
    if (twins.is_found())
    {
      const auto name = [&](const unsigned int b, const std::uint64_t id) {
        return std::to_string(id - bodies[b]->first_id + 1) + " of '" + bodies[b]->name + "'";
      };
      blame(twins.body, "the points number " + name(twins.body, twins.id) + " and " +
                          name(twins.other, twins.other_id) + " lie at the same place, " + twins.place() + ", and " +
                          std::to_string(twins.number - 1) + " more pairs do.");
    }

    std::vector<bool> is_list;
    for (const auto &body : bodies)
      is_list.push_back(body->shape->is_list());
    // Sums at nodes of a box tell how full it is.
    const auto box = dynamic_cast<const BoxGrid<dim> *>(&grid);
    if (box == nullptr || std::count(is_list.begin(), is_list.end(), true) < 2)
      return;
    // A row of particles that two lists share fills nodes 1.4-fold, jitter and meshes 1.1-fold.
    constexpr double most    = 1.3;
    auto             fullest = Filling<dim>(particles, is_list, *box).fullest();
    for (const auto &other : Utilities::MPI::all_gather(grid.communicator, fullest))
      if (other.first > fullest.first)
        fullest = other;
    if (fullest.first <= most)
      return;
    const auto around = lists_around(particles, is_list, fullest.second, grid);
    if (around.size() > 1)
      blame(around[1], "the bodies '" + bodies[around[0]]->name + "' and '" + bodies[around[1]]->name +
                         "' overlap: their points fill the space around " + to_text(fullest.second) + " " +
                         std::to_string(fullest.first) + "-fold.");
  }

  template class Overlaps<2>;
  template class Overlaps<3>;
} // namespace Talus

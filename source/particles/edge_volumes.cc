#include <talus/grid/lattice.h>
#include <talus/particles/lattice_shape.h>

namespace Talus
{
  using namespace dealii;

  template <int dim>
  double LatticeShape<dim>::share_of_shape(const Index &k) const
  {
    Point<dim> lower = position(k), upper = lower;
    for (unsigned int d = 0; d < dim; ++d)
      if (is_curved(d))
      {
        lower[d] -= 1.5 * spacing[d];
        upper[d] += 1.5 * spacing[d];
      }
    const auto is_wanted = [&](const Point<dim> &x) { return contains(x); };
    if (region->holds(lower, upper) && (!this->where.is_given() || holds_on_lattice<dim>(lower, upper, 4, is_wanted)))
      return 1;
    std::uint64_t index = 0;
    for (int d = dim - 1; d >= 0; --d)
      index = index * counts[d] + k[d];
    const auto known = shares.find(index);
    return known != shares.end() ? known->second : shares[index] = sample(k);
  }

  template <int dim>
  double LatticeShape<dim>::sample(const Index &k) const
  {
    Index first = k;
    for (unsigned int d = 0; d < dim; ++d)
      --first[d];
    double share = 0;
    for_each_index(first, 3, [&](const Index &box) {
      bool is_near = true;
      for (unsigned int d = 0; d < dim; ++d)
        is_near = is_near && (is_curved(d) || box[d] == k[d]);
      // A point of the shape has what is in its box.
      if (is_near && (box == k || !contains(position(box))))
        share += sample(box, k);
    });
    return share;
  }

  template <int dim>
  double LatticeShape<dim>::sample(const Index &box, const Index &k) const
  {
    // Distances from the box's middle in halves of a sample's width are whole numbers: ties are ties.
    std::vector<Index> takers;
    Index              first = box;
    for (unsigned int d = 0; d < dim; ++d)
      --first[d];
    if (box == k)
      takers.push_back({});
    else
      for_each_index(first, 3, [&](Index other) {
        bool is_near = true;
        for (unsigned int d = 0; d < dim; ++d)
          is_near = is_near && (is_curved(d) || other[d] == box[d]);
        if (!is_near || !contains(position(other)))
          return;
        for (unsigned int d = 0; d < dim; ++d)
          other[d] = 2 * n_samples[d] * (other[d] - box[d]);
        takers.push_back(other);
      });
    Index own;
    for (unsigned int d = 0; d < dim; ++d)
      own[d] = 2 * n_samples[d] * (k[d] - box[d]);

    const Point<dim> middle = position(box);
    unsigned int     n      = 1;
    for (const int along : n_samples)
      n *= along;
    double share = 0;
    for (unsigned int s = 0; s < n; ++s)
    {
      Index      at;
      Point<dim> x = middle;
      for (unsigned int d = 0, rest = s; d < dim; rest /= n_samples[d], ++d)
      {
        at[d] = 2 * static_cast<int>(rest % n_samples[d]) + 1 - n_samples[d];
        x[d] += 0.5 * at[d] * spacing[d] / n_samples[d];
      }
      if (!contains(x))
        continue;
      const auto distance = [&](const Index &taker) {
        double sum = 0; // in box lengths, squared; samples along the axes may differ
        for (unsigned int d = 0; d < dim; ++d)
          sum += std::pow(static_cast<double>(at[d] - taker[d]) / n_samples[d], 2);
        return sum;
      };
      const double mine    = distance(own);
      unsigned int n_best  = 0;
      bool         is_mine = true;
      for (const Index &taker : takers)
      {
        const double theirs = distance(taker);
        is_mine             = is_mine && theirs > mine - 1e-9;
        n_best += std::abs(theirs - mine) < 1e-9;
      }
      if (is_mine)
        share += 1. / n_best;
    }
    return share / n;
  }

#define INSTANTIATE(dim)                                                                                               \
  template double LatticeShape<dim>::share_of_shape(const Index &) const;                                              \
  template double LatticeShape<dim>::sample(const Index &) const;                                                      \
  template double LatticeShape<dim>::sample(const Index &, const Index &) const;
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Talus

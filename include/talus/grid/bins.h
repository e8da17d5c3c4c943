#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace Talus
{
  /** A box with its faces along the axes, grown by what it shall hold. */
  template <int dim>
  struct GrowingBox
  {
    using Vector = std::array<double, dim>;

    void add(const Vector &x)
    {
      for (unsigned int d = 0; d < dim; ++d)
      {
        lower[d] = is_empty ? x[d] : std::min(lower[d], x[d]);
        upper[d] = is_empty ? x[d] : std::max(upper[d], x[d]);
      }
      is_empty = false;
    }

    Vector lower{}, upper{};
    bool   is_empty = true;
  };

  /**
   * Boxes sorted into the cells of a regular lattice, so that those around a point, or near another box, are found
   * without looking at all of them. About as many lattice cells as boxes. Test: tests/mesh/location.cc.
   */
  template <int dim>
  class Bins
  {
  public:
    using Vector = std::array<double, dim>;

    explicit Bins(const std::vector<GrowingBox<dim>> &boxes)
    {
      GrowingBox<dim> all;
      for (const auto &box : boxes)
      {
        all.add(box.lower);
        all.add(box.upper);
      }
      lower         = all.lower;
      double volume = 1, longest = 0;
      for (unsigned int d = 0; d < dim; ++d)
        longest = std::max(longest, all.upper[d] - all.lower[d]);
      for (unsigned int d = 0; d < dim; ++d)
        volume *= std::max(all.upper[d] - all.lower[d], 1e-3 * longest);
      const double spacing = std::pow(volume / std::max<std::size_t>(boxes.size(), 1), 1. / dim);
      inverse_spacing      = spacing > 0 ? 1 / spacing : 1;
      std::size_t n_bins   = 1;
      for (unsigned int d = 0; d < dim; ++d)
        n_bins *= extent[d] = static_cast<int>((all.upper[d] - all.lower[d]) * inverse_spacing) + 1;

      // Count, then fill.
      begin.assign(n_bins + 1, 0);
      for (const auto &box : boxes)
        for_bins(box.lower, box.upper, [&](const std::size_t bin) { ++begin[bin + 1]; });
      for (std::size_t bin = 0; bin < n_bins; ++bin)
        begin[bin + 1] += begin[bin];
      items.resize(begin.back());
      auto next = begin;
      for (unsigned int i = 0; i < boxes.size(); ++i)
        for_bins(boxes[i].lower, boxes[i].upper, [&](const std::size_t bin) { items[next[bin]++] = i; });
    }

    /** Calls `visit(box number)` for all boxes that may meet this one, some several times. */
    template <class Visitor>
    void for_near(const Vector &from, const Vector &to, const Visitor &visit) const
    {
      for_bins(from, to, [&](const std::size_t bin) {
        for (std::size_t i = begin[bin]; i < begin[bin + 1]; ++i)
          visit(items[i]);
      });
    }

  private:
    /** Coordinate of a bin; what lies beyond all belongs to the outermost. */
    int index(const double x, const unsigned int d) const
    {
      const double coordinate = (x - lower[d]) * inverse_spacing;
      return coordinate > 0 ? static_cast<int>(std::min<double>(coordinate, extent[d] - 1)) : 0;
    }

    template <class Visitor>
    void for_bins(const Vector &from, const Vector &to, const Visitor &visit) const
    {
      std::array<int, dim> first, n;
      std::size_t          count = 1;
      for (unsigned int d = 0; d < dim; ++d)
      {
        first[d] = index(from[d], d);
        n[d]     = index(to[d], d) - first[d] + 1;
        count *= n[d];
      }
      for (std::size_t k = 0; k < count; ++k)
      {
        std::size_t bin = 0, rest = k, stride = 1;
        for (unsigned int d = 0; d < dim; ++d)
        {
          bin += (first[d] + rest % n[d]) * stride;
          rest /= n[d];
          stride *= extent[d];
        }
        visit(bin);
      }
    }

    Vector                    lower;
    double                    inverse_spacing;
    std::array<int, dim>      extent;
    std::vector<std::size_t>  begin; // of a bin in `items`
    std::vector<unsigned int> items;
  };
} // namespace Talus

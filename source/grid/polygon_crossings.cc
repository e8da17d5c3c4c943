#include <talus/core/exceptions.h>
#include <talus/grid/closed_surface.h>

#include <algorithm>
#include <numeric>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    /** Twice the area of the triangle a, b, c; negative where it is run through clockwise. */
    double turn(const Point<2> &a, const Point<2> &b, const Point<2> &c)
    {
      return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    }

    /** Whether an edge a, b and an edge c, d have a point in common that ends none of them, or only one. */
    bool cross(const Point<2> &a, const Point<2> &b, const Point<2> &c, const Point<2> &d)
    {
      const double c_side = turn(a, b, c), d_side = turn(a, b, d), a_side = turn(c, d, a), b_side = turn(c, d, b);
      return (c_side > 0) != (d_side > 0) && (a_side > 0) != (b_side > 0);
    }
  } // namespace

  template <>
  void ClosedSurface<2>::check_crossings(const std::string &name) const
  {
    const auto end = [&](const unsigned int f, const unsigned int k) -> const Point & { return vertices[faces[f][k]]; };
    const auto left  = [&](const unsigned int f) { return std::min(end(f, 0)[0], end(f, 1)[0]); };
    const auto right = [&](const unsigned int f) { return std::max(end(f, 0)[0], end(f, 1)[0]); };
    std::vector<unsigned int> order(faces.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](const auto f, const auto g) { return left(f) < left(g); });
    for (unsigned int i = 0; i < order.size(); ++i)
      for (unsigned int j = i + 1; j < order.size() && left(order[j]) <= right(order[i]); ++j)
      {
        const unsigned int f = std::min(order[i], order[j]), g = std::max(order[i], order[j]);
        const bool         are_joined = faces[f][1] == faces[g][0] || faces[f][0] == faces[g][1];
        AssertThrow(are_joined || !cross(end(f, 0), end(f, 1), end(g, 0), end(g, 1)),
                    InputError("the surface in '" + name + "' crosses itself: the edge from " + to_text<2>(end(f, 0)) +
                               " to " + to_text<2>(end(f, 1)) + " and that from " + to_text<2>(end(g, 0)) + " to " +
                               to_text<2>(end(g, 1)) + ". Give the corners in their order along the boundary."));
      }
  }

  template <>
  void ClosedSurface<3>::check_crossings(const std::string &) const
  {
  }
} // namespace Talus

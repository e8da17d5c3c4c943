#pragma once

#include <deal.II/base/point.h>

#include <algorithm>
#include <array>

namespace Talus
{
  /** The point of a segment that is nearest to x. */
  template <int dim>
  dealii::Point<dim> nearest_point(const dealii::Point<dim> &x, const dealii::Point<dim> &a,
                                   const dealii::Point<dim> &b)
  {
    const auto   edge = b - a;
    const double t    = (x - a) * edge / edge.norm_square();
    return a + std::clamp(t, 0., 1.) * edge;
  }

  inline dealii::Point<2> nearest_point(const dealii::Point<2> &x, const std::array<dealii::Point<2>, 2> &corner)
  {
    return nearest_point(x, corner[0], corner[1]);
  }

  /** The point of a triangle that is nearest to x: of its face, of an edge, or a corner. */
  inline dealii::Point<3> nearest_point(const dealii::Point<3> &x, const std::array<dealii::Point<3>, 3> &corner)
  {
    const auto   u = corner[1] - corner[0], v = corner[2] - corner[0], r = x - corner[0];
    const auto   n    = dealii::cross_product_3d(u, v);
    const double area = n.norm_square();
    // Barycentric coordinates of the foot on the plane; a sliver has none, and its edges do.
    const double p = dealii::cross_product_3d(r, v) * n / area, q = dealii::cross_product_3d(u, r) * n / area;
    if (area > 0 && p >= 0 && q >= 0 && p + q <= 1)
      return corner[0] + p * u + q * v;
    dealii::Point<3> best     = corner[0];
    double           distance = (x - best).norm_square();
    for (unsigned int k = 0; k < 3; ++k)
    {
      const auto y = nearest_point(x, corner[k], corner[(k + 1) % 3]);
      if ((x - y).norm_square() < distance)
      {
        best     = y;
        distance = (x - y).norm_square();
      }
    }
    return best;
  }
} // namespace Talus

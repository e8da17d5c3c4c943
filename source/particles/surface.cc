#include <talus/particles/surface.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    /** How many parts of about `spacing` make `length`; at least `least`. */
    unsigned int n_parts(const double length, const double spacing, const double least = 1)
    {
      return static_cast<unsigned int>(std::max(least, std::round(length / spacing)));
    }

    template <int dim>
    double smallest(const SurfaceSpacing<dim> &spacing)
    {
      return *std::min_element(spacing.begin_raw(), spacing.end_raw());
    }

    /** Unit vector at angle `angle` about `axis` in 3D. */
    Tensor<1, 3> around(const unsigned int axis, const double angle)
    {
      Tensor<1, 3> n;
      n[(axis + 1) % 3] = std::cos(angle);
      n[(axis + 2) % 3] = std::sin(angle);
      return n;
    }

    /** The box in which a cylinder of two dimensions consists. */
    template <int dim>
    std::array<Point<dim>, 2> rectangle(const Point<dim> &centre, const double radius, const double height,
                                        const unsigned int axis)
    {
      std::array<Point<dim>, 2> corners = {{centre, centre}};
      corners[1][axis] += height;
      corners[0][1 - axis] -= radius;
      corners[1][1 - axis] += radius;
      return corners;
    }
  } // namespace

  template <int dim>
  Surface<dim> box_face(const Point<dim> &lower, const Point<dim> &upper, const unsigned int face,
                        const SurfaceSpacing<dim> &spacing)
  {
    const unsigned int            normal = face / 2;
    std::array<unsigned int, dim> counts;
    std::array<double, dim>       size;
    SurfacePoint<dim>             point;
    double                        area    = 1;
    unsigned int                  n_total = 1;
    for (unsigned int d = 0; d < dim; ++d)
    {
      counts[d] = d == normal ? 1 : n_parts(upper[d] - lower[d], spacing[d]);
      size[d]   = (upper[d] - lower[d]) / counts[d];
      area *= d == normal ? 1 : size[d];
      n_total *= counts[d];
    }
    point.area[normal] = face % 2 == 0 ? -area : area;
    Surface<dim> surface;
    for (unsigned int k = 0; k < n_total; ++k)
    {
      for (unsigned int d = 0, rest = k; d < dim; rest /= counts[d], ++d)
        point.x[d] = d == normal ? (face % 2 == 0 ? lower : upper)[d] : lower[d] + (rest % counts[d] + 0.5) * size[d];
      surface.push_back(point);
    }
    return surface;
  }

  template <int dim>
  Surface<dim> sphere(const Point<dim> &centre, const double radius, const SurfaceSpacing<dim> &spacing)
  {
    const double s = smallest<dim>(spacing), pi = numbers::PI;
    Surface<dim> surface;
    if constexpr (dim == 2)
    {
      const unsigned int n = n_parts(2 * pi * radius, s, 4);
      for (unsigned int k = 0; k < n; ++k)
      {
        const double angle = 2 * pi * (k + 0.5) / n;
        Tensor<1, 2> normal;
        normal[0] = std::cos(angle);
        normal[1] = std::sin(angle);
        surface.push_back({centre + radius * normal, 2 * pi * radius / n * normal});
      }
    }
    else
    {
      const unsigned int n_bands = n_parts(pi * radius, s, 4);
      for (unsigned int b = 0; b < n_bands; ++b)
      {
        const double       top = pi * b / n_bands, bottom = pi * (b + 1) / n_bands, middle = (top + bottom) / 2;
        const unsigned int n    = n_parts(2 * pi * radius * std::sin(middle), s, 4);
        const double       area = radius * radius * (std::cos(top) - std::cos(bottom)) * 2 * pi / n;
        for (unsigned int k = 0; k < n; ++k)
        {
          Tensor<1, 3> normal = std::sin(middle) * around(2, 2 * pi * (k + 0.5) / n);
          normal[2]           = std::cos(middle);
          surface.push_back({centre + radius * normal, area * normal});
        }
      }
    }
    return surface;
  }

  template <int dim>
  Surface<dim> cylinder_side(const Point<dim> &centre, const double radius, const double height,
                             const unsigned int axis, const SurfaceSpacing<dim> &spacing)
  {
    Surface<dim> surface;
    if constexpr (dim == 2)
    {
      const auto corners = rectangle(centre, radius, height, axis);
      for (const unsigned int face : {2 * (1 - axis), 2 * (1 - axis) + 1})
        for (const auto &point : box_face(corners[0], corners[1], face, spacing))
          surface.push_back(point);
    }
    else
    {
      const double       pi       = numbers::PI;
      const unsigned int n_layers = n_parts(height, spacing[axis]),
                         n        = n_parts(2 * pi * radius, smallest<dim>(spacing), 4);
      for (unsigned int l = 0; l < n_layers; ++l)
        for (unsigned int k = 0; k < n; ++k)
        {
          const Tensor<1, 3> normal = around(axis, 2 * pi * (k + 0.5) / n);
          Point<3>           x      = centre + radius * normal;
          x[axis] += height * (l + 0.5) / n_layers;
          surface.push_back({x, 2 * pi * radius / n * height / n_layers * normal});
        }
    }
    return surface;
  }

  template <int dim>
  Surface<dim> cylinder_end(const Point<dim> &centre, const double radius, const double height, const unsigned int axis,
                            const bool is_top, const SurfaceSpacing<dim> &spacing)
  {
    Surface<dim> surface;
    if constexpr (dim == 2)
    {
      const auto corners = rectangle(centre, radius, height, axis);
      surface            = box_face(corners[0], corners[1], 2 * axis + is_top, spacing);
    }
    else
    {
      const double       s = smallest<dim>(spacing), pi = numbers::PI;
      const unsigned int n_rings = n_parts(radius, s);
      for (unsigned int r = 0; r < n_rings; ++r)
      {
        const double       inner = radius * r / n_rings, outer = radius * (r + 1) / n_rings;
        const unsigned int n = n_parts(pi * (inner + outer), s, 4);
        // The distance of a thin sector's centroid from the axis.
        const double middle = 2. / 3. * (std::pow(outer, 3) - std::pow(inner, 3)) / (outer * outer - inner * inner);
        for (unsigned int k = 0; k < n; ++k)
        {
          SurfacePoint<3> point{centre + middle * around(axis, 2 * pi * (k + 0.5) / n), Tensor<1, 3>()};
          point.x[axis] += is_top ? height : 0;
          point.area[axis] = (is_top ? 1 : -1) * pi * (outer * outer - inner * inner) / n;
          surface.push_back(point);
        }
      }
    }
    return surface;
  }

#define INSTANTIATE(dim)                                                                                               \
  template Surface<dim> box_face(const Point<dim> &, const Point<dim> &, const unsigned int,                           \
                                 const SurfaceSpacing<dim> &);                                                         \
  template Surface<dim> sphere(const Point<dim> &, const double, const SurfaceSpacing<dim> &);                         \
  template Surface<dim> cylinder_side(const Point<dim> &, const double, const double, const unsigned int,              \
                                      const SurfaceSpacing<dim> &);                                                    \
  template Surface<dim> cylinder_end(const Point<dim> &, const double, const double, const unsigned int, const bool,   \
                                     const SurfaceSpacing<dim> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Talus

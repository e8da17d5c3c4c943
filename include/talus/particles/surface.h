#pragma once

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <vector>

namespace Talus
{
  /** The middle of a small part of a surface, and the part's area times its outward normal. */
  template <int dim>
  struct SurfacePoint
  {
    dealii::Point<dim>     x;    // [length]
    dealii::Tensor<1, dim> area; // [length^(dim-1)]
  };

  template <int dim>
  using Surface = std::vector<SurfacePoint<dim>>;

  /** Spacing of surface points wanted along each axis [length]. */
  template <int dim>
  using SurfaceSpacing = dealii::Tensor<1, dim>;

  /** Face 2 d (lower) or 2 d + 1 (upper face of axis d) of a box in equal parts. */
  template <int dim>
  Surface<dim> box_face(const dealii::Point<dim> &lower, const dealii::Point<dim> &upper, const unsigned int face,
                        const SurfaceSpacing<dim> &spacing);

  /** A sphere; a circle in 2D. Bands of equal height in angle, each in equal parts; the whole area is exact. */
  template <int dim>
  Surface<dim> sphere(const dealii::Point<dim> &centre, const double radius, const SurfaceSpacing<dim> &spacing);

  /** The round side of a cylinder whose base has its middle in `centre`; two lines in 2D. */
  template <int dim>
  Surface<dim> cylinder_side(const dealii::Point<dim> &centre, const double radius, const double height,
                             const unsigned int axis, const SurfaceSpacing<dim> &spacing);

  /** The base or, `height` above it, the top of a cylinder: rings in equal parts; a line in 2D. */
  template <int dim>
  Surface<dim> cylinder_end(const dealii::Point<dim> &centre, const double radius, const double height,
                            const unsigned int axis, const bool is_top, const SurfaceSpacing<dim> &spacing);
} // namespace Talus

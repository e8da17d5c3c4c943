#pragma once

#include <talus/core/parameters.h>
#include <talus/grid/grid.h>

#include <deal.II/base/point.h>

#include <cmath>
#include <optional>
#include <vector>

namespace Talus
{
  /** A particle near a surface. */
  template <int dim>
  struct Near
  {
    unsigned int           p;
    double                 distance; // [length]
    dealii::Tensor<1, dim> normal;   // from the nearest point of the surface to the particle
  };

  /** How far a point is from a surface, and where to. */
  template <int dim>
  struct SignedDistance
  {
    double                 value;  // negative inside [length]
    dealii::Tensor<1, dim> normal; // its gradient, a unit vector that points out
  };

  /** A closed surface that material must not run through; it may be on either side. */
  template <int dim>
  class ContactSurface : public dealii::ParameterAcceptor
  {
  public:
    using Point = dealii::Point<dim>;

    using dealii::ParameterAcceptor::ParameterAcceptor;

    /** Looks at the grid, if the surface has to do with it. Before create(). Collective. */
    virtual void attach(const Grid<dim> &) {}

    /** Prepares to find points up to `reach` away [length]. Throws EntryError for an impossible surface. */
    virtual void create(const double reach) = 0;

    /** Appends those of the points begin .. end - 1 that are nearer to the surface than the reach. */
    virtual void find(const std::array<const double *, dim> &x, const unsigned int begin, const unsigned int end,
                      std::vector<Near<dim>> &near) const
    {
      for (unsigned int p = begin; p < end; ++p)
      {
        Point x_p;
        for (unsigned int d = 0; d < dim; ++d)
          x_p[d] = x[d][p];
        if (const auto found = signed_distance(x_p))
          near.push_back({p, std::abs(found->value), (found->value < 0 ? -1. : 1.) * found->normal});
      }
    }

    /** Whether a point lies inside. */
    virtual bool contains(const Point &x) const = 0;

    /** Nothing where the point is farther than the reach. */
    virtual std::optional<SignedDistance<dim>> signed_distance(const Point &x) const = 0;
  };
} // namespace Talus

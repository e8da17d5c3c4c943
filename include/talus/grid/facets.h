#pragma once

#include <talus/grid/bins.h>
#include <talus/grid/closed_surface.h>
#include <talus/grid/contact_surface.h>
#include <talus/grid/nearest.h>

#include <cmath>
#include <optional>

namespace Talus
{
  /** A surface in flat parts; derived classes say which. */
  template <int dim>
  class Facets : public ContactSurface<dim>
  {
  public:
    using Point = dealii::Point<dim>;

    using ContactSurface<dim>::ContactSurface;

    void create(const double reach) override
    {
      this->reach = reach;
      surface.emplace(make());
      std::vector<GrowingBox<dim>> boxes(surface->faces.size());
      for (unsigned int f = 0; f < boxes.size(); ++f)
        for (const unsigned int v : surface->faces[f])
          for (const double side : {-reach, reach})
          {
            std::array<double, dim> corner;
            for (unsigned int d = 0; d < dim; ++d)
              corner[d] = surface->vertices[v][d] + side;
            boxes[f].add(corner);
          }
      bins.emplace(boxes);
    }

    void find(const std::array<const double *, dim> &x, const unsigned int begin, const unsigned int end,
              std::vector<Near<dim>> &near) const override
    {
      for (unsigned int p = begin; p < end; ++p)
      {
        Point x_p;
        for (unsigned int d = 0; d < dim; ++d)
          x_p[d] = x[d][p];
        if (const Nearest nearest = nearest_to(x_p); nearest.square < reach * reach)
          near.push_back({p, std::sqrt(nearest.square), (x_p - nearest.point) / std::sqrt(nearest.square)});
      }
    }

    bool contains(const Point &x) const override { return surface->contains(x); }

    std::optional<SignedDistance<dim>> signed_distance(const Point &x) const override
    {
      const Nearest nearest = nearest_to(x);
      if (!(nearest.square < reach * reach))
        return {};
      const double distance = std::sqrt(nearest.square);
      // On the surface the way to the nearest point has no direction; the part has.
      if (distance < 1e-6 * reach)
      {
        const auto area = surface->area(surface->faces[nearest.face]);
        return SignedDistance<dim>{0., area / area.norm()};
      }
      const double sign = surface->contains(x) ? -1 : 1;
      return SignedDistance<dim>{sign * distance, sign / distance * (x - nearest.point)};
    }

  private:
    struct Nearest
    {
      double       square; // of the distance; that of the reach where nothing is nearer
      Point        point;
      unsigned int face;
    };

    virtual ClosedSurface<dim> make() const = 0;

    Nearest nearest_to(const Point &x) const
    {
      std::array<double, dim> place;
      for (unsigned int d = 0; d < dim; ++d)
        place[d] = x[d];
      Nearest nearest{reach * reach, {}, 0};
      bins->for_near(place, place, [&](const unsigned int f) {
        std::array<Point, dim> corner;
        for (unsigned int k = 0; k < dim; ++k)
          corner[k] = surface->vertices[surface->faces[f][k]];
        const Point  y      = nearest_point(x, corner);
        const double square = (x - y).norm_square();
        if (square < nearest.square)
          nearest = {square, y, f};
      });
      return nearest;
    }

    double                            reach = 0;
    std::optional<ClosedSurface<dim>> surface;
    std::optional<Bins<dim>>          bins;
  };
} // namespace Talus

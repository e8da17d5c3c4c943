#pragma once

#include <talus/grid/bins.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/point.h>

#include <memory>
#include <string>
#include <vector>

namespace Talus
{
  /**
   * The surface of a region, in flat parts: triangles, or the edges of polygons in 2D. It is closed: each edge of a
   * triangle belongs to two of them, which run through it in opposite directions; each corner of a polygon ends one
   * edge and begins one. Parts are turned so that the region lies on the side from which their normals point away.
   * Test: tests/grid/closed_surface.cc.
   */
  template <int dim>
  class ClosedSurface
  {
  public:
    using Point = dealii::Point<dim>;
    using Face  = std::array<unsigned int, dim>; // vertices

    /**
     * Corners of the parts, `dim` for each, in an order that is the same for all as seen from outside, or from inside.
     * Equal points are one vertex; parts without extent are left out. Throws InputError, which calls the surface by
     * `name`, where it is empty or not closed, where its parts are turned against each other, and in 2D where edges
     * cross.
     */
    ClosedSurface(const std::vector<Point> &corners, const std::string &name);

    /** Whether a point lies inside. One on the surface, but for round-off, may be either. */
    bool contains(const Point &x) const;

    /** Whether a part may meet a box: in 2D whether one does. If not, the box is inside as a whole, or outside. */
    bool may_meet(const Point &lower, const Point &upper) const;

    /** Volume inside [length^dim], positive. */
    double volume() const { return inner_volume; }

    dealii::BoundingBox<dim> bounding_box() const;

    /** Half the cross product of a part's edges: area times outward normal [length^(dim - 1)]. */
    dealii::Tensor<1, dim> area(const Face &face) const;

    std::vector<Point> vertices;
    std::vector<Face>  faces;

  private:
    void merge(const std::vector<Point> &corners);
    void check_closed(const std::string &name) const;

    /** Throws where edges of polygons cross. */
    void check_crossings(const std::string &name) const;

    /** For each part a number that tells the connected pieces of the surface apart. */
    std::vector<unsigned int> shells() const;

    /** Turns each shell so that its normals point out of the region. */
    void turn_outwards();

    double inner_volume = 0;

    // Of parts seen along x: in planes across it.
    std::unique_ptr<Bins<dim - 1>> columns;
  };

  template <>
  void ClosedSurface<2>::check_crossings(const std::string &name) const;
  template <>
  void ClosedSurface<3>::check_crossings(const std::string &name) const;

  /**
   * Reads a surface: in 3D an STL file, text or binary; in 2D a text file of polygons, "x y" in each line, the first
   * corner repeated at the end of each; # begins a comment. Coordinates are multiplied by `scale`, then moved by
   * `shift`. Throws InputError with the file and, in text, the line. On every rank alike.
   */
  template <int dim>
  ClosedSurface<dim> read_surface(const std::string &file_name, const double scale,
                                  const dealii::Tensor<1, dim> &shift);
} // namespace Talus

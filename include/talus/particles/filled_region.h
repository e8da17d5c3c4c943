#pragma once

#include <talus/core/registry.h>
#include <talus/particles/surface.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/parameter_acceptor.h>

#include <string>
#include <vector>

namespace Talus
{
  /**
   * A part of space, which a body fills: LatticeShape puts points into it. Each kind is a shape of bodies, and a part
   * of regions that are made of others. It reads the section of what it belongs to.
   */
  template <int dim>
  class FilledRegion : public dealii::ParameterAcceptor
  {
  public:
    using Point = dealii::Point<dim>;

    using dealii::ParameterAcceptor::ParameterAcceptor;

    /** Reads what it needs beside its entries. Throws EntryError for an impossible region. On every rank alike. */
    void prepare();

    /** Throws EntryError for an empty region. After prepare(). */
    virtual dealii::BoundingBox<dim> bounding_box() const = 0;

    /** Whether the region has x, if x lies between the ends of the axes along which it is flat: a lattice is shifted
     * as a whole along them. */
    virtual bool contains(const Point &x) const = 0;

    /** Whether the region has x; of two that share a flat face one has what lies on it. */
    bool has(const Point &x) const;

    /** Whether the surface is curved towards this axis; if not, it ends there with the bounding box. */
    virtual bool is_curved(const unsigned int /* axis */) const { return true; }

    /**
     * Whether the region has all of a box. What is thinner than the box may be overlooked: the points are some on a
     * regular lattice. Convex regions ask for the corners alone.
     */
    virtual bool holds(const Point &lower, const Point &upper) const;

    /** Name of the entry that places the region: the one to blame when it lies outside the grid. */
    virtual std::string position_entry() const = 0;

    /** Names of the faces that make up the surface; none where it is not known. */
    virtual std::vector<std::string> face_names() const { return {}; }

    /** The face called `name` in parts of about this spacing. */
    virtual Surface<dim> face(const std::string & /*name*/, const SurfaceSpacing<dim> & /*spacing*/) const
    {
      return {};
    }

  protected:
    virtual void read() {}

  private:
    Point lower, upper; // of the bounding box
  };

  /** Whether `holds(x)` for all points of a lattice of n along each axis of a box, its corners among them. */
  template <int dim, class Predicate>
  bool holds_on_lattice(const dealii::Point<dim> &lower, const dealii::Point<dim> &upper, const unsigned int n,
                        const Predicate &holds)
  {
    unsigned int n_points = 1;
    for (unsigned int d = 0; d < dim; ++d)
      n_points *= n;
    for (unsigned int i = 0; i < n_points; ++i)
    {
      dealii::Point<dim> x;
      for (unsigned int d = 0, rest = i; d < dim; ++d, rest /= n)
        x[d] = lower[d] + (rest % n) / (n - 1.) * (upper[d] - lower[d]);
      if (!holds(x))
        return false;
    }
    return true;
  }
} // namespace Talus

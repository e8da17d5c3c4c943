#pragma once

#include <talus/particles/filled_region.h>
#include <talus/particles/shape.h>

#include <memory>
#include <string>
#include <unordered_map>

namespace Talus
{
  /**
   * A region filled by a lattice: n points per cell and direction at the middle
   * of equal boxes between the corners of its bounding box, shifted and jittered
   * on request. A point's index is its lexicographic lattice index and its jitter
   * a hash of (seed, index, axis), so that neither depends on the number of ranks.
   *
   * Flat regions are shifted as a whole. Where a surface is curved, a shifted lattice has a row more on the side it
   * comes from, and `Edge volumes` says what the points near the surface stand for: `whole`, their boxes; `sampled`,
   * the part of the region that is nearer to a point than to any other, so that the mass is that of the region to 1 %
   * from a radius of 1.5 spacings on. A formula `Where` cuts a region across all axes. Test: tests/particles/edges.cc,
   * tests/particles/regions.cc.
   */
  template <int dim>
  class LatticeShape : public Shape<dim>
  {
  public:
    /** Of a region that reads the same section. */
    explicit LatticeShape(std::unique_ptr<FilledRegion<dim>> region);

    void create(const std::array<double, dim> &h) override;
    void visit(const dealii::BoundingBox<dim> &box, const typename Shape<dim>::Visitor &visitor) const override;
    void visit_part(const unsigned int part, const unsigned int n_parts,
                    const typename Shape<dim>::Visitor &visitor) const override;

    dealii::BoundingBox<dim> bounding_box() const override { return region->bounding_box(); }
    std::uint64_t            n_indices() const override;
    std::string              density_entry() const override { return "Particles per cell and direction"; }
    std::string              position_entry() const override { return region->position_entry(); }

    /** Those of the lattice's boxes, smaller or larger as the volume is. */
    std::array<dealii::Tensor<1, dim>, dim> half_edges(const dealii::Point<dim> &x, const double volume) const override;

    bool covers(const dealii::Point<dim> &x) const override;

    /** Those of the region; what a formula leaves of it has none that are known. */
    std::vector<std::string> face_names() const override
    {
      return this->where.is_given() ? std::vector<std::string>() : region->face_names();
    }
    Surface<dim> face(const std::string &name, const SurfaceSpacing<dim> &spacing) const override
    {
      return region->face(name, spacing);
    }

  private:
    using Index = std::array<int, dim>;

    dealii::Point<dim> position(const Index &k) const;

    /** Whether the body has x, which lies between the ends of the axes along which it is flat. */
    bool contains(const dealii::Point<dim> &x) const
    {
      return this->where.is_given() ? region->has(x) && this->where.holds(x) : region->contains(x);
    }

    /** Whether its surface is not that of the lattice's boxes along this axis. */
    bool is_curved(const unsigned int axis) const { return this->where.is_given() || region->is_curved(axis); }

    /** What the point at k, which is in the shape, stands for, over its box [1]. */
    double share_of_shape(const Index &k) const;

    /** share_of_shape() near the surface, by samples in the boxes around. */
    double sample(const Index &k) const;

    /** The part of the shape in the box at `box` that is nearest to the point at k, over the box [1]. */
    double sample(const Index &box, const Index &k) const;

    /** Visits the points of the lattice from `begin` up to `end` on each axis. */
    void visit_range(const Index &begin, const Index &end, const typename Shape<dim>::Visitor &visitor) const;

    std::unique_ptr<FilledRegion<dim>> region;

    unsigned int        points_per_cell = 2;
    std::vector<double> offset          = std::vector<double>(dim, 0.);
    double              jitter          = 0;
    unsigned int        seed            = 1;

    std::string edge_volumes = "sampled"; // of flat shapes that is the same as "whole"

    dealii::Point<dim>      lower;
    std::array<double, dim> spacing;
    std::array<int, dim>    counts;

    std::array<int, dim>                              n_samples; // along an axis of a box
    mutable std::unordered_map<std::uint64_t, double> shares;    // of points near the surface, as they are asked for
  };

  /**
   * Registers a kind of region, and the shape of bodies that fills it with a lattice. Its constructor takes the
   * section, or (parameters, section) where it has something to choose.
   */
  template <template <int> class Kind>
  struct RegisterRegion
  {
    RegisterRegion(const std::string &name, const std::string &help) : region(name, help)
    {
      add<2>(name, help);
      add<3>(name, help);
    }

  private:
    template <int dim>
    static void add(const std::string &name, const std::string &help)
    {
      Registry<Shape<dim>>::get().add(name, help, [name](Parameters &parameters, const std::string &section) {
        return std::make_unique<LatticeShape<dim>>(Registry<FilledRegion<dim>>::get().make(name, parameters, section));
      });
    }

    RegisterDimensions<FilledRegion, Kind> region;
  };

  /** A number in [-1, 1) that depends on nothing but its arguments. */
  double hashed_jitter(const unsigned int seed, const std::uint64_t index, const unsigned int axis);
} // namespace Talus

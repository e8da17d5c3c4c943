#pragma once

#include <talus/particles/shape.h>

#include <string>
#include <unordered_map>

namespace Talus
{
  /**
   * A shape filled by a lattice: n points per cell and direction at the middle
   * of equal boxes between the corners of its bounding box, shifted and jittered
   * on request. A point's index is its lexicographic lattice index and its jitter
   * a hash of (seed, index, axis), so that neither depends on the number of ranks.
   *
   * Flat shapes are shifted as a whole. Where a surface is curved, a shifted lattice has a row more on the side it
   * comes from, and `Edge volumes` says what the points near the surface stand for: `whole`, their boxes; `sampled`,
   * the part of the shape that is nearer to a point than to any other, so that the mass is that of the shape to 1 %
   * from a radius of 1.5 spacings on. Shapes are convex. Test: tests/particles/edges.cc.
   */
  template <int dim>
  class LatticeShape : public Shape<dim>
  {
  public:
    explicit LatticeShape(const std::string &section);

    void create(const std::array<double, dim> &h) override;
    void visit(const dealii::BoundingBox<dim> &box, const typename Shape<dim>::Visitor &visitor) const override;
    void visit_part(const unsigned int part, const unsigned int n_parts,
                    const typename Shape<dim>::Visitor &visitor) const override;
    std::uint64_t n_indices() const override;
    std::string   density_entry() const override { return "Particles per cell and direction"; }

    /** Those of the lattice's boxes, smaller or larger as the volume is. */
    std::array<dealii::Tensor<1, dim>, dim> half_edges(const dealii::Point<dim> &x, const double volume) const override;

    /** Whether the shape has x, which lies between the ends of the axes along which it is flat. */
    virtual bool contains(const dealii::Point<dim> &x) const = 0;

    /** Whether the surface is curved towards this axis. */
    virtual bool is_curved(const unsigned int /* axis */) const { return false; }

    bool covers(const dealii::Point<dim> &x) const override;

    void parse_parameters(dealii::ParameterHandler &prm) override;

  protected:
    /** Adds the entry of shapes with a curved surface. */
    void add_edge_volumes();

  private:
    using Index = std::array<int, dim>;

    dealii::Point<dim> position(const Index &k) const;

    /** What the point at k, which is in the shape, stands for, over its box [1]. */
    double share_of_shape(const Index &k) const;

    /** share_of_shape() near the surface, by samples in the boxes around. */
    double sample(const Index &k) const;

    /** The part of the shape in the box at `box` that is nearest to the point at k, over the box [1]. */
    double sample(const Index &box, const Index &k) const;

    /** Visits the points of the lattice from `begin` up to `end` on each axis. */
    void visit_range(const Index &begin, const Index &end, const typename Shape<dim>::Visitor &visitor) const;

    unsigned int        points_per_cell = 2;
    std::vector<double> offset          = std::vector<double>(dim, 0.);
    double              jitter          = 0;
    unsigned int        seed            = 1;

    std::string edge_volumes = "whole"; // of flat shapes there are no others

    dealii::Point<dim>      lower;
    std::array<double, dim> spacing;
    std::array<int, dim>    counts;

    std::array<int, dim>                              n_samples; // along an axis of a box
    mutable std::unordered_map<std::uint64_t, double> shares;    // of points near the surface, as they are asked for
  };

  /** A number in [-1, 1) that depends on nothing but its arguments. */
  double hashed_jitter(const unsigned int seed, const std::uint64_t index, const unsigned int axis);
} // namespace Talus

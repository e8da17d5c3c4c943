#pragma once

#include <talus/particles/shape.h>

namespace Talus
{
  /**
   * A shape filled by a lattice: n points per cell and direction at the middle
   * of equal boxes between the corners of its bounding box, shifted and jittered
   * on request. A point's index is its lexicographic lattice index and its jitter
   * a hash of (seed, index, axis), so that neither depends on the number of ranks.
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

    /** Those of the lattice's boxes. */
    std::array<dealii::Tensor<1, dim>, dim> half_edges(const dealii::Point<dim> &x, const double volume) const override;

    virtual bool contains(const dealii::Point<dim> &x) const = 0;

    void parse_parameters(dealii::ParameterHandler &prm) override;

  private:
    using Index = std::array<int, dim>;

    /** Visits the points of the lattice from `begin` up to `end` on each axis. */
    void visit_range(const Index &begin, const Index &end, const typename Shape<dim>::Visitor &visitor) const;

    unsigned int        points_per_cell = 2;
    std::vector<double> offset          = std::vector<double>(dim, 0.);
    double              jitter          = 0;
    unsigned int        seed            = 1;

    dealii::Point<dim>      lower;
    std::array<double, dim> spacing;
    std::array<int, dim>    counts;
  };

  /** A number in [-1, 1) that depends on nothing but its arguments. */
  double hashed_jitter(const unsigned int seed, const std::uint64_t index, const unsigned int axis);
} // namespace Talus

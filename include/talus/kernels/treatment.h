#pragma once

#include <talus/core/simd.h>
#include <talus/kernels/stencil.h>

#include <deal.II/base/parameter_acceptor.h>

#include <array>

namespace Talus
{
  /** One axis of a lattice stencil before the product over the axes is taken. */
  struct Axis
  {
    static constexpr unsigned int capacity = 4;

    unsigned int begin, end;           // the nodes of the domain among the stencil's: begin <= k < end
    double       weight[capacity];     // [1]
    double       derivative[capacity]; // [1/length]
    double       offset[capacity];     // x_i - x_p [length]
    bool         is_truncated;         // a node beyond the domain has non-zero weight and is missing
    bool         misses_lower;         // a node beyond the domain's lower face has non-zero weight
    bool         misses_upper;         // a node beyond its upper face has
    bool         has_lower_boundary;   // node `begin` lies on the domain's lower face
    bool         has_upper_boundary;   // node `end - 1` lies on its upper face
    double       boundary_scale;       // Steffen's factor of the kernel at the boundary node
  };

  /**
   * The same axes for the particles of a batch, one in each lane. Nodes that do
   * not exist have no weight. With the factors w, u, g, t of an axis (`weight`,
   * `coupling`, `derivative`, `cross`) the kernel at a node is
   * @f[ \phi = \prod_d w_d - \sum_d u_d \prod_{e \ne d} w_e , \qquad
   *     \phi_{,d} = g_d \prod_{e \ne d} w_e - \sum_{e \ne d} u_e t_d \prod_{f \ne d, e} w_f : @f]
   * more than a product, but made of functions of one coordinate.
   */
  template <int dim>
  struct LatticeFactors
  {
    using Number = Simd<native_width>;
    using Mask   = typename Number::Mask;

    unsigned int n; // nodes per axis
    double       boundary_scale;
    Number       weight[dim][Axis::capacity], derivative[dim][Axis::capacity], offset[dim][Axis::capacity];
    Number       coupling[dim][Axis::capacity], cross[dim][Axis::capacity];
    Number       first[dim]; // lattice index of the stencil's first node
    double       last[dim];  // that of the domain's last node
    Mask         is_truncated[dim];
    bool         is_coupled = false; // u is used
    bool         has_cross  = false; // t is used
  };

  /**
   * What happens to a kernel near the edge of the domain, where nodes of its
   * support are missing. It wraps any kernel: it may change the factors of an
   * axis, or the finished stencil. Only particles near the edge get here.
   */
  template <int dim>
  class Treatment : public dealii::ParameterAcceptor
  {
  public:
    using dealii::ParameterAcceptor::ParameterAcceptor;

    /** Axes of which at least one reaches a face of the domain. */
    virtual void correct_axes(std::array<Axis, dim> &) const {}

    /** Stencil of which at least one node is missing. `inverse_h` makes offsets of order one. */
    virtual void correct_stencil(Stencil<dim> &, const std::array<double, dim> & /*inverse_h*/) const {}

    /** Both of the above for a batch: what the batched loops call, while the plain ones call those. */
    virtual void correct_factors(LatticeFactors<dim> &) const {}

    /** True when complete stencils go through correct_stencil() as well. */
    virtual bool is_everywhere() const { return false; }

    /** True when nodes beyond a slip wall are not missing, but the mirror images of others. */
    virtual bool is_mirror() const { return false; }

    /** True when the treatment needs boundary_scale, which not every kernel has. */
    virtual bool needs_boundary_scale() const { return false; }
  };
} // namespace Talus

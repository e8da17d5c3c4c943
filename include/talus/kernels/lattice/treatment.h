#pragma once

#include <talus/core/simd.h>

#include <deal.II/base/parameter_acceptor.h>

namespace Talus
{
  /**
   * The axes of the stencils of a batch on a lattice before the product over them is taken, one particle in each lane.
   * Nodes that do not exist have no weight. With the factors w, u, g, t of an axis (`weight`,
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

    static constexpr unsigned int capacity = 4;

    unsigned int n;              // nodes per axis
    double       boundary_scale; // Steffen's factor of the kernel at the boundary node
    Number       weight[dim][capacity], derivative[dim][capacity], offset[dim][capacity];
    Number       coupling[dim][capacity], cross[dim][capacity];
    Number       first[dim]; // lattice index of the stencil's first node
    double       last[dim];  // that of the domain's last node
    Mask         is_truncated[dim];
    bool         is_coupled = false; // u is used
    bool         has_cross  = false; // t is used
  };

  /**
   * What happens to a kernel of a lattice near the edge of the domain, where nodes of its support are missing. Only
   * particles near the edge get here.
   */
  template <int dim>
  class Treatment : public dealii::ParameterAcceptor
  {
  public:
    using dealii::ParameterAcceptor::ParameterAcceptor;

    /** Changes the axes of a batch in which a stencil reaches a face of the domain. */
    virtual void correct_factors(LatticeFactors<dim> &) const {}

    /** True when complete stencils are corrected as well. */
    virtual bool is_everywhere() const { return false; }

    /** True when nodes beyond a slip wall are not missing, but the mirror images of others. */
    virtual bool is_mirror() const { return false; }

    /** True when no stencil is corrected, because nodes beyond the faces are there: see Walls. */
    virtual bool has_ghosts() const { return false; }

    /** True when the treatment needs boundary_scale, which not every kernel has. */
    virtual bool needs_boundary_scale() const { return false; }
  };
} // namespace Talus

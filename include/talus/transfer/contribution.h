#pragma once

#include <talus/core/transpose.h>
#include <talus/grid/nodal_fields.h>
#include <talus/transfer/scheme.h>

namespace Talus
{
  /**
   * What the particles of a batch add to their nodes, Eqs. (11)-(19). It is computed with one particle in each lane and
   * transposed; then the lanes are the eight numbers of a node (see NodalFields), and a particle adds to a node
   * phi constant + sum_e (phi offset_e or, in the lanes of the force, phi_,e) linear_e.
   */
  template <int dim, class Scheme>
  class Contribution
  {
    using Fields = NodalFields<dim>;
    using Number = Simd<native_width>;

  public:
    using Node = Simd<8>; // all numbers of a node

    Node constant[native_width], linear[dim][native_width];

    /** `affine()` is the affine field C, b the body force per mass. */
    template <class Batch, class Affine>
    [[gnu::always_inline]] void set(const TransferArrays<dim> &arrays, const Batch &batch, const Affine &affine,
                                    const dealii::Tensor<1, dim, Number> &b)
    {
      // Each number is read where it is needed: there are not registers for all of them.
      add_up(
        batch.load(arrays.mass), batch.load(arrays.volume),
        [&](const unsigned int d) { return batch.load(arrays.velocity[d]); }, b, affine,
        // xy, xz, yz follow the three diagonal components.
        [&](const unsigned int d, const unsigned int e) { return batch.load(arrays.stress[d == e ? d : 2 + d + e]); });
    }

    /** The same of mass m, volume V, velocity v; C and the stress times whatever directions `linear` is to go with. */
    [[gnu::always_inline]] void set(const Number &m, const Number &V, const dealii::Tensor<1, dim, Number> &v,
                                    const dealii::Tensor<1, dim, Number> &b, const dealii::Tensor<2, dim, Number> &C,
                                    const dealii::Tensor<2, dim, Number> &stress)
    {
      add_up(
        m, V, [&](const unsigned int d) { return v[d]; }, b, [&]() -> const auto & { return C; },
        [&](const unsigned int d, const unsigned int e) { return stress[d][e]; });
    }

    /** The force lanes of a node take the gradient, those of the momentum the offset. */
    static Node blend(const double moment, const double gradient)
    {
      return Scheme::is_affine ? select(is_force(), Node(gradient), Node(moment)) : Node(gradient);
    }

    /** What of `linear` goes with the offset, and what with the gradient. */
    Node moment(const unsigned int e, const unsigned int l) const
    {
      return Scheme::is_affine ? select(is_force(), Node(0.), linear[e][l]) : Node(0.);
    }

    Node force(const unsigned int e, const unsigned int l) const
    {
      return Scheme::is_affine ? select(is_force(), linear[e][l], Node(0.)) : linear[e][l];
    }

  private:
    template <class Velocity, class Affine, class Stress>
    [[gnu::always_inline]] void add_up(const Number &m, const Number &V, const Velocity &v,
                                       const dealii::Tensor<1, dim, Number> &b, const Affine &affine,
                                       const Stress &stress)
    {
      Number rows[8]     = {0., 0., 0., 0., 0., 0., 0., 0.};
      rows[Fields::mass] = m; // Eq. (13)
      for (unsigned int d = 0; d < dim; ++d)
      {
        rows[Fields::momentum + d] = m * v(d); // Eq. (15)
        rows[Fields::force + d]    = m * b[d]; // Eq. (12)
      }
      lanes_to_vectors<native_width>(rows, constant);
      const dealii::Tensor<2, dim, Number> C = affine();
      for (unsigned int e = 0; e < dim; ++e)
      {
        rows[Fields::mass] = 0.;
        for (unsigned int d = 0; d < dim; ++d)
        {
          rows[Fields::momentum + d] = m * C[d][e];       // Eqs. (17), (19)
          rows[Fields::force + d]    = -V * stress(d, e); // Eq. (11)
        }
        lanes_to_vectors<native_width>(rows, linear[e]);
      }
    }

    static typename Node::Mask is_force()
    {
      double lane[8];
      for (unsigned int i = 0; i < 8; ++i)
        lane[i] = i;
      return Node::load(lane) >= Node(Fields::force);
    }
  };
} // namespace Talus

#pragma once

#include <talus/kernels/lattice/lattice_batch.h>
#include <talus/transfer/contribution.h>

namespace Talus
{
  /**
   * What the particles of a batch add to their nodes, see Contribution: a particle adds one register to each of them.
   */
  template <int dim, class Scheme, class Function>
  class BatchScatter
  {
    static constexpr unsigned int n         = Function::n;
    static constexpr unsigned int width     = native_width;
    static constexpr bool         is_affine = Scheme::is_affine;

    using Fields       = NodalFields<dim>;
    using Moments      = LatticeMoments<dim, n, is_affine>;
    using Number       = Simd<native_width>;
    using VectorNumber = dealii::Tensor<1, dim, Number>;
    using Vectors      = Contribution<dim, Scheme>;
    using Node         = typename Vectors::Node;

  public:
    /** The particles' contributions, b being the body force on each. */
    template <class Batch>
    [[gnu::always_inline]] BatchScatter(const Scheme &scheme, const TransferArrays<dim> &arrays, const Batch &batch,
                                        const LatticeBatch<dim, n> &stencil, const VectorNumber &b,
                                        const Lattice<dim> &lattice)
    {
      const auto affine = [&] {
        dealii::Tensor<2, dim, Number> C;
        if constexpr (is_affine)
        {
          if (!stencil.is_at_face)
            C = scheme.affine(arrays, batch, diagonal_second_moment(stencil, lattice.h), lattice.largest_spacing());
          else
            C = scheme.affine(arrays, batch, second_moment(stencil), lattice.largest_spacing());
          if (stencil.is_at_face && scheme.projects_slip)
            C = without_wall_shear(C, stencil.is_at_slip_wall);
        }
        return C;
      };
      vectors.set(arrays, batch, affine, b);
    }

    /** Adds those of the first `size` particles to the nodes. */
    [[gnu::always_inline]] void add(const Lattice<dim> &lattice, const LatticeBatch<dim, n> &stencil,
                                    const unsigned int size, Fields &fields) const
    {
      if (stencil.is_at_face)
        for (unsigned int l = 0; l < size; ++l)
          scatter_list(vectors, lattice, stencil, l, fields);
      else
      {
        const Moments moments(stencil);
        for (unsigned int l = 0; l < size;)
          l = scatter_run(vectors, moments, lattice, stencil, l, size, fields);
      }
    }

  private:
    /** D, Eq. (18), of a stencil that is a list, if the scheme needs it. */
    static dealii::SymmetricTensor<2, dim, Number> second_moment(const LatticeBatch<dim, n> &stencil)
    {
      dealii::SymmetricTensor<2, dim, Number> D;
      if constexpr (Scheme::needs_D)
        for (unsigned int i = 0; i < stencil.n_nodes; ++i)
        {
          const unsigned int k[3] = {i % n, i / n % n, i / (n * n)};
          for (unsigned int d = 0; d < dim; ++d)
            for (unsigned int e = 0; e <= d; ++e)
              D[d][e] += stencil.value[i] * stencil.offset[d][k[d]] * stencil.offset[e][k[e]];
        }
      return D;
    }

    /**
     * The diagonal of D of a product of factors: they reproduce linear functions, so that all else is zero. The same
     * for all particles if the function says so.
     */
    [[gnu::always_inline]] static auto diagonal_second_moment(const LatticeBatch<dim, n>    &stencil,
                                                              const std::array<double, dim> &h)
    {
      constexpr bool                                                         is_uniform = Function::second_moment > 0;
      dealii::Tensor<1, dim, std::conditional_t<is_uniform, double, Number>> D;
      if constexpr (Scheme::needs_D)
        for (unsigned int d = 0; d < dim; ++d)
        {
          if constexpr (is_uniform)
            D[d] = Function::second_moment * h[d] * h[d];
          else
            for (unsigned int k = 0; k < n; ++k)
              D[d] += stencil.weight[d][k] * stencil.offset[d][k] * stencil.offset[d][k];
        }
      return D;
    }

    [[gnu::always_inline]] static void add_to(double *node, const Node &value)
    {
      (Node::load(node) + value).store(node);
    }

    /** Eqs. (13)-(19) of particle l: calls `add(a, b, c, value)` for what it adds to each of its nodes. */
    template <class Add>
    [[gnu::always_inline]] static void scatter_product(const Vectors &vectors, const Moments &moments,
                                                       const LatticeBatch<dim, n> &stencil, const unsigned int l,
                                                       const Add &add)
    {
      const auto slope = [&](const unsigned int d, const unsigned int k) {
        return Vectors::blend(is_affine ? moments.moment[d][k].data()[l] : 0., stencil.derivative[d][k].data()[l]);
      };
      // All is read before anything is stored, so that nothing is read twice.
      Node weight[dim][n], row[n], across[n]; // sums along x; what comes from y
      for (unsigned int d = 0; d < dim; ++d)
        for (unsigned int k = 0; k < n; ++k)
          weight[d][k] = stencil.weight[d][k].data()[l];
      for (unsigned int k = 0; k < n; ++k)
      {
        row[k]    = weight[0][k] * vectors.constant[l] + slope(0, k) * vectors.linear[0][l];
        across[k] = slope(1, k) * vectors.linear[1][l];
      }
      if constexpr (dim == 2)
        for (unsigned int b = 0; b < n; ++b)
          for (unsigned int a = 0; a < n; ++a)
            add(a, b, 0, weight[1][b] * row[a], weight[0][a] * across[b]);
      else
      {
        Node along[n]; // from z
        for (unsigned int k = 0; k < n; ++k)
          along[k] = slope(dim - 1, k) * vectors.linear[dim - 1][l];
        for (unsigned int b = 0; b < n; ++b)
          for (unsigned int a = 0; a < n; ++a)
          {
            const Node plane = weight[1][b] * row[a] + weight[0][a] * across[b];
            const Node both  = weight[0][a] * weight[1][b];
            for (unsigned int c = 0; c < n; ++c)
              add(a, b, c, weight[dim - 1][c] * plane, both * along[c]);
          }
      }
    }

    /**
     * Particle l, and those after it with the same nodes; returns the next one. Where the nodes fit into the
     * registers, what a run of particles adds is summed there.
     */
    [[gnu::always_inline]] static unsigned int scatter_run(const Vectors &vectors, const Moments &moments,
                                                           const Lattice<dim>         &lattice,
                                                           const LatticeBatch<dim, n> &stencil, unsigned int l,
                                                           const unsigned int size, Fields &fields)
    {
      const int            place    = stencil.first_node[l];
      const std::ptrdiff_t stride_y = std::ptrdiff_t(Fields::stride) * lattice.stride[1];
      double *const        first    = fields.at_place(place);
      if constexpr (dim == 2)
      {
        // From zero, so that no run waits for what the one before it has stored.
        Node sum[n][n];
        for (unsigned int b = 0; b < n; ++b)
          for (unsigned int a = 0; a < n; ++a)
            sum[b][a] = 0.;
        do
        {
          scatter_product(vectors, moments, stencil, l,
                          [&](const unsigned int a, const unsigned int b, unsigned int, const Node &x, const Node &y) {
                            sum[b][a] += x;
                            sum[b][a] += y;
                          });
          ++l;
        } while (l < size && stencil.first_node[l] == place);
        for (unsigned int b = 0; b < n; ++b)
          for (unsigned int a = 0; a < n; ++a)
            add_to(first + b * stride_y + a * Fields::stride, sum[b][a]);
      }
      else
      {
        const std::ptrdiff_t stride_z = std::ptrdiff_t(Fields::stride) * lattice.stride[dim - 1];
        scatter_product(
          vectors, moments, stencil, l,
          [&](const unsigned int a, const unsigned int b, const unsigned int c, const Node &x, const Node &y) {
            add_to(first + b * stride_y + a * Fields::stride + c * stride_z, x + y);
          });
        ++l;
      }
      return l;
    }

    static void scatter_list(const Vectors &add, const Lattice<dim> &lattice, const LatticeBatch<dim, n> &stencil,
                             const unsigned int l, Fields &fields)
    {
      for_each_node(lattice, stencil, l, [&](const unsigned int i, const auto *k, const auto place, const auto beyond) {
        const double phi   = stencil.value[i].data()[l];
        Node         value = phi * add.constant[l];
        for (unsigned int d = 0; d < dim; ++d)
          value += Vectors::blend(phi * stencil.offset[d][k[d]].data()[l], stencil.gradient[d][i].data()[l]) *
                   add.linear[d][l];
        if (beyond != 0)
        {
          fields.count_mirrored(value.data(), beyond);
          value *= Node::load(Fields::mirror(beyond));
        }
        add_to(fields.at_place(place), value);
      });
    }

    Vectors vectors;
  };
} // namespace Talus

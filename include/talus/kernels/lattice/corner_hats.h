#pragma once

#include <talus/particles/lattice/corners.h>

namespace Talus
{
  /**
   * The hat functions of a lattice at the corners x_c of the domains of a batch of particles, one domain in each lane:
   * for each corner the cell it lies in, where in it, and the hats N_i(x_c) of the cell's nodes. Node i of a cell is
   * the upper one along axis d where bit d of i is set.
   */
  template <int dim>
  struct CornerHats
  {
    using Number = Simd<native_width>;
    using Vector = dealii::Tensor<1, dim, Number>;
    using Matrix = dealii::Tensor<2, dim, Number>;

    static constexpr unsigned int n_corners = Corners<dim>::n, n_nodes = 1u << dim;

    Matrix half_edges;          // in the rows [length]
    Matrix dual;                // in the columns: dual[d][e] is the component d of r^e, r^e . r_f = delta_ef [1/length]
    Vector fraction[n_corners]; // of the way from the cell's first node to its last
    Number hat[n_corners][n_nodes];

    alignas(64) int place[n_corners][native_width]; // of the cell's first node
    unsigned int step[n_nodes];                     // from there to its others

    template <class Batch>
    void find(const Lattice<dim> &lattice, const Corners<dim> &corners, const Batch &batch)
    {
      const Vector x = corners.position(batch);
      half_edges     = corners.half_edges(batch);
      dual           = invert(half_edges);
      Vector lowest, highest;
      for (unsigned int c = 0; c < n_corners; ++c)
      {
        fraction[c] = corners.coordinates(lattice, x + corners.arm(half_edges, c));
        for (unsigned int d = 0; d < dim; ++d)
        {
          lowest[d]  = c == 0 ? fraction[c][d] : min(lowest[d], fraction[c][d]);
          highest[d] = c == 0 ? fraction[c][d] : max(highest[d], fraction[c][d]);
        }
      }
      // A corner on the border of the last cell that the domain reaches lies in that cell: there may be none beyond.
      for (unsigned int d = 0; d < dim; ++d)
        highest[d] = max(floor(lowest[d]), -1. - floor(-highest[d]));
      for (unsigned int c = 0; c < n_corners; ++c)
      {
        Number first = 0.;
        for (unsigned int d = 0; d < dim; ++d)
        {
          const Number cell = min(floor(fraction[c][d]), highest[d]);
          fraction[c][d] -= cell;
          first += (cell - 1. * lattice.first[d]) * (1. * lattice.stride[d]);
        }
        store_integers(first, place[c]);
        set_hats(fraction[c], hat[c]);
      }
      for (unsigned int i = 0; i < n_nodes; ++i)
      {
        step[i] = 0;
        for (unsigned int d = 0; d < dim; ++d)
          step[i] += (i >> d & 1) * lattice.stride[d];
      }
    }

    /** +1 or -1: on which side of the centre corner c lies along half edge e. */
    static double sign(const unsigned int c, const unsigned int e) { return c >> e & 1 ? 1. : -1.; }

  private:
    [[gnu::always_inline]] static void set_hats(const Vector &fraction, Number *hat)
    {
      hat[0] = 1.;
      for (unsigned int d = 0; d < dim; ++d)
        for (unsigned int i = 0; i < 1u << d; ++i)
        {
          hat[i + (1u << d)] = hat[i] * fraction[d];
          hat[i] *= 1. - fraction[d];
        }
    }

    /** The inverse, whose columns are dual to the rows of r. */
    static Matrix invert(const Matrix &r)
    {
      Matrix       inverse;
      const Number factor = 1. / determinant(r);
      if constexpr (dim == 2)
      {
        inverse[0][0] = factor * r[1][1];
        inverse[1][1] = factor * r[0][0];
        inverse[0][1] = -factor * r[0][1];
        inverse[1][0] = -factor * r[1][0];
      }
      else
        for (unsigned int i = 0; i < 3; ++i)
          for (unsigned int j = 0; j < 3; ++j)
          {
            const unsigned int a = (j + 1) % 3, b = (j + 2) % 3, c = (i + 1) % 3, d = (i + 2) % 3;
            inverse[i][j] = factor * (r[a][c] * r[b][d] - r[a][d] * r[b][c]);
          }
      return inverse;
    }
  };
} // namespace Talus

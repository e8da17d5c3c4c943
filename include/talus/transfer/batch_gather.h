#pragma once

#include <talus/core/transpose.h>
#include <talus/grid/nodal_fields.h>
#include <talus/kernels/lattice_batch.h>
#include <talus/transfer/scheme.h>

namespace Talus
{
  /**
   * What the particles of a batch gather from their nodes. The lanes are the four
   * numbers of a node from the velocity on; the sums are transposed to one particle in each lane.
   */
  template <int dim, class Scheme, class Function>
  class BatchGather
  {
    static constexpr unsigned int n     = Function::n;
    static constexpr unsigned int width = native_width;

    using Fields  = NodalFields<dim>;
    using Moments = LatticeMoments<dim, n, Scheme::gathers_B>;
    using Number  = Simd<native_width>;
    using Motion  = Simd<4>; // the four from the velocity on

  public:
    /** The sums of the first `size` particles, the last one's in all further lanes. */
    [[gnu::always_inline]] static Gathered<dim, Number> gather(const Lattice<dim>         &lattice,
                                                               const LatticeBatch<dim, n> &stencil,
                                                               const unsigned int size, const Fields &fields)
    {
      const Moments moments(stencil);
      Sums          sums;
      for (unsigned int l = 0; l < size; ++l)
        if (stencil.is_product)
          gather_product(moments, lattice, stencil, l, fields, sums);
        else
          gather_list(lattice, stencil, l, fields, sums);
      for (unsigned int l = size; l < width; ++l)
        sums.repeat(l - 1, l);
      return sums.gathered();
    }

  private:
    /** What each particle of a batch gathers. */
    struct Sums
    {
      static constexpr bool has_own_increment = Scheme::gathers_increment && dim == 3; // in 2D it fits into `value`

      Motion value[width], gradient[dim][width], moment[dim][width], increment[width];

      void repeat(const unsigned int from, const unsigned int to)
      {
        value[to] = value[from];
        for (unsigned int d = 0; d < dim; ++d)
        {
          gradient[d][to] = gradient[d][from];
          if constexpr (Scheme::gathers_B)
            moment[d][to] = moment[d][from];
        }
        if constexpr (has_own_increment)
          increment[to] = increment[from];
      }

      [[gnu::always_inline]] Gathered<dim, Number> gathered() const
      {
        Gathered<dim, Number> sum;
        Number                rows[4];
        vectors_to_lanes<width>(value, rows);
        for (unsigned int d = 0; d < dim; ++d)
        {
          sum.velocity[d] = rows[d];
          if constexpr (Scheme::gathers_increment && dim == 2)
            sum.increment[d] = rows[dim + d];
        }
        for (unsigned int e = 0; e < dim; ++e)
        {
          vectors_to_lanes<width>(gradient[e], rows);
          for (unsigned int d = 0; d < dim; ++d)
            sum.grad_v[d][e] = rows[d];
          if constexpr (Scheme::gathers_B)
          {
            vectors_to_lanes<width>(moment[e], rows);
            for (unsigned int d = 0; d < dim; ++d)
              sum.B[d][e] = rows[d];
          }
        }
        if constexpr (has_own_increment)
        {
          vectors_to_lanes<width>(increment, rows);
          for (unsigned int d = 0; d < dim; ++d)
            sum.increment[d] = rows[d];
        }
        return sum;
      }
    };

    [[gnu::always_inline]] static void gather_product(const Moments &moments, const Lattice<dim> &lattice,
                                                      const LatticeBatch<dim, n> &stencil, const unsigned int l,
                                                      const Fields &fields, Sums &sums)
    {
      const auto weight = [&](const unsigned int d, const unsigned int k) {
        return Motion(stencil.weight[d][k].data()[l]);
      };
      const auto slope = [&](const unsigned int d, const unsigned int k) {
        return Motion(stencil.derivative[d][k].data()[l]);
      };
      const auto lever = [&](const unsigned int d, const unsigned int k) {
        return Motion(moments.moment[d][k].data()[l]);
      };
      constexpr bool       gathers_B = Scheme::gathers_B;
      const std::ptrdiff_t stride_y  = Fields::stride * lattice.stride[1],
                           stride_z  = Fields::stride * lattice.stride[dim - 1];
      const double *const first      = fields.at_place(stencil.first_node[l]);

      Motion value = 0., gradient[3] = {0., 0., 0.}, moment[3] = {0., 0., 0.}, increment = 0.;
      for (unsigned int c = 0; c < (dim == 3 ? n : 1); ++c)
      {
        // Sums over a plane; in 2D there is one.
        Motion plane = 0., plane_gradient[2] = {0., 0.}, plane_moment[2] = {0., 0.}, plane_increment = 0.;
        for (unsigned int b = 0; b < n; ++b)
        {
          Motion              row = 0., row_gradient = 0., row_moment = 0., row_increment = 0.;
          const double *const node = first + b * stride_y + (dim == 3 ? c * stride_z : 0);
          for (unsigned int a = 0; a < n; ++a)
          {
            const double *values = node + a * Fields::stride;
            const Motion  v      = Motion::load(values + Fields::velocity);
            row += weight(0, a) * v;
            row_gradient += slope(0, a) * v;
            if constexpr (gathers_B)
              row_moment += lever(0, a) * v;
            if constexpr (Sums::has_own_increment)
              row_increment += weight(0, a) * Motion::load(values + Fields::increment);
          }
          plane += weight(1, b) * row;
          plane_gradient[0] += weight(1, b) * row_gradient;
          plane_gradient[1] += slope(1, b) * row;
          if constexpr (gathers_B)
          {
            plane_moment[0] += weight(1, b) * row_moment;
            plane_moment[1] += lever(1, b) * row;
          }
          if constexpr (Sums::has_own_increment)
            plane_increment += weight(1, b) * row_increment;
        }
        if constexpr (dim == 2)
        {
          value = plane;
          for (unsigned int d = 0; d < dim; ++d)
          {
            gradient[d] = plane_gradient[d];
            moment[d]   = plane_moment[d];
          }
        }
        else
        {
          value += weight(dim - 1, c) * plane;
          gradient[0] += weight(dim - 1, c) * plane_gradient[0];
          gradient[1] += weight(dim - 1, c) * plane_gradient[1];
          gradient[2] += slope(dim - 1, c) * plane;
          if constexpr (gathers_B)
          {
            moment[0] += weight(dim - 1, c) * plane_moment[0];
            moment[1] += weight(dim - 1, c) * plane_moment[1];
            moment[2] += lever(dim - 1, c) * plane;
          }
          if constexpr (Sums::has_own_increment)
            increment += weight(dim - 1, c) * plane_increment;
        }
      }
      sums.value[l] = value;
      for (unsigned int d = 0; d < dim; ++d)
      {
        sums.gradient[d][l] = gradient[d];
        if constexpr (gathers_B)
          sums.moment[d][l] = moment[d];
      }
      if constexpr (Sums::has_own_increment)
        sums.increment[l] = increment;
    }

    static void gather_list(const Lattice<dim> &lattice, const LatticeBatch<dim, n> &stencil, const unsigned int l,
                            const Fields &fields, Sums &sums)
    {
      Motion value = 0., gradient[3] = {0., 0., 0.}, moment[3] = {0., 0., 0.}, increment = 0.;
      for_each_node(lattice, stencil, l, [&](const unsigned int i, const auto *k, const auto place, const auto beyond) {
        const double *values = fields.at_place(place), *sign = Fields::mirror(beyond);
        Motion        v   = Motion::load(values + Fields::velocity);
        const double  phi = stencil.value[i].data()[l];
        if (beyond != 0)
          v *= Motion::load(sign + Fields::velocity);
        value += phi * v;
        for (unsigned int d = 0; d < dim; ++d)
        {
          gradient[d] += stencil.gradient[d][i].data()[l] * v;
          if constexpr (Scheme::gathers_B)
            moment[d] += (phi * stencil.offset[d][k[d]].data()[l]) * v;
        }
        if constexpr (Sums::has_own_increment)
          increment += phi * Motion::load(sign + Fields::increment) * Motion::load(values + Fields::increment);
      });
      sums.value[l] = value;
      for (unsigned int d = 0; d < dim; ++d)
      {
        sums.gradient[d][l] = gradient[d];
        if constexpr (Scheme::gathers_B)
          sums.moment[d][l] = moment[d];
      }
      if constexpr (Sums::has_own_increment)
        sums.increment[l] = increment;
    }
  };
} // namespace Talus

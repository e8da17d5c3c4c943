#pragma once

#include <talus/core/transpose.h>
#include <talus/grid/nodal_fields.h>
#include <talus/kernels/lattice/lattice_batch.h>
#include <talus/transfer/scheme.h>

namespace Talus
{
  /**
   * What the particles of a batch gather from their nodes, Eqs. (23), (25), (26): see
   * Gathered. Of any kernel, and at faces; for complete stencils of B-splines see
   * PolynomialGather. A node's numbers from the velocity on stand in a register several times,
   * so that one multiply-add sums the velocity, its derivative along x and, where the
   * scheme wants it, its moment along x. What the other axes add is summed apart, by
   * rows and planes where the stencil is a product. In the end the sums are transposed
   * to one particle in each lane.
   */
  template <int dim, class Scheme, class Function>
  class BatchGather
  {
    static constexpr unsigned int n         = Function::n;
    static constexpr unsigned int width     = native_width;
    static constexpr bool         gathers_B = Scheme::gathers_B;

    // The numbers of a node that are read, velocity first; in 2D they include the increment.
    static constexpr unsigned int group             = dim == 2 && !Scheme::gathers_increment ? 2 : 4;
    static constexpr bool         has_own_increment = Scheme::gathers_increment && dim == 3;
    static constexpr bool         has_own_moment    = gathers_B && group == 4; // a register holds but two groups then

    // Axes whose moment is not summed in the register of groups.
    static constexpr bool sums_moment(const unsigned int d) { return gathers_B && (d > 0 || has_own_moment); }

    using Fields  = NodalFields<dim>;
    using Moments = LatticeMoments<dim, n, gathers_B>;
    using Number  = Simd<native_width>;
    using Groups  = Simd<8>; // the velocity, its derivative along x, its moment along x
    using Motion  = Simd<4>; // one group

  public:
    /** The sums of a batch. Lanes that repeat a particle are gathered as well. */
    [[gnu::always_inline]] static Gathered<dim, Number> gather(const Lattice<dim>         &lattice,
                                                               const LatticeBatch<dim, n> &stencil,
                                                               const Fields               &fields)
    {
      Sums sums;
      if (!stencil.is_at_face)
      {
        const Moments moments(stencil);
        for (unsigned int l = 0; l < width; ++l)
          sums.set(l, gather_product(moments, lattice, stencil, l, fields));
      }
      else
        for (unsigned int l = 0; l < width; ++l)
          sums.set(l, gather_list(lattice, stencil, l, fields));
      return sums.gathered();
    }

  private:
    /** The sums of one particle, of a plane or of a row of its stencil. */
    struct Sum
    {
      Groups groups = 0.;
      Motion gradient[dim]; // but along x
      Motion moment[dim];   // where sums_moment()
      Motion increment = 0.;

      Sum()
      {
        for (unsigned int d = 0; d < dim; ++d)
          gradient[d] = moment[d] = 0.;
      }

      /** Adds what is summed along the axes before `axis`. */
      [[gnu::always_inline]] void add(const Sum &other, const unsigned int axis, const double weight,
                                      const double slope, const double lever)
      {
        groups += weight * other.groups;
        for (unsigned int d = 1; d < axis; ++d)
          gradient[d] += weight * other.gradient[d];
        gradient[axis] += slope * other.groups.first_four();
        if constexpr (gathers_B)
        {
          for (unsigned int d = 0; d < axis; ++d)
            if (sums_moment(d))
              moment[d] += weight * other.moment[d];
          moment[axis] += lever * other.groups.first_four();
        }
        if constexpr (has_own_increment)
          increment += weight * other.increment;
      }
    };

    /** What each particle of a batch gathers. */
    struct Sums
    {
      Groups groups[width];
      Motion gradient[dim][width], moment[dim][width], increment[width];

      [[gnu::always_inline]] void set(const unsigned int l, const Sum &sum)
      {
        groups[l] = sum.groups;
        for (unsigned int d = 0; d < dim; ++d)
        {
          if (d > 0)
            gradient[d][l] = sum.gradient[d];
          if (sums_moment(d))
            moment[d][l] = sum.moment[d];
        }
        if constexpr (has_own_increment)
          increment[l] = sum.increment;
      }

      [[gnu::always_inline]] Gathered<dim, Number> gathered() const
      {
        Gathered<dim, Number> sum;
        Number                rows[8];
        vectors_to_lanes<width>(groups, rows);
        for (unsigned int d = 0; d < dim; ++d)
        {
          sum.velocity[d]  = rows[d];
          sum.grad_v[d][0] = rows[group + d];
          if constexpr (Scheme::gathers_increment && dim == 2)
            sum.increment[d] = rows[dim + d];
          if constexpr (gathers_B && !has_own_moment)
            sum.B[d][0] = rows[2 * group + d];
        }
        Number four[4];
        for (unsigned int e = 0; e < dim; ++e)
        {
          if (e > 0)
          {
            vectors_to_lanes<width>(gradient[e], four);
            for (unsigned int d = 0; d < dim; ++d)
              sum.grad_v[d][e] = four[d];
          }
          if (sums_moment(e))
          {
            vectors_to_lanes<width>(moment[e], four);
            for (unsigned int d = 0; d < dim; ++d)
              sum.B[d][e] = four[d];
          }
        }
        if constexpr (has_own_increment)
        {
          vectors_to_lanes<width>(increment, four);
          for (unsigned int d = 0; d < dim; ++d)
            sum.increment[d] = four[d];
        }
        return sum;
      }
    };

    /** The factors of a node for the groups of a register. */
    [[gnu::always_inline]] static Groups spread(const double weight, const double slope, const double lever)
    {
      const double index[8] = {0, 1, 2, 3, 4, 5, 6, 7};
      const Groups lane     = Groups::load(index);
      Groups       result   = slope;
      if constexpr (gathers_B && !has_own_moment)
        result = select(lane < Groups(2. * group), result, Groups(lever));
      return select(lane < Groups(group), Groups(weight), result);
    }

    [[gnu::always_inline]] static Groups load(const double *velocity)
    {
      return Groups::template load_repeated<group>(velocity);
    }

    [[gnu::always_inline]] static Sum gather_product(const Moments &moments, const Lattice<dim> &lattice,
                                                     const LatticeBatch<dim, n> &stencil, const unsigned int l,
                                                     const Fields &fields)
    {
      const auto weight = [&](const unsigned int d, const unsigned int k) { return stencil.weight[d][k].data()[l]; };
      const auto slope = [&](const unsigned int d, const unsigned int k) { return stencil.derivative[d][k].data()[l]; };
      const auto lever = [&](const unsigned int d, const unsigned int k) {
        return gathers_B ? moments.moment[d][k].data()[l] : 0.;
      };
      const std::ptrdiff_t stride_y = std::ptrdiff_t(Fields::stride) * lattice.stride[1],
                           stride_z = std::ptrdiff_t(Fields::stride) * lattice.stride[dim - 1];
      Groups along_x[n];
      for (unsigned int a = 0; a < n; ++a)
        along_x[a] = spread(weight(0, a), slope(0, a), lever(0, a));

      const auto plane_from = [&](const double *const node) __attribute__((always_inline))
      {
        Sum plane;
        for (unsigned int b = 0; b < n; ++b)
        {
          Sum row;
          for (unsigned int a = 0; a < n; ++a)
          {
            const double *values = node + b * stride_y + a * Fields::stride;
            row.groups += along_x[a] * load(values + Fields::velocity);
            if constexpr (has_own_moment)
              row.moment[0] += lever(0, a) * Motion::load(values + Fields::velocity);
            if constexpr (has_own_increment)
              row.increment += weight(0, a) * Motion::load(values + Fields::increment);
          }
          plane.add(row, 1, weight(1, b), slope(1, b), lever(1, b));
        }
        return plane;
      };
      const double *const first = fields.at_place(stencil.first_node[l]);
      if constexpr (dim == 2)
        return plane_from(first);
      else
      {
        Sum sum;
        for (unsigned int c = 0; c < n; ++c)
          sum.add(plane_from(first + c * stride_z), 2, weight(2, c), slope(2, c), lever(2, c));
        return sum;
      }
    }

    // Not inlined: the loop for products needs the registers.
    [[gnu::noinline]] static Sum gather_list(const Lattice<dim> &lattice, const LatticeBatch<dim, n> &stencil,
                                             const unsigned int l, const Fields &fields)
    {
      Sum sum;
      for_each_node(lattice, stencil, l, [&](const unsigned int i, const auto *k, const auto place, const auto beyond) {
        const double *values = fields.at_place(place), *sign = Fields::mirror(beyond);
        const double  phi   = stencil.value[i].data()[l];
        const auto    lever = [&](const unsigned int d) { return phi * stencil.offset[d][k[d]].data()[l]; };
        Groups        v     = load(values + Fields::velocity);
        if (beyond != 0)
          v *= load(sign + Fields::velocity);
        sum.groups += spread(phi, stencil.gradient[0][i].data()[l], gathers_B ? lever(0) : 0.) * v;
        for (unsigned int d = 0; d < dim; ++d)
        {
          if (d > 0)
            sum.gradient[d] += stencil.gradient[d][i].data()[l] * v.first_four();
          if (sums_moment(d))
            sum.moment[d] += lever(d) * v.first_four();
        }
        if constexpr (has_own_increment)
          sum.increment += phi * Motion::load(sign + Fields::increment) * Motion::load(values + Fields::increment);
      });
      return sum;
    }
  };
} // namespace Talus

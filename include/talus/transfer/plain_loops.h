#pragma once

#include <talus/core/function.h>
#include <talus/grid/grid.h>
#include <talus/kernels/kernel.h>
#include <talus/transfer/scheme.h>

#include <algorithm>

namespace Talus
{
  /**
   * Both passes of a scheme one particle at a time, with any kernel: it is asked for
   * stencils, and the loops run over their nodes. The reference of BatchedLoops.
   */
  template <int dim, class Scheme>
  class PlainLoops
  {
  public:
    static void particle_to_grid(const Scheme &scheme, const TransferArrays<dim> &arrays,
                                 const WorkingSet<dim> &particles, const Kernel<dim> &kernel,
                                 const ParsedVector<dim> &acceleration, const double time, Grid<dim> &grid)
    {
      auto b = acceleration.value({}, time);
      for_each_stencil(particles, kernel, 0, particles.size(), [&](const unsigned int p, const Stencil<dim> &stencil) {
        if (acceleration.depends_on_space())
          b = acceleration.value(dealii::Point<dim>(load_vector<dim>(SingleBatch{p}, arrays.position)), time);
        scatter(contribution(scheme, arrays, p, stencil, b, kernel.lattice->largest_spacing()), stencil, grid.fields);
      });
    }

    static double grid_to_particle(const Scheme &scheme, const TransferArrays<dim> &arrays,
                                   const WorkingSet<dim> &particles, const Kernel<dim> &kernel, const Grid<dim> &grid,
                                   const double dt, const unsigned int begin, const unsigned int end)
    {
      double displacement = 0;
      for_each_stencil(particles, kernel, begin, end, [&](const unsigned int p, const Stencil<dim> &stencil) {
        const auto        sum = gather(stencil, grid.fields);
        const SingleBatch one{p};
        for (unsigned int d = 0; d < dim; ++d)
        {
          arrays.position[d][p] += dt * sum.velocity[d]; // Eq. (31), for FLIP as well
          displacement = std::max(displacement, std::abs(dt * sum.velocity[d] * grid.lattice.inverse_h[d]));
        }
        store_matrix<dim>(one, arrays.grad_v, sum.grad_v);
        scheme.update(arrays, one, sum);
      });
      return displacement;
    }

    /** D, Eq. (18). */
    static dealii::SymmetricTensor<2, dim> second_moment(const Stencil<dim> &stencil)
    {
      dealii::SymmetricTensor<2, dim> D;
      for (unsigned int d = 0; d < dim; ++d)
        for (unsigned int e = 0; e <= d; ++e)
          for (unsigned int k = 0; k < stencil.size; ++k)
            D[d][e] += stencil.weight[k] * stencil.offset[d][k] * stencil.offset[e][k];
      return D;
    }

    /** Calls `body(p, stencil)` for the particles begin .. end - 1; evaluates a few at a time, to stay in the cache. */
    template <class Body>
    static void for_each_stencil(const WorkingSet<dim> &particles, const Kernel<dim> &kernel, unsigned int begin,
                                 const unsigned int end, const Body &body)
    {
      constexpr unsigned int batch = 8;
      Stencil<dim>           stencils[batch];
      for (; begin < end; begin += batch)
      {
        const unsigned int stop = std::min(begin + batch, end);
        kernel.evaluate(particles, begin, stop, stencils);
        for (unsigned int p = begin; p < stop; ++p)
          body(p, stencils[p - begin]);
      }
    }

  private:
    using Fields = NodalFields<dim>;
    using Lanes  = Simd<Fields::stride>;

    /** What a particle adds to the lanes of a node: phi (constant + linear . offset) + flux . grad phi. */
    struct Contribution
    {
      double constant[Fields::stride] = {}, linear[dim][Fields::stride] = {}, flux[dim][Fields::stride] = {};
    };

    static Contribution contribution(const Scheme &scheme, const TransferArrays<dim> &arrays, const unsigned int p,
                                     const Stencil<dim> &stencil, const dealii::Tensor<1, dim> &b,
                                     [[maybe_unused]] const double h)
    {
      const double m = arrays.mass[p], V = arrays.volume[p];
      Contribution add;
      add.constant[Fields::mass] = m; // Eq. (13)
      for (unsigned int d = 0; d < dim; ++d)
      {
        add.constant[Fields::momentum + d] = m * arrays.velocity[d][p]; // Eq. (15)
        add.constant[Fields::force + d]    = m * b[d];                  // Eq. (12)
        for (unsigned int e = 0; e < dim; ++e)
        {
          // xy, xz, yz follow the three diagonal components.
          const double stress            = arrays.stress[d == e ? d : 2 + d + e][p];
          add.flux[e][Fields::force + d] = -V * stress; // Eq. (11)
        }
      }
      if constexpr (Scheme::is_affine)
      {
        dealii::SymmetricTensor<2, dim> D;
        if constexpr (Scheme::needs_D)
          D = second_moment(stencil);
        auto C = scheme.affine(arrays, SingleBatch{p}, D, h);
        if (scheme.projects_slip)
          C = without_wall_shear(C, stencil.is_at_slip_wall);
        for (unsigned int d = 0; d < dim; ++d)
          for (unsigned int e = 0; e < dim; ++e)
            add.linear[e][Fields::momentum + d] = m * C[d][e]; // Eqs. (17), (19)
      }
      return add;
    }

    static void scatter(const Contribution &add, const Stencil<dim> &stencil, Fields &fields)
    {
      for (unsigned int k = 0; k < stencil.size; ++k)
      {
        double *node = fields[stencil.node[k]], sum[Fields::stride];
        for (unsigned int lane = 0; lane < Fields::stride; ++lane)
        {
          double value = add.constant[lane], flux = 0;
          for (unsigned int e = 0; e < dim; ++e)
          {
            value += add.linear[e][lane] * stencil.offset[e][k];
            flux += add.flux[e][lane] * stencil.gradient[e][k];
          }
          sum[lane] = stencil.weight[k] * value + flux;
        }
        const unsigned int beyond = stencil.beyond[k];
        fields.count_mirrored(sum, beyond);
        for (unsigned int lane = 0; lane < Fields::stride; ++lane)
          node[lane] += Fields::mirror(beyond)[lane] * sum[lane];
      }
    }

    static Gathered<dim, double> gather(const Stencil<dim> &stencil, const Fields &fields)
    {
      Gathered<dim, double> sum;
      for (unsigned int k = 0; k < stencil.size; ++k)
      {
        const double *node = fields[stencil.node[k]], *sign = Fields::mirror(stencil.beyond[k]);
        for (unsigned int d = 0; d < dim; ++d)
        {
          const double v = sign[Fields::velocity + d] * node[Fields::velocity + d], phi = stencil.weight[k];
          sum.velocity[d] += phi * v;
          sum.increment[d] += phi * sign[Fields::increment + d] * node[Fields::increment + d];
          for (unsigned int e = 0; e < dim; ++e)
          {
            sum.grad_v[d][e] += stencil.gradient[e][k] * v;
            sum.B[d][e] += phi * v * stencil.offset[e][k];
          }
        }
      }
      return sum;
    }
  };
} // namespace Talus

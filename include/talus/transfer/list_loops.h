#pragma once

#include <talus/core/body_force.h>
#include <talus/grid/grid.h>
#include <talus/kernels/kernel.h>
#include <talus/transfer/contribution.h>

#include <algorithm>

namespace Talus
{
  /**
   * Both passes of a scheme with any kernel: it is asked for the stencils of a batch of particles, and the loops run
   * over their nodes, the numbers of a node side by side. The reference of BatchedLoops.
   */
  template <int dim, class Scheme>
  class ListLoops
  {
    using Number = Simd<native_width>;
    using Matrix = dealii::Tensor<2, dim, Number>;
    using Moment = dealii::SymmetricTensor<2, dim, Number>;

  public:
    /** Eqs. (11)-(19). */
    static void particle_to_grid(const Scheme &scheme, const TransferArrays<dim> &arrays,
                                 const WorkingSet<dim> &particles, const Kernel<dim> &kernel,
                                 const BodyForce<dim> &acceleration, const double time, const unsigned int begin,
                                 const unsigned int end, const Grid<dim> &grid, NodalFields<dim> &fields)
    {
      const BodyForceOnBatch<dim> body_force(acceleration, arrays, time);
      const double                h = grid.largest_spacing;
      Contribution<dim, Scheme>   add;
      for_each_list(particles, kernel, begin, end, [&](const auto batch, const Stencil<dim> *stencils) {
        Matrix C;
        if constexpr (Scheme::is_affine)
        {
          C = scheme.affine(arrays, batch, Scheme::needs_D ? second_moments(batch, stencils) : Moment(), h);
          if (scheme.projects_slip)
            for (unsigned int l = 0; l < batch.size(); ++l)
            {
              auto C_p = without_wall_shear(lane(C, l), stencils[l].is_at_slip_wall);
              for (unsigned int c = 0; c < dim * dim; ++c)
                C[c / dim][c % dim].set(l, C_p[c / dim][c % dim]);
            }
        }
        add.set(
          arrays, batch, [&]() -> const auto & { return C; }, body_force(batch));
        for (unsigned int l = 0; l < batch.size(); ++l)
          scatter(add, l, stencils[l], fields);
      });
    }

    /** Eqs. (22)-(26), (31); returns the largest displacement along an axis [spacing]. */
    static double grid_to_particle(const Scheme &scheme, const TransferArrays<dim> &arrays,
                                   const WorkingSet<dim> &particles, const Kernel<dim> &kernel, const Grid<dim> &grid,
                                   const NodalFields<dim> &fields, const double dt, const unsigned int begin,
                                   const unsigned int end)
    {
      Number displacement = 0.;
      Sums   sums;
      for_each_list(particles, kernel, begin, end, [&](const auto batch, const Stencil<dim> *stencils) {
        for (unsigned int l = 0; l < batch.size(); ++l)
          sums.gather(l, stencils[l], fields);
        for (unsigned int l = batch.size(); l < native_width; ++l)
          sums.repeat(batch.size() - 1, l);
        displacement =
          max(displacement, advance(scheme, arrays, batch, sums.gathered(), dt, grid.inverse_spacing.data()));
      });
      return *std::max_element(displacement.data(), displacement.data() + native_width);
    }

    /** Calls `body(batch, stencils)` for the particles begin .. end - 1. */
    template <class Body>
    static void for_each_list(const WorkingSet<dim> &particles, const Kernel<dim> &kernel, const unsigned int begin,
                              const unsigned int end, const Body &body)
    {
      static_assert(native_width <= Kernel<dim>::max_batch, "a batch is one call of the kernel");
      Stencil<dim> stencils[native_width];
      for_each_batch(begin, end, [&](const auto batch) {
        kernel.evaluate(particles, batch.p, batch.p + batch.size(), stencils);
        body(batch, stencils);
      });
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

  private:
    using Fields = NodalFields<dim>;
    using Node   = Simd<8>;

    template <class Batch>
    static Moment second_moments(const Batch &batch, const Stencil<dim> *stencils)
    {
      Moment D;
      for (unsigned int l = 0; l < native_width; ++l)
      {
        const auto D_p = second_moment(stencils[std::min(l, batch.size() - 1)]);
        for (unsigned int c = 0; c < D.n_independent_components; ++c)
          D.access_raw_entry(c).set(l, D_p.access_raw_entry(c));
      }
      return D;
    }

    static dealii::Tensor<2, dim> lane(const Matrix &C, const unsigned int l)
    {
      dealii::Tensor<2, dim> result;
      for (unsigned int c = 0; c < dim * dim; ++c)
        result[c / dim][c % dim] = C[c / dim][c % dim][l];
      return result;
    }

    static void scatter(const Contribution<dim, Scheme> &add, const unsigned int l, const Stencil<dim> &stencil,
                        Fields &fields)
    {
      // Copies, which stay in registers: what a node stores might be anything else.
      const Node          constant = add.constant[l];
      Node                moment[dim], force[dim];
      const unsigned int *place  = stencil.place.data();
      const double       *weight = stencil.weight, *offset[dim], *gradient[dim];
      for (unsigned int d = 0; d < dim; ++d)
      {
        moment[d]   = add.moment(d, l);
        force[d]    = add.force(d, l);
        offset[d]   = stencil.offset[d];
        gradient[d] = stencil.gradient[d];
      }
      const auto value = [&](const unsigned int k) {
        Node at_node = constant;
        if constexpr (Scheme::is_affine)
          for (unsigned int d = 0; d < dim; ++d)
            at_node += offset[d][k] * moment[d];
        at_node *= weight[k];
        for (unsigned int d = 0; d < dim; ++d)
          at_node += gradient[d][k] * force[d];
        return at_node;
      };
      double *const first = fields.at_place(0);
      if (stencil.has_images)
        for (unsigned int k = 0; k < stencil.size; ++k)
        {
          Node at_node = value(k);
          if (stencil.beyond[k] != 0)
          {
            fields.count_mirrored(at_node.data(), stencil.beyond[k]);
            at_node *= Node::load(Fields::mirror(stencil.beyond[k]));
          }
          add_to(fields.at_place(place[k]), at_node);
        }
      else
        for (unsigned int k = 0, size = stencil.size; k < size; ++k)
          add_to(first + std::size_t(Fields::stride) * place[k], value(k));
    }

    [[gnu::always_inline]] static void add_to(double *node, const Node &value)
    {
      (Node::load(node) + value).store(node);
    }

    /** What the particles of a batch gather: sums of a node's numbers times phi, grad phi and phi offset. */
    struct Sums
    {
      Node value[native_width], gradient[dim][native_width], moment[dim][native_width];

      void gather(const unsigned int l, const Stencil<dim> &stencil, const Fields &fields)
      {
        Node phi_v = 0., gradient_v[dim], moment_v[dim];
        for (unsigned int d = 0; d < dim; ++d)
          gradient_v[d] = moment_v[d] = 0.;
        for (unsigned int k = 0; k < stencil.size; ++k)
        {
          Node node = Node::load(fields.at_place(stencil.place[k]));
          if (stencil.has_images && stencil.beyond[k] != 0)
            node *= Node::load(Fields::mirror(stencil.beyond[k]));
          const double phi = stencil.weight[k];
          phi_v += phi * node;
          for (unsigned int d = 0; d < dim; ++d)
          {
            gradient_v[d] += stencil.gradient[d][k] * node;
            if constexpr (Scheme::gathers_B)
              moment_v[d] += (phi * stencil.offset[d][k]) * node;
          }
        }
        value[l] = phi_v;
        for (unsigned int d = 0; d < dim; ++d)
        {
          gradient[d][l] = gradient_v[d];
          moment[d][l]   = moment_v[d];
        }
      }

      void repeat(const unsigned int from, const unsigned int to)
      {
        value[to] = value[from];
        for (unsigned int d = 0; d < dim; ++d)
        {
          gradient[d][to] = gradient[d][from];
          moment[d][to]   = moment[d][from];
        }
      }

      Gathered<dim, Number> gathered() const
      {
        Gathered<dim, Number> sum;
        Number                rows[8];
        vectors_to_lanes<native_width>(value, rows);
        for (unsigned int d = 0; d < dim; ++d)
        {
          sum.velocity[d]  = rows[Fields::velocity + d];
          sum.increment[d] = rows[Fields::increment + d];
        }
        for (unsigned int e = 0; e < dim; ++e)
        {
          vectors_to_lanes<native_width>(gradient[e], rows);
          for (unsigned int d = 0; d < dim; ++d)
            sum.grad_v[d][e] = rows[Fields::velocity + d];
          if constexpr (Scheme::gathers_B)
          {
            vectors_to_lanes<native_width>(moment[e], rows);
            for (unsigned int d = 0; d < dim; ++d)
              sum.B[d][e] = rows[Fields::velocity + d];
          }
        }
        return sum;
      }
    };
  };
} // namespace Talus

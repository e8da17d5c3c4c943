#pragma once

#include <talus/core/body_force.h>
#include <talus/grid/grid.h>
#include <talus/transfer/lattice/batch_gather.h>
#include <talus/transfer/lattice/batch_scatter.h>
#include <talus/transfer/lattice/polynomial_gather.h>

namespace Talus
{
  /**
   * Both passes of a scheme for kernels that are products over the axes, a batch of
   * particles at a time. What depends on the particle alone is computed with one
   * particle in each lane; for its nodes, the lanes are the numbers of a node, and the
   * registers are transposed in between: see BatchScatter and BatchGather. Missing
   * nodes occur at the domain's faces only, where stencils are lists.
   */
  template <int dim, class Scheme, class Function>
  class BatchedLoops
  {
  public:
    static void particle_to_grid(const Scheme &scheme, const Function &function, const TransferArrays<dim> &arrays,
                                 const ProductForm<dim> &kernel, const BodyForce<dim> &acceleration, const double time,
                                 const unsigned int begin, const unsigned int end, NodalFields<dim> &fields)
    {
      const Lattice<dim>         &lattice = kernel.lattice;
      const BodyForceOnBatch<dim> body_force(acceleration, arrays, time);
      const Evaluator             evaluator(function, lattice, kernel.treatment);
      LatticeBatch<dim, n>        stencil;
      for_each_batch(begin, end, [&](const auto batch) {
        const auto x = load_vector<dim>(batch, arrays.position);
        evaluator.locate(x, stencil);
        evaluator.evaluate(stencil);
        const BatchScatter<dim, Scheme, Function> scatter(scheme, arrays, batch, stencil, body_force(batch), lattice);
        scatter.add(lattice, stencil, batch.size(), fields);
      });
    }

    static double grid_to_particle(const Scheme &scheme, const Function &function, const TransferArrays<dim> &arrays,
                                   const ProductForm<dim> &kernel, const NodalFields<dim> &fields, const double dt,
                                   const unsigned int begin, const unsigned int end)
    {
      const Lattice<dim>  &lattice      = kernel.lattice;
      Number               displacement = 0.;
      const Evaluator      evaluator(function, lattice, kernel.treatment);
      LatticeBatch<dim, n> stencil;
      Polynomials          polynomials(lattice, fields);
      for_each_batch(begin, end, [&](const auto batch) {
        prefetch_gather(arrays, batch.p);
        const auto x = load_vector<dim>(batch, arrays.position);
        evaluator.locate(x, stencil);
        const auto sum = [&] {
          if constexpr (Function::is_polynomial)
            if (!stencil.is_at_face && evaluator.leaves_complete_stencils())
              return polynomials.gather(stencil);
          evaluator.evaluate(stencil);
          return BatchGather<dim, Scheme, Function>::gather(lattice, stencil, fields);
        }();
        displacement = max(displacement, advance(scheme, arrays, batch, sum, dt, lattice.inverse_h.data()));
      });
      return *std::max_element(displacement.data(), displacement.data() + width);
    }

  private:
    static constexpr unsigned int n     = Function::n;
    static constexpr unsigned int width = native_width;

    using Fields      = NodalFields<dim>;
    using Number      = Simd<native_width>;
    using Evaluator   = BatchEvaluator<dim, Function>;
    using Polynomials = PolynomialGather<dim, Scheme, Function>;

    static_assert(Fields::stride == 8 && Fields::velocity == 1 && Fields::increment == 1 + dim, "the layout of a node");

    template <class Columns>
    [[gnu::always_inline]] static void prefetch(const Columns &columns, const unsigned int p)
    {
      for (const double *column : columns)
        __builtin_prefetch(column + p, 1);
    }

    /**
     * What the gather reads and writes a few batches later, and what the update of the stress after it will read.
     * Columns are many and taken in blocks, so that the processor does not foresee them. Beyond their ends nothing
     * happens. The scatter gains nothing by it.
     */
    [[gnu::always_inline]] static void prefetch_gather(const TransferArrays<dim> &arrays, const unsigned int p)
    {
      constexpr unsigned int ahead = 64;
      prefetch(arrays.position, p + ahead);
      prefetch(arrays.velocity, p + ahead);
      prefetch(arrays.grad_v, p + ahead);
      if constexpr (Scheme::gathers_B)
        prefetch(arrays.B, p + ahead);
      prefetch(arrays.F, p);
      prefetch(arrays.stress, p);
      prefetch(std::array<double *, 2>{{arrays.mass, arrays.volume}}, p);
    }
  };
} // namespace Talus

#pragma once

#include <talus/transfer/lattice/batched_loops.h>
#include <talus/transfer/lattice/domain_loops.h>
#include <talus/transfer/list_loops.h>

namespace Talus
{
  /**
   * Both passes of a scheme with any kernel: through the loops compiled for its form, or through lists.
   * The nodes' numbers are in `fields`, those of the grid or others of its nodes.
   */
  template <int dim, class Scheme>
  struct Loops
  {
    using Form = CompiledForm<dim>;

    /** Eqs. (11)-(19): what the particles begin .. end - 1 add to the nodes. */
    static void particle_to_grid(const Scheme &scheme, const TransferArrays<dim> &arrays,
                                 const WorkingSet<dim> &particles, const Kernel<dim> &kernel, const Form &form,
                                 const BodyForce<dim> &acceleration, const double time, const unsigned int begin,
                                 const unsigned int end, const Grid<dim> &grid, NodalFields<dim> &fields)
    {
      if (const auto *product = std::get_if<ProductForm<dim>>(&form))
        std::visit(
          [&](const auto &function) {
            Batched<decltype(function)>::particle_to_grid(scheme, function, arrays, *product, acceleration, time, begin,
                                                          end, fields);
          },
          product->function);
      else if (const auto *domain = std::get_if<DomainForm<dim>>(&form))
        DomainLoops<dim, Scheme>::particle_to_grid(scheme, arrays, particles, *domain, acceleration, time, begin, end,
                                                   grid, fields);
      else
        ListLoops<dim, Scheme>::particle_to_grid(scheme, arrays, particles, kernel, acceleration, time, begin, end,
                                                 grid, fields);
    }

    /** Eqs. (22)-(26), (31) of these particles; returns the largest displacement along an axis [spacing]. */
    static double grid_to_particle(const Scheme &scheme, const TransferArrays<dim> &arrays,
                                   const WorkingSet<dim> &particles, const Kernel<dim> &kernel, const Form &form,
                                   const Grid<dim> &grid, const NodalFields<dim> &fields, const double dt,
                                   const unsigned int begin, const unsigned int end)
    {
      if (const auto *product = std::get_if<ProductForm<dim>>(&form))
        return std::visit(
          [&](const auto &function) {
            return Batched<decltype(function)>::grid_to_particle(scheme, function, arrays, *product, fields, dt, begin,
                                                                 end);
          },
          product->function);
      if (const auto *domain = std::get_if<DomainForm<dim>>(&form))
        return DomainLoops<dim, Scheme>::grid_to_particle(scheme, arrays, particles, *domain, fields, dt, begin, end);
      return ListLoops<dim, Scheme>::grid_to_particle(scheme, arrays, particles, kernel, grid, fields, dt, begin, end);
    }

  private:
    template <class Function>
    using Batched = BatchedLoops<dim, Scheme, std::decay_t<Function>>;
  };
} // namespace Talus

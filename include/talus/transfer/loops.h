#pragma once

#include <talus/transfer/batched_loops.h>
#include <talus/transfer/list_loops.h>

namespace Talus
{
  /**
   * Both passes of a scheme with any kernel. Kernels that are products over the axes run through the compiled loops,
   * all others, and those that are asked for as `is_plain`, through lists.
   */
  template <int dim, class Scheme>
  struct Loops
  {
    /** Eqs. (11)-(19). */
    static void particle_to_grid(const Scheme &scheme, const TransferArrays<dim> &arrays,
                                 const WorkingSet<dim> &particles, const Kernel<dim> &kernel, const bool is_plain,
                                 const BodyForce<dim> &acceleration, const double time, Grid<dim> &grid)
    {
      const auto form = kernel.lattice_form();
      if (form && !is_plain)
        std::visit(
          [&](const auto &function) {
            Batched<decltype(function)>::particle_to_grid(scheme, function, arrays, particles.size(), *form,
                                                          acceleration, time, grid);
          },
          form->function);
      else
        ListLoops<dim, Scheme>::particle_to_grid(scheme, arrays, particles, kernel, acceleration, time, grid);
    }

    /** Eqs. (22)-(26), (31) of particles begin .. end - 1; returns the largest displacement along an axis [spacing]. */
    static double grid_to_particle(const Scheme &scheme, const TransferArrays<dim> &arrays,
                                   const WorkingSet<dim> &particles, const Kernel<dim> &kernel, const bool is_plain,
                                   const Grid<dim> &grid, const double dt, const unsigned int begin,
                                   const unsigned int end)
    {
      const auto form = kernel.lattice_form();
      if (form && !is_plain)
        return std::visit(
          [&](const auto &function) {
            return Batched<decltype(function)>::grid_to_particle(scheme, function, arrays, *form, grid, dt, begin, end);
          },
          form->function);
      return ListLoops<dim, Scheme>::grid_to_particle(scheme, arrays, particles, kernel, grid, dt, begin, end);
    }

  private:
    template <class Function>
    using Batched = BatchedLoops<dim, Scheme, std::decay_t<Function>>;
  };
} // namespace Talus

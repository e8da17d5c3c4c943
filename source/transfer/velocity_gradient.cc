#include <talus/transfer/loops.h>
#include <talus/transfer/velocity_gradient.h>

namespace Talus
{
  namespace
  {
    /** Leaves all but the gradient, which every scheme stores. */
    template <int dim>
    struct GradientOnly : Scheme<dim>
    {
      template <class Batch>
      void update(const TransferArrays<dim> &, const Batch &, const Gathered<dim, typename Batch::Number> &) const
      {
      }
    };
  } // namespace

  template <int dim>
  void gather_velocity_gradient(const Grid<dim> &grid, const Kernel<dim> &kernel, const bool is_plain,
                                WorkingSet<dim> &particles)
  {
    // Without a step size the particles stay where they are.
    Loops<dim, GradientOnly<dim>>::grid_to_particle({}, TransferArrays<dim>(particles), particles, kernel,
                                                    is_plain ? CompiledForm<dim>() : kernel.compiled_form(), grid,
                                                    grid.fields,
                                                    /* dt = */ 0., 0, particles.size());
  }

#define INSTANTIATE(dim)                                                                                               \
  template void gather_velocity_gradient(const Grid<dim> &, const Kernel<dim> &, const bool, WorkingSet<dim> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Talus

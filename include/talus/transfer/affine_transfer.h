#pragma once

#include <talus/transfer/batched_loops.h>
#include <talus/transfer/plain_loops.h>
#include <talus/transfer/transfer.h>

namespace Talus
{
  /**
   * The transfer of a scheme that scatters once and gathers once; see Scheme for
   * how they differ. Kernels that are products over the axes run in batches, all
   * others, and `is_plain`, one particle at a time.
   */
  template <int dim, template <int> class Scheme>
  class AffineTransfer : public Transfer<dim>
  {
  public:
    explicit AffineTransfer(const std::string &section) : Transfer<dim>(section)
    {
      scheme.add_parameters(*this);
      if (Scheme<dim>::is_affine)
        this->add_parameter("Slip projection", scheme.projects_slip,
                            "Particles whose kernel a slip wall truncates scatter no d v_t / d n: quiet floors.");
    }

    void add_fields(WorkingSet<dim> &particles) override { scheme.add_fields(particles); }

    void initialize(const Kernel<dim> &kernel, WorkingSet<dim> &particles) const override
    {
      if (!Scheme<dim>::needs_D)
        return;
      const auto here = arrays(particles);
      Plain::for_each_stencil(particles, kernel, 0, particles.size(),
                              [&](const unsigned int p, const Stencil<dim> &stencil) {
                                scheme.initialize(here, SingleBatch{p}, Plain::second_moment(stencil));
                              });
    }

    void particle_to_grid(const WorkingSet<dim> &particles, const Kernel<dim> &kernel,
                          const ParsedVector<dim> &acceleration, const double time, Grid<dim> &grid) const override
    {
      const auto here = arrays(const_cast<WorkingSet<dim> &>(particles)); // read only
      const auto kind = kernel.lattice_function();
      if (kind && !this->is_plain)
        std::visit(
          [&](const auto &function) {
            Batched<decltype(function)>::particle_to_grid(scheme, function, here, particles.size(), kernel,
                                                          acceleration, time, grid);
          },
          *kind);
      else
        Plain::particle_to_grid(scheme, here, particles, kernel, acceleration, time, grid);
    }

    using Transfer<dim>::grid_to_particle;
    double grid_to_particle(const Grid<dim> &grid, const Kernel<dim> &kernel, const double dt,
                            WorkingSet<dim> &particles, const unsigned int begin, const unsigned int end) const override
    {
      const auto here = arrays(particles);
      const auto kind = kernel.lattice_function();
      if (kind && !this->is_plain)
        return std::visit(
          [&](const auto &function) {
            return Batched<decltype(function)>::grid_to_particle(scheme, function, here, kernel, grid, dt, begin, end);
          },
          *kind);
      return Plain::grid_to_particle(scheme, here, particles, kernel, grid, dt, begin, end);
    }

    dealii::Tensor<2, dim> affine_moment(const WorkingSet<dim> &particles, const unsigned int p) const override
    {
      return scheme.affine_moment(particles, p);
    }

  private:
    using Plain = PlainLoops<dim, Scheme<dim>>;
    template <class Function>
    using Batched = BatchedLoops<dim, Scheme<dim>, std::decay_t<Function>>;

    TransferArrays<dim> arrays(WorkingSet<dim> &particles) const
    {
      TransferArrays<dim> result(particles);
      scheme.bind(particles, result);
      return result;
    }

    Scheme<dim> scheme;
  };
} // namespace Talus

#pragma once

#include <talus/transfer/loops.h>
#include <talus/transfer/transfer.h>

namespace Talus
{
  /**
   * The transfer of a scheme that scatters once and gathers once; see Scheme for
   * how they differ. Kernels that have a form for which loops are compiled run through those,
   * all others, and `is_plain`, through lists.
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
      Lists::for_each_list(particles, kernel, 0, particles.size(), [&](const auto batch, const Stencil<dim> *stencils) {
        for (unsigned int l = 0; l < batch.size(); ++l)
          scheme.initialize(here, SingleBatch{batch.p + l}, Lists::second_moment(stencils[l]));
      });
    }

    std::array<double, 2> stiffness_factors() const override { return Scheme<dim>::stiffness_factors; }

    void particle_to_grid(const WorkingSet<dim> &particles, const Kernel<dim> &kernel,
                          const BodyForce<dim> &acceleration, const double time, Grid<dim> &grid) override
    {
      const auto here = arrays(const_cast<WorkingSet<dim> &>(particles)); // read only
      Loops<dim, Scheme<dim>>::particle_to_grid(scheme, here, particles, kernel, form(kernel), acceleration, time, 0,
                                                particles.size(), grid, grid.fields);
    }

    using Transfer<dim>::grid_to_particle;
    double grid_to_particle(const Grid<dim> &grid, const Kernel<dim> &kernel, const double dt,
                            WorkingSet<dim> &particles, const unsigned int begin, const unsigned int end) const override
    {
      return Loops<dim, Scheme<dim>>::grid_to_particle(scheme, arrays(particles), particles, kernel, form(kernel), grid,
                                                       grid.fields, dt, begin, end);
    }

    dealii::Tensor<2, dim> affine_moment(const WorkingSet<dim> &particles, const unsigned int p) const override
    {
      return scheme.affine_moment(particles, p);
    }

  private:
    using Lists = ListLoops<dim, Scheme<dim>>;

    /** None for those that are to run through lists. */
    CompiledForm<dim> form(const Kernel<dim> &kernel) const
    {
      return this->is_plain ? CompiledForm<dim>() : kernel.compiled_form();
    }

    TransferArrays<dim> arrays(WorkingSet<dim> &particles) const
    {
      TransferArrays<dim> result(particles);
      scheme.bind(particles, result);
      return result;
    }

    Scheme<dim> scheme;
  };
} // namespace Talus

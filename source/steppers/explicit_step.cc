#include <talus/particles/batch_access.h>
#include <talus/steppers/explicit_step.h>

namespace Talus
{
  using namespace dealii;

  StepTiming::StepTiming(Timing &timing) :
    timing(timing), particle_to_grid(timing.add("particle to grid")), grid(timing.add("grid and conditions")),
    grid_to_particle(timing.add("grid to particle")), stress(timing.add("stress")),
    relocate(timing.add("relocate and survey"))
  {
  }

  template <int dim>
  Survey<dim> explicit_step(Model<dim> &model, const double time, const double dt, const StepTiming &timing)
  {
    auto &[grid, particles, kernel, transfer, boundary, materials, acceleration, tractions] = model;
    {
      Timing::Scope scope(timing.timing, timing.particle_to_grid);
      boundary.mark_slip_walls(time + dt, particles.n_stencil_nodes, grid);
      grid.clear();
      transfer.particle_to_grid(particles, kernel, acceleration, time, grid);
      tractions.apply(particles, kernel, time, grid);
    }
    {
      Timing::Scope scope(timing.timing, timing.grid);
      grid.fields.add_copies_to_owners();
      transfer.complete(grid);
      grid.update_velocity(dt);
      boundary.apply(time + dt, dt, grid);
      grid.fields.update_copies();
    }

    // What follows concerns each particle alone: block by block, so that a block's fields stay in the cache.
    auto ranges = material_ranges(particles, materials, dt);
    for (auto &range : ranges)
      range.is_plain = transfer.is_plain;
    Surveyor<dim>          surveyor(model, ranges, time + dt, dt);
    double                 displacement = 0;
    constexpr unsigned int block        = dim == 2 ? 1024 : 512;
    particles.start_relocation();
    for (unsigned int begin = 0; begin < particles.size(); begin += block)
    {
      const unsigned int end = std::min(begin + block, particles.size());
      {
        Timing::Scope scope(timing.timing, timing.grid_to_particle);
        displacement = std::max(displacement, transfer.grid_to_particle(grid, kernel, dt, particles, begin, end));
      }
      {
        Timing::Scope scope(timing.timing, timing.stress);
        update_stress(particles, materials, ranges, begin, end);
      }
      {
        Timing::Scope scope(timing.timing, timing.relocate);
        particles.relocate(begin, end);
        surveyor.look_at(begin, end);
      }
    }
    Timing::Scope scope(timing.timing, timing.relocate);
    tractions.finish(particles);
    return surveyor.finish(displacement);
  }

  namespace
  {
    template <int dim, class Batch>
    Tensor<2, dim, typename Batch::Number> relative_deformation(const Batch                           &batch,
                                                                const std::array<double *, dim * dim> &grad_v,
                                                                const double                           dt)
    {
      auto f = dt * load_matrix<dim>(batch, grad_v);
      for (unsigned int d = 0; d < dim; ++d)
        f[d][d] += 1.;
      return f;
    }

    /** Eq. (27), and the volume by the same factor. */
    template <int dim>
    void deform(Particles<dim> &particles, const MaterialRange &range)
    {
      const auto grad_v = particles.template components<dim * dim>(particles.grad_v);
      const auto F      = particles.template components<dim * dim>(particles.F);
      const auto volume = particles.component(particles.volume, 0);
      for_each_batch(range.begin, range.end, [&](const auto batch) {
        const auto f = relative_deformation<dim>(batch, grad_v, range.dt);
        store_matrix(batch, F, f * load_matrix<dim>(batch, F));
        batch.store(volume, batch.load(volume) * determinant(f));
      });
    }

    /** The volume alone, and F = diag(J, 1, 1). */
    template <int dim>
    void dilate(Particles<dim> &particles, const MaterialRange &range, const double reference_density)
    {
      const auto grad_v = particles.template components<dim * dim>(particles.grad_v);
      const auto J      = particles.component(particles.F, 0);
      const auto mass   = particles.component(particles.mass, 0);
      const auto volume = particles.component(particles.volume, 0);
      for_each_batch(range.begin, range.end, [&](const auto batch) {
        const auto V = batch.load(volume) * determinant(relative_deformation<dim>(batch, grad_v, range.dt));
        batch.store(volume, V);
        batch.store(J, reference_density * V / batch.load(mass));
      });
    }
  } // namespace

  template <int dim>
  void update_stress(Particles<dim> &particles, const std::vector<std::unique_ptr<Material>> &materials,
                     const std::vector<MaterialRange> &ranges, const unsigned int begin, const unsigned int end)
  {
    for (unsigned int m = 0; m < materials.size(); ++m)
    {
      const MaterialRange range = intersection(ranges[m], begin, end);
      if (range.begin == range.end)
        continue;
      if (materials[m]->carries_volume_only())
        dilate(particles, range, materials[m]->density);
      else
        deform(particles, range);
      materials[m]->update(range);
    }
  }

  template <int dim>
  void update_stress(Particles<dim> &particles, const std::vector<std::unique_ptr<Material>> &materials,
                     const double dt)
  {
    update_stress(particles, materials, material_ranges(particles, materials, dt), 0, particles.size());
  }

#define INSTANTIATE(dim)                                                                                               \
  template Survey<dim> explicit_step(Model<dim> &, const double, const double, const StepTiming &);                    \
  template void        update_stress(Particles<dim> &, const std::vector<std::unique_ptr<Material>> &,                 \
                                     const std::vector<MaterialRange> &, const unsigned int, const unsigned int);      \
  template void        update_stress(Particles<dim> &, const std::vector<std::unique_ptr<Material>> &, const double);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Talus

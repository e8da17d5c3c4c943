#include <talus/particles/batch_access.h>
#include <talus/transfer/volume_smoothing.h>

#include <algorithm>

namespace Talus
{
  using namespace dealii;

  template <int dim>
  void VolumeSmoothing<dim>::add_fields(const std::vector<std::unique_ptr<Material>> &materials,
                                        WorkingSet<dim>                              &particles)
  {
    for (const auto &material : materials)
      if (material->smoothing_speed() > 0)
        gradient = particles.add_field("gradient of the smoothed volume ratio", dim);
  }

  template <int dim>
  void VolumeSmoothing<dim>::initialize(const std::vector<std::unique_ptr<Material>> &materials,
                                        const Kernel<dim> &kernel, Particles<dim> &particles, const Grid<dim> &grid)
  {
    const auto smooths = [](const auto &material) { return material->smoothing_speed() > 0; };
    for (unsigned int m = 0; m < materials.size(); ++m)
      if (smooths(materials[m]))
        smooth(*materials[m], material_range(particles, m, 0.), kernel, /* alpha = */ 0., particles, grid);
  }

  template <int dim>
  void VolumeSmoothing<dim>::apply(const std::vector<std::unique_ptr<Material>> &materials, const Kernel<dim> &kernel,
                                   const double dt, Particles<dim> &particles, const Grid<dim> &grid)
  {
    for (unsigned int m = 0; m < materials.size(); ++m)
    {
      const double speed = materials[m]->smoothing_speed();
      if (!(speed > 0))
        continue;
      const auto range = material_range(particles, m, dt);
      smooth(*materials[m], range, kernel, std::min(1., speed * dt / grid.smallest_spacing), particles, grid);
      // A material that smooths has no memory: this gives the stress of the new volume, whatever the step.
      materials[m]->update(range);
    }
  }

  template <int dim>
  void VolumeSmoothing<dim>::smooth(const Material &material, const MaterialRange &range, const Kernel<dim> &kernel,
                                    const double alpha, Particles<dim> &particles, const Grid<dim> &grid)
  {
    const double *mass   = particles.component(particles.mass, 0);
    double *const volume = particles.component(particles.volume, 0), *const J_p = particles.component(particles.F, 0);
    const double reference = material.density;
    J.resize(particles.size());
    for (unsigned int p = range.begin; p < range.end; ++p)
      J[p] = reference * volume[p] / mass[p];

    std::array<typename Averaging<dim>::Quantity, dim> quantities;
    std::array<double, dim>                            empty{};
    quantities[0] = {J.data(), particles.template components<dim>(gradient)};
    empty[0]      = 1;
    averaging.apply(quantities, empty, particles, range.begin, range.end, kernel, grid);
    for_each_batch(range.begin, range.end, [&](const auto batch) {
      using Number   = typename std::decay_t<decltype(batch)>::Number;
      const Number V = batch.load(volume), m = batch.load(mass);
      const Number ratio = 1. + alpha * (batch.load(J.data()) * m / (reference * V) - 1.);
      batch.store(volume, ratio * V);
      batch.store(J_p, reference * (ratio * V) / m); // F = diag(J, 1, 1)
    });
  }

  template class VolumeSmoothing<2>;
  template class VolumeSmoothing<3>;
} // namespace Talus

#include <talus/particles/batch_access.h>
#include <talus/steppers/deformation.h>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    /** Of what the materials see. */
    template <int dim, class Batch>
    [[gnu::always_inline]] inline Tensor<2, dim, typename Batch::Number> relative_deformation(
      const Batch &batch, const MaterialRange &range)
    {
      Tensor<2, dim, typename Batch::Number> f;
      for (unsigned int d = 0; d < dim; ++d)
        for (unsigned int e = 0; e < dim; ++e)
          f[d][e] = range.dt * batch.load(range.grad_v[3 * d + e]);
      for (unsigned int d = 0; d < dim; ++d)
        f[d][d] += 1.;
      return f;
    }

    /** Eq. (27), and the volume by the same factor. */
    template <int dim>
    void deform(Particles<dim> &particles, const MaterialRange &range)
    {
      const auto F      = particles.template components<dim * dim>(particles.F);
      const auto volume = particles.component(particles.volume, 0);
      for_each_batch(range.begin, range.end, [&](const auto batch) {
        const auto f = relative_deformation<dim>(batch, range);
        store_matrix(batch, F, f * load_matrix<dim>(batch, F));
        batch.store(volume, batch.load(volume) * determinant(f));
      });
    }

    /** The volume alone, and F = diag(J, 1, 1). */
    template <int dim>
    void dilate(Particles<dim> &particles, const MaterialRange &range, const double reference_density)
    {
      const auto J      = particles.component(particles.F, 0);
      const auto mass   = particles.component(particles.mass, 0);
      const auto volume = particles.component(particles.volume, 0);
      for_each_batch(range.begin, range.end, [&](const auto batch) {
        const auto V = batch.load(volume) * determinant(relative_deformation<dim>(batch, range));
        batch.store(volume, V);
        batch.store(J, reference_density * V / batch.load(mass));
      });
    }
  } // namespace

  template <int dim>
  void deform(Particles<dim> &particles, const std::vector<std::unique_ptr<Material>> &materials,
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
    }
  }

  template <int dim>
  void update_stress(Particles<dim> &particles, const std::vector<std::unique_ptr<Material>> &materials,
                     const std::vector<MaterialRange> &ranges, const unsigned int begin, const unsigned int end)
  {
    deform(particles, materials, ranges, begin, end);
    for (unsigned int m = 0; m < materials.size(); ++m)
      materials[m]->update(intersection(ranges[m], begin, end));
  }

  template <int dim>
  void update_stress(Particles<dim> &particles, const std::vector<std::unique_ptr<Material>> &materials,
                     const double dt)
  {
    update_stress(particles, materials, material_ranges(particles, dt), 0, particles.size());
  }

#define INSTANTIATE(dim)                                                                                               \
  template void deform(Particles<dim> &, const std::vector<std::unique_ptr<Material>> &,                               \
                       const std::vector<MaterialRange> &, const unsigned int, const unsigned int);                    \
  template void update_stress(Particles<dim> &, const std::vector<std::unique_ptr<Material>> &,                        \
                              const std::vector<MaterialRange> &, const unsigned int, const unsigned int);             \
  template void update_stress(Particles<dim> &, const std::vector<std::unique_ptr<Material>> &, const double);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Talus

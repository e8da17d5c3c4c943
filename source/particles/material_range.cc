#include <talus/particles/material_range.h>

namespace Talus
{
  template <int dim>
  MaterialRange material_range(WorkingSet<dim> &particles, const Material &material, const unsigned int m,
                               const double dt)
  {
    MaterialRange range;
    const bool    has_particles = m + 1 < particles.material_begin.size();
    range.begin                 = has_particles ? particles.material_begin[m] : 0;
    range.end                   = has_particles ? particles.material_begin[m + 1] : 0;
    range.dt                    = dt;
    range.grad_v.fill(nullptr);
    range.F.fill(nullptr);
    range.stress.fill(nullptr);
    range.state.fill(nullptr);
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
      {
        range.grad_v[3 * i + j] = particles.component(particles.grad_v, dim * i + j);
        range.F[3 * i + j]      = particles.component(particles.F, dim * i + j);
      }
    for (unsigned int c = 0; c < particles.n_stress; ++c)
      range.stress[c] = particles.component(particles.stress, c);
    range.mass       = particles.component(particles.mass, 0);
    range.volume     = particles.component(particles.volume, 0);
    const auto names = material.state_names();
    Assert(names.size() <= range.max_states, dealii::ExcIndexRange(names.size(), 0, range.max_states));
    for (unsigned int s = 0; s < names.size(); ++s)
      range.state[s] = particles.component(particles.add_field(names[s], 1), 0);
    return range;
  }

  template <int dim>
  std::vector<MaterialRange> material_ranges(WorkingSet<dim>                              &particles,
                                             const std::vector<std::unique_ptr<Material>> &materials, const double dt)
  {
    std::vector<MaterialRange> ranges;
    for (unsigned int m = 0; m < materials.size(); ++m)
      ranges.push_back(material_range(particles, *materials[m], m, dt));
    return ranges;
  }

#define INSTANTIATE(dim)                                                                                               \
  template MaterialRange material_range(WorkingSet<dim> &, const Material &, const unsigned int, const double);        \
  template std::vector<MaterialRange> material_ranges(WorkingSet<dim> &,                                               \
                                                      const std::vector<std::unique_ptr<Material>> &, const double);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Talus

#include <talus/particles/material_range.h>

namespace Talus
{
  namespace
  {
    const std::string F_name = "seen deformation gradient", grad_v_name = "seen velocity gradient",
                      volume_name = "seen volume";
  }

  template <int dim>
  SeenFields add_seen_fields(WorkingSet<dim> &particles)
  {
    return {particles.add_field(F_name, dim * dim), particles.add_field(grad_v_name, dim * dim),
            particles.add_field(volume_name, 1)};
  }

  template <int dim>
  SeenFields seen_fields(const WorkingSet<dim> &particles)
  {
    if (const auto F = particles.find_field(F_name))
      return {*F, *particles.find_field(grad_v_name), *particles.find_field(volume_name)};
    return {particles.F, particles.grad_v, particles.volume};
  }

  template <int dim>
  MaterialRange material_range(WorkingSet<dim> &particles, const unsigned int m, const double dt)
  {
    MaterialRange range;
    const auto    seen          = seen_fields(particles);
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
        range.grad_v[3 * i + j] = particles.component(seen.grad_v, dim * i + j);
        range.F[3 * i + j]      = particles.component(seen.F, dim * i + j);
      }
    for (unsigned int c = 0; c < particles.n_stress; ++c)
      range.stress[c] = particles.component(particles.stress, c);
    range.mass         = particles.component(particles.mass, 0);
    range.volume       = particles.component(seen.volume, 0);
    const auto &states = particles.state_fields[m];
    AssertIndexRange(states.size(), range.max_states + 1);
    for (unsigned int k = 0; k < states.size(); ++k)
      range.state[k] = particles.component(states[k], 0);
    return range;
  }

  template <int dim>
  std::vector<MaterialRange> material_ranges(WorkingSet<dim> &particles, const double dt)
  {
    std::vector<MaterialRange> ranges;
    for (unsigned int m = 0; m < particles.state_fields.size(); ++m)
      ranges.push_back(material_range(particles, m, dt));
    return ranges;
  }

#define INSTANTIATE(dim)                                                                                               \
  template SeenFields                 add_seen_fields(WorkingSet<dim> &);                                              \
  template SeenFields                 seen_fields(const WorkingSet<dim> &);                                            \
  template MaterialRange              material_range(WorkingSet<dim> &, const unsigned int, const double);             \
  template std::vector<MaterialRange> material_ranges(WorkingSet<dim> &, const double);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Talus

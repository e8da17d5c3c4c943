#include <talus/particles/material_range.h>

namespace Talus
{
  namespace
  {
    const std::string gradient_name = "seen velocity gradient";
  }

  template <int dim>
  void add_seen_gradient(WorkingSet<dim> &particles)
  {
    particles.add_field(gradient_name, dim * dim);
  }

  template <int dim>
  unsigned int seen_gradient(const WorkingSet<dim> &particles)
  {
    return particles.find_field(gradient_name).value_or(particles.grad_v);
  }

  template <int dim>
  MaterialRange material_range(WorkingSet<dim> &particles, const unsigned int m, const double dt)
  {
    MaterialRange range;
    const auto    gradient      = seen_gradient(particles);
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
        range.grad_v[3 * i + j] = particles.component(gradient, dim * i + j);
        range.F[3 * i + j]      = particles.component(particles.F, dim * i + j);
      }
    for (unsigned int c = 0; c < particles.n_stress; ++c)
      range.stress[c] = particles.component(particles.stress, c);
    range.mass         = particles.component(particles.mass, 0);
    range.volume       = particles.component(particles.volume, 0);
    const auto &states = particles.state_fields[m];
    AssertIndexRange(states.size(), range.max_states + 1);
    for (unsigned int k = 0; k < states.size(); ++k)
      range.state[k] = particles.component(states[k], 0);
    return range;
  }

  template <int dim>
  std::vector<MaterialRange> material_ranges(WorkingSet<dim> &particles, const double dt, const bool is_plain)
  {
    std::vector<MaterialRange> ranges;
    for (unsigned int m = 0; m < particles.state_fields.size(); ++m)
    {
      ranges.push_back(material_range(particles, m, dt));
      ranges.back().is_plain = is_plain;
    }
    return ranges;
  }

#define INSTANTIATE(dim)                                                                                               \
  template void                       add_seen_gradient(WorkingSet<dim> &);                                            \
  template unsigned int               seen_gradient(const WorkingSet<dim> &);                                          \
  template MaterialRange              material_range(WorkingSet<dim> &, const unsigned int, const double);             \
  template std::vector<MaterialRange> material_ranges(WorkingSet<dim> &, const double, const bool);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Talus

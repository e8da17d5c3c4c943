#include <talus/steppers/explicit_step.h>

namespace Talus
{
  using namespace dealii;

  template <int dim>
  void explicit_step(Model<dim> &model, const double time, const double dt, TimerOutput &timer)
  {
    auto &[grid, particles, kernel, transfer, boundary, materials, acceleration] = model;
    {
      TimerOutput::Scope scope(timer, "particle to grid");
      grid.clear();
      transfer.particle_to_grid(particles, kernel, acceleration, time, grid);
    }
    {
      TimerOutput::Scope scope(timer, "grid and conditions");
      grid.fields.add_copies_to_owners();
      grid.update_velocity(dt);
      boundary.apply(time + dt, dt, grid);
      grid.fields.update_copies();
    }
    {
      TimerOutput::Scope scope(timer, "grid to particle");
      transfer.grid_to_particle(grid, kernel, dt, particles);
    }
    {
      TimerOutput::Scope scope(timer, "stress");
      update_stress(particles, materials, dt);
    }
    {
      TimerOutput::Scope scope(timer, "relocate");
      particles.relocate();
    }
  }

  namespace
  {
    /** Eq. (27), and the volume by the same factor. */
    template <int dim>
    void deform(Particles<dim> &particles, const double dt)
    {
      const auto grad_v = particles.template components<dim * dim>(particles.grad_v);
      const auto F      = particles.template components<dim * dim>(particles.F);
      const auto volume = particles.component(particles.volume, 0);
      for (unsigned int p = 0; p < particles.size(); ++p)
      {
        Tensor<2, dim> f = unit_symmetric_tensor<dim>(), F_p;
        for (unsigned int c = 0; c < dim * dim; ++c)
        {
          f[c / dim][c % dim] += dt * grad_v[c][p];
          F_p[c / dim][c % dim] = F[c][p];
        }
        F_p = f * F_p;
        for (unsigned int c = 0; c < dim * dim; ++c)
          F[c][p] = F_p[c / dim][c % dim];
        volume[p] *= determinant(f);
      }
    }
  } // namespace

  template <int dim>
  void update_stress(Particles<dim> &particles, const std::vector<std::unique_ptr<Material>> &materials,
                     const double dt)
  {
    deform(particles, dt);
    for (unsigned int m = 0; m < materials.size(); ++m)
      materials[m]->update(material_range(particles, *materials[m], m, dt));
  }

  template <int dim>
  MaterialRange material_range(Particles<dim> &particles, const Material &material, const unsigned int m,
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
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
      {
        range.grad_v[3 * i + j] = particles.component(particles.grad_v, dim * i + j);
        range.F[3 * i + j]      = particles.component(particles.F, dim * i + j);
      }
    for (unsigned int c = 0; c < particles.n_stress; ++c)
      range.stress[c] = particles.component(particles.stress, c);
    range.mass   = particles.component(particles.mass, 0);
    range.volume = particles.component(particles.volume, 0);
    for (const auto &name : material.state_names())
      range.state.push_back(particles.component(particles.add_field(name, 1), 0));
    return range;
  }

#define INSTANTIATE(dim)                                                                                                \
  template void          explicit_step(Model<dim> &, const double, const double, TimerOutput &);                        \
  template void          update_stress(Particles<dim> &, const std::vector<std::unique_ptr<Material>> &, const double); \
  template MaterialRange material_range(Particles<dim> &, const Material &, const unsigned int, const double);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Talus

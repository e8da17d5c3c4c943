#include <talus/particles/batch_access.h>
#include <talus/transfer/f_bar.h>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    /** x^(1/dim) */
    template <int dim, typename Number>
    Number root(const Number &x)
    {
      return dim == 2 ? sqrt(x) : exp(log(x) / double(dim));
    }
  } // namespace

  template <int dim>
  void FBar<dim>::add_fields(WorkingSet<dim> &particles)
  {
    if (is_on)
      add_seen_fields(particles);
  }

  template <int dim>
  void FBar<dim>::initialize(Particles<dim> &particles)
  {
    if (!is_on)
      return;
    const auto seen = seen_fields(particles);
    const auto copy = [&](const unsigned int from, const unsigned int to) {
      for (unsigned int c = 0; c < particles.fields[from].n_components; ++c)
        std::copy_n(particles.component(from, c), particles.size(), particles.component(to, c));
    };
    copy(particles.F, seen.F);
    copy(particles.volume, seen.volume);
    copy(particles.grad_v, seen.grad_v);
  }

  template <int dim>
  void FBar<dim>::apply(const std::vector<std::unique_ptr<Material>> &materials, const Kernel<dim> &kernel,
                        const double dt, Particles<dim> &particles, const Grid<dim> &grid)
  {
    if (!is_on)
      return;
    mean.resize(particles.size());
    weight.assign(particles.size(), 1.);
    const double *volume = particles.component(particles.volume, 0), *mass = particles.component(particles.mass, 0);
    for (unsigned int m = 0; m < materials.size(); ++m)
    {
      const MaterialRange range = material_range(particles, m, dt);
      for (unsigned int p = range.begin; p < range.end; ++p)
        mean[p] = materials[m]->density * volume[p] / mass[p];
      std::array<typename Averaging<dim>::Quantity, dim> quantities;
      quantities[0].value = mean.data();
      quantities[1].value = weight.data();
      std::array<double, dim> empty{};
      averaging.apply(quantities, empty, particles, range.begin, range.end, kernel, grid);
      update(range, *materials[m], particles);
    }
  }

  template <int dim>
  void FBar<dim>::update(const MaterialRange &range, const Material &material, Particles<dim> &particles) const
  {
    const auto    seen     = seen_fields(particles);
    const auto    grad_v   = particles.template components<dim * dim>(particles.grad_v);
    const auto    F        = particles.template components<dim * dim>(particles.F);
    const auto    grad_bar = particles.template components<dim * dim>(seen.grad_v);
    const auto    F_bar    = particles.template components<dim * dim>(seen.F);
    const double *volume = particles.component(particles.volume, 0), *mass = particles.component(particles.mass, 0);
    double *const V_bar   = particles.component(seen.volume, 0);
    const double  density = material.density, dt = range.dt;
    const bool    is_fluid = material.carries_volume_only();
    for_each_batch(range.begin, range.end, [&](const auto batch) {
      using Number   = typename std::decay_t<decltype(batch)>::Number;
      const Number V = batch.load(volume), old = batch.load(V_bar);
      const Number J   = batch.load(mean.data()) / batch.load(weight.data());
      const Number now = J * batch.load(mass) / density;
      const auto   L   = load_matrix<dim>(batch, grad_v);
      auto         f   = dt * L;
      for (unsigned int d = 0; d < dim; ++d)
        f[d][d] += 1.;
      // f-bar = s f has the determinant V-bar / V-bar of the last step.
      const Number s             = root<dim>(Number(now / (old * determinant(f))));
      auto         seen_gradient = s * L;
      for (unsigned int d = 0; d < dim; ++d)
        seen_gradient[d][d] += (s - 1.) / dt;
      store_matrix(batch, grad_bar, seen_gradient);
      if (is_fluid)
        batch.store(F_bar[0], J); // the rest of diag(J, 1, 1) stays
      else
        store_matrix(batch, F_bar, root<dim>(Number(now / V)) * load_matrix<dim>(batch, F));
      batch.store(V_bar, now);
    });
  }

  template class FBar<2>;
  template class FBar<3>;
} // namespace Talus

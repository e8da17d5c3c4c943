#include <talus/particles/batch_access.h>
#include <talus/transfer/f_bar.h>

#include <algorithm>

namespace Talus
{
  using namespace dealii;

  template <int dim>
  void FBar<dim>::add_fields(WorkingSet<dim> &particles)
  {
    if (!is_on)
      return;
    add_seen_gradient(particles);
    added_stress = particles.add_field("mean stress that averaging adds", 1);
  }

  template <int dim>
  void FBar<dim>::initialize(Particles<dim> &particles)
  {
    if (!is_on)
      return;
    const unsigned int seen = seen_gradient(particles);
    for (unsigned int c = 0; c < dim * dim; ++c)
      std::copy_n(particles.component(particles.grad_v, c), particles.size(), particles.component(seen, c));
  }

  template <int dim>
  void FBar<dim>::start(const unsigned int n_materials, const Kernel<dim> &kernel, Particles<dim> &particles,
                        const Grid<dim> &grid)
  {
    if (!is_on)
      return;
    weights.find(kernel, particles);
    mass.resize(n_materials);
    if (means.is_empty())
      means.reinit(grid.nodes);
    mean.assign(particles.size(), 1.);
    for (unsigned int m = 0; m < n_materials; ++m)
    {
      if (mass[m].is_empty())
        mass[m].reinit(grid.nodes);
      scatter(material_range(particles, m, /* dt = */ 0.), mean.data(), grid, mass[m]);
    }
  }

  template <int dim>
  void FBar<dim>::scatter(const MaterialRange &range, const double *numbers, const Grid<dim> &grid, NodalArray<1> &to)
  {
    product.resize(range.end);
    for (unsigned int p = range.begin; p < range.end; ++p)
      product[p] = range.mass[p] * numbers[p];
    to.clear(grid.active_nodes);
    weights.scatter(product.data(), range.begin, range.end, to);
    to.add_copies_to_owners();
  }

  template <int dim>
  void FBar<dim>::average(const bool is_adjoint, Particles<dim> &particles, const Grid<dim> &grid)
  {
    // Without the division the average is its own adjoint, in the metric of the masses.
    const auto &sum = weights.sums();
    for (unsigned int m = 0; m < mass.size(); ++m)
    {
      const auto range  = material_range(particles, m, /* dt = */ 0.);
      const auto divide = [&] {
        for (unsigned int p = range.begin; p < range.end; ++p)
          mean[p] /= sum[p];
      };
      for (unsigned int n = 0; n < n_passes; ++n)
      {
        if (is_adjoint)
          divide();
        scatter(range, mean.data(), grid, means);
        for (const unsigned int i : grid.active_nodes)
        {
          const double m_i = *mass[m][i];
          *means[i]        = m_i > grid.mass_floor ? *means[i] / m_i : 0.;
        }
        means.update_copies();
        weights.gather(means, range.begin, range.end, mean.data());
        if (!is_adjoint)
          divide();
      }
    }
  }

  template <int dim>
  void FBar<dim>::average_stress(Particles<dim> &particles, const Grid<dim> &grid)
  {
    if (!is_on)
      return;
    remove_added(particles, 0, particles.size());
    const double *volume = particles.component(particles.volume, 0), *mass = particles.component(particles.mass, 0);
    double *const added = particles.component(added_stress, 0);
    mean.resize(particles.size());
    for (unsigned int p = 0; p < particles.size(); ++p)
    {
      added[p] = 0;
      for (unsigned int d = 0; d < dim; ++d)
        added[p] -= particles.component(particles.stress, d)[p] / dim;
      mean[p] = -added[p] * volume[p] / mass[p];
    }
    average(/* is_adjoint = */ true, particles, grid);
    for (unsigned int p = 0; p < particles.size(); ++p)
      added[p] += mean[p] * mass[p] / volume[p];
    add_added(particles, 0, particles.size());
  }

  template <int dim>
  void FBar<dim>::change_stress(Particles<dim> &particles, const double sign, const unsigned int begin,
                                const unsigned int end) const
  {
    const double *added = particles.component(added_stress, 0);
    for (unsigned int d = 0; d < 3; ++d) // zz in plane strain as well: it is the mean that is averaged
    {
      double *stress = particles.component(particles.stress, d);
      for (unsigned int p = begin; p < end; ++p)
        stress[p] += sign * added[p];
    }
  }

  template <int dim>
  void FBar<dim>::average_rate(const double dt, Particles<dim> &particles, const Grid<dim> &grid)
  {
    mean.resize(particles.size());
    own.resize(particles.size());
    const auto grad_v = particles.template components<dim * dim>(particles.grad_v),
               seen   = particles.template components<dim * dim>(seen_gradient(particles));
    for_each_batch(0, particles.size(), [&](const auto batch) {
      using Number = typename std::decay_t<decltype(batch)>::Number;
      auto f       = dt * load_matrix<dim>(batch, grad_v);
      for (unsigned int d = 0; d < dim; ++d)
        f[d][d] += 1.;
      const Number change = log(Number(determinant(f)));
      batch.store(mean.data(), change);
      batch.store(own.data(), change);
    });
    average(/* is_adjoint = */ false, particles, grid);
    for_each_batch(0, particles.size(), [&](const auto batch) {
      using Number   = typename std::decay_t<decltype(batch)>::Number;
      const Number s = exp((batch.load(mean.data()) - batch.load(own.data())) / double(dim));
      auto         L = s * load_matrix<dim>(batch, grad_v);
      for (unsigned int d = 0; d < dim; ++d)
        L[d][d] += (s - 1.) / dt;
      store_matrix(batch, seen, L);
    });
  }

  template class FBar<2>;
  template class FBar<3>;
} // namespace Talus

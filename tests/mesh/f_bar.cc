#include "on_mesh.h"

using namespace Test;

/** F-bar: a uniform change of volume stays, and what it does to the mean stress keeps the sum of V p; mirrors change no
 * sign. */
template <int dim>
void f_bar_on_a_mesh()
{
  for (const std::string mirror : {"", "lower x"})
  {
    OnMesh<dim> run(box_of_simplices<dim>() + section("Run", set("F-bar", "true")) + box_body<dim>(0, 1) +
                    section("Kernel", set("Type", "UMLS")) +
                    (mirror.empty() ? "" : section("Grid", set("Slip mirrors", mirror))));
    auto       &particles = run.particles;
    const auto  stress    = particles.template components<WorkingSet<dim>::n_stress>(particles.stress);
    const auto  grad_v    = particles.template components<dim * dim>(particles.grad_v),
               seen       = particles.template components<dim * dim>(seen_gradient(particles));
    const double *V       = particles.component(particles.volume, 0);
    double        before = 0, after = 0, size = 0, changed = 0, error = 0;
    run.grid.activate(particles.used_places());
    for (unsigned int p = 0; p < particles.size(); ++p)
    {
      for (unsigned int d = 0; d < dim; ++d)
        before += V[p] * (stress[d][p] = hashed_jitter(d, particles.id[p], 0));
      for (unsigned int c = 0; c < dim * dim; ++c)
        grad_v[c][p] = 1. + c;
    }
    run.f_bar.start(1, *run.kernel, particles, run.grid);
    run.f_bar.average_stress(particles, run.grid);
    run.f_bar.average_rate(/* dt = */ 0.01, particles, run.grid);
    for (unsigned int p = 0; p < particles.size(); ++p)
    {
      raise(changed, stress[0][p] - hashed_jitter(0, particles.id[p], 0));
      for (unsigned int d = 0; d < dim; ++d)
      {
        after += V[p] * stress[d][p];
        size += V[p];
      }
      for (unsigned int c = 0; c < dim * dim; ++c)
        raise(error, 0.01 * (seen[c][p] - grad_v[c][p]));
    }
    const std::string name = mirror.empty() ? "" : "mirrored at " + mirror + ": ";
    check_true(name + "stress is averaged", max(changed) > 0.05);
    check(name + "sum of V p", (sum(after) - sum(before)) / sum(size), 1e-13);
    check(name + "a uniform change stays", max(error), 1e-13);
  }
}

template void f_bar_on_a_mesh<2>();
template void f_bar_on_a_mesh<3>();

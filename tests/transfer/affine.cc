#include <talus/steppers/explicit_step.h>

#include "transfer.h"

#include <deal.II/base/symmetric_tensor.h>

using namespace Test;
using namespace dealii;

namespace
{
  template <int dim>
  Tensor<1, dim> offset_velocity()
  {
    Tensor<1, dim> v;
    for (unsigned int d = 0; d < dim; ++d)
      v[d] = 0.4 - 0.3 * d;
    return v;
  }

  /** v = a + L x on all particles, with the velocity gradient and what the scheme derives from it. */
  template <int dim>
  void set_affine(Setup<dim> &setup)
  {
    const auto L = some_gradient<dim>();
    setup.fill(setup.particles.velocity, [&](const unsigned int p, const unsigned int c) {
      return (offset_velocity<dim>() + L * setup.position(p))[c];
    });
    setup.fill(setup.particles.grad_v, [&](unsigned int, const unsigned int c) { return L[c / dim][c % dim]; });
    setup.transfer->initialize(*setup.kernel, setup.particles);
  }

  /** Greatest error of velocity and velocity gradient (times h) after 100 transfers of frozen particles. */
  template <int dim>
  double affine_error(Setup<dim> &setup)
  {
    set_affine(setup);
    for (unsigned int n = 0; n < 100; ++n)
      setup.step(0.);
    const auto L     = some_gradient<dim>();
    double     error = 0;
    for (unsigned int p = 0; p < setup.particles.size(); ++p)
    {
      raise(error, (velocity(setup, p) - offset_velocity<dim>() - L * setup.position(p)).norm());
      raise(error, 0.1 * (matrix(setup, setup.particles.grad_v, p) - L).norm());
    }
    return error;
  }

  const std::vector<std::string> kernels = {"linear", "quadratic B-spline", "cubic B-spline", "uGIMP"};
} // namespace

/** A small body whose stencils are complete, with any treatment. */
template <int dim>
void affine_in_the_interior()
{
  for (const std::string transfer : {"APIC", "TPIC"})
    for (const auto &kernel : kernels)
      for (const std::string treatment : {"none", "Steffen", "WLS", "WLS separable", "WLS everywhere", "MLS"})
        if (treatment != "Steffen" || kernel != "uGIMP")
        {
          Setup<dim> setup(skewed_grid<dim>({{9, 8, 7}}) + kernel_text(kernel, treatment) + transfer_text(transfer) +
                           box_body<dim>({{0.0, 0.94, 0.575}}, {{0.3, 1.1, 0.70}}, 0.5));
          check(transfer + ", " + kernel + ", " + treatment, affine_error(setup), 1e-12);
        }
}

/** Particles in all cells of the box, some of them on faces, edges and corners or a hair off: D is singular there. */
template <int dim>
void affine_at_walls()
{
  for (const std::string transfer : {"APIC", "TPIC"})
    for (const auto &kernel : kernels)
      for (const std::string treatment : {"WLS", "WLS separable", "WLS everywhere", "MLS"})
      {
        if (dim == 3 && treatment != "WLS" && kernel == "linear")
          continue; // no node is ever missing: all treatments are alike
        Setup<dim> setup(full_box<dim>(kernel, treatment, transfer));
        check(transfer + ", " + kernel + ", " + treatment + ": near walls", affine_error(setup), 1e-12);

        const auto &lattice = setup.grid.lattice;
        setup.fill(setup.particles.position, [&](const unsigned int p, const unsigned int d) {
          const double x = setup.particles.component(setup.particles.position, d)[p];
          const double c = lattice.coordinate(x, d), gap = setup.particles.id[p] % 2 == 0 ? 0. : 1e-13;
          if (c < 0.5)
            return lattice.origin[d] + gap;
          return c > lattice.n_cells[d] - 0.5 ? setup.grid.upper[d] - 1e-15 - gap : x;
        });
        check(transfer + ", " + kernel + ", " + treatment + ": on walls", affine_error(setup), 1e-12);
      }
}

/**
 * Every node gets v = L x. Then x <- (1 + dt L) x, F <- (1 + dt L) F, grad v = L exactly, and the stress follows
 * Eq. (28) with constant increments; all of it is computed here by plain matrices.
 */
template <int dim>
void affine_drive()
{
  for (const std::string treatment : {"WLS", "WLS separable", "WLS everywhere", "MLS"})
    for (const std::string transfer : {"FLIP", "PIC", "APIC", "TPIC"})
      for (const std::string kernel : {"quadratic B-spline", "cubic B-spline", "uGIMP"})
      {
        if ((treatment != "WLS" || transfer != "TPIC") && kernel != "quadratic B-spline")
          continue;
        Setup<dim>   setup(full_box<dim>(kernel, treatment, transfer));
        const double dt = 1e-4, E = 7, nu = 0.2, lambda = E * nu / ((1 + nu) * (1 - 2 * nu)), G = E / (2 * (1 + nu));
        const auto   L = some_gradient<dim>();

        std::vector<Point<dim>> x(setup.particles.size());
        for (unsigned int p = 0; p < x.size(); ++p)
          x[p] = setup.position(p);
        Tensor<2, dim> F = unit_symmetric_tensor<dim>();
        Tensor<2, 3>   d, w, stress;
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = 0; j < dim; ++j)
          {
            d[i][j] = 0.5 * dt * (L[i][j] + L[j][i]);
            w[i][j] = 0.5 * dt * (L[i][j] - L[j][i]);
          }
        for (unsigned int n = 0; n < 50; ++n)
        {
          for (unsigned int i = 0; i < setup.grid.fields.n_local(); ++i)
          {
            const Tensor<1, dim> v = L * setup.grid.node_position(i);
            for (unsigned int k = 0; k < dim; ++k)
              setup.grid.fields[i][NodalFields<dim>::velocity + k] = v[k];
          }
          setup.transfer->grid_to_particle(setup.grid, *setup.kernel, dt, setup.particles);
          update_stress(setup.particles, setup.materials, dt);
          for (auto &x_p : x)
            x_p += dt * (L * x_p);
          F += dt * (L * F);
          stress += lambda * trace(d) * Tensor<2, 3>(unit_symmetric_tensor<3>()) + 2 * G * d + w * stress - stress * w;
        }

        double x_error = 0, J_error = 0, stress_error = 0;
        for (unsigned int p = 0; p < x.size(); ++p)
        {
          raise(x_error, setup.position(p).distance(x[p]));
          raise(J_error, determinant(matrix(setup, setup.particles.F, p)) - determinant(F));
          for (unsigned int c = 0; c < setup.particles.n_stress; ++c)
          {
            const unsigned int i = c < 3 ? c : (c == 5 ? 1 : 0), j = c < 3 ? c : (c == 3 ? 1 : 2);
            raise(stress_error, (setup.particles.component(setup.particles.stress, c)[p] - stress[i][j]));
          }
        }
        const std::string name = transfer + ", " + kernel + ", " + treatment;
        check(name + ": x", x_error, 1e-12);
        check(name + ": J", J_error / determinant(F), 1e-12);
        check(name + ": stress", stress_error / stress.norm(), 1e-12);
      }
}

template void affine_in_the_interior<2>();
template void affine_in_the_interior<3>();
template void affine_at_walls<2>();
template void affine_at_walls<3>();
template void affine_drive<2>();
template void affine_drive<3>();

#include <talus/steppers/explicit_step.h>

#include "transfer.h"

using namespace Test;
using namespace dealii;

/**
 * Stretched by 2 % in each step and squeezed as much across, in axes at 30 degrees to the grid: after 2000 steps of a
 * lone particle, whose velocity gradient nothing takes away, F is e^40 one way and e^-40 the other. det F is then the
 * difference of products of e^40; the volume is prod(1 - (L dt)^2) of the first one, to the round-off of as many
 * multiplications. A solid beside it keeps its F.
 */
template <int dim>
void stretched_fluid()
{
  const unsigned int n = 2000;
  const double       L = 0.02, c = 3, reference = 2, angle = numbers::PI / 6;
  const std::string  box = set("Lower corner", coordinates<dim>({{0.25, 0.25, 0.25}})) +
                          set("Upper corner", coordinates<dim>({{0.5, 0.5, 0.5}}));
  const std::string beside = set("Lower corner", coordinates<dim>({{0.5, 0.25, 0.25}})) +
                             set("Upper corner", coordinates<dim>({{0.75, 0.5, 0.5}})) + set("Material", "rubber");
  Setup<dim> setup(
    section("Grid", set("Upper corner", coordinates<dim>({{1, 1, 1}})) + set("Spacing", "0.125")) +
    section("Materials",
            set("Names", "water, rubber") + section("water", set("Type", "Newtonian fluid") + set("Density", "2") +
                                                               set("Sound speed", "3") + set("Viscosity", "0"))) +
    section("Bodies", set("Names", "drop, block") +
                        section("drop", box + set("Initial stress", "uniform") + set("Stress", "-1, -1, -1, 0, 0, 0")) +
                        section("block", beside)));
  auto &particles = setup.particles;
  // J of the initial pressure of 1: 1 + 1/(c^2 rho_ref) is rho over rho_ref.
  const double J_0   = 1 / (1 + 1 / (c * c * reference));
  double       error = 0;
  for (unsigned int p = particles.material_begin[0]; p < particles.material_begin[1]; ++p)
    raise(error, determinant(matrix(setup, particles.F, p)) - J_0);
  check("J of the initial pressure", error, 1e-15);

  Tensor<2, dim> R = unit_symmetric_tensor<dim>(), stretch;
  R[0][0] = R[1][1] = std::cos(angle);
  R[1][0]           = std::sin(angle);
  R[0][1]           = -R[1][0];
  stretch[0][0] = L, stretch[1][1] = -L;
  const Tensor<2, dim> rate = R * stretch * transpose(R);
  setup.fill(particles.grad_v, [&](unsigned int, const unsigned int k) { return rate[k / dim][k % dim]; });
  Tensor<2, dim> F = unit_symmetric_tensor<dim>(), f = F + rate;
  long double    J = J_0;
  for (unsigned int k = 0; k < n; ++k)
  {
    update_stress(particles, setup.materials, 1.);
    F = f * F;
    J *= 1 - static_cast<long double>(L) * L;
  }
  const double expected = c * c * reference * (1 / J - 1);
  double       pressure = 0, ratio = 0, others = 0, solid = 0;
  for (unsigned int p = particles.material_begin[0]; p < particles.material_begin[1]; ++p)
  {
    for (unsigned int d = 0; d < 3; ++d)
      raise(pressure, particles.component(particles.stress, d)[p] / expected + 1);
    raise(ratio, particles.component(particles.F, 0)[p] / static_cast<double>(J) - 1);
    for (unsigned int k = 1; k < dim * dim; ++k)
      raise(others, particles.component(particles.F, k)[p] - (k % (dim + 1) == 0));
  }
  for (unsigned int p = particles.material_begin[1]; p < particles.material_begin[2]; ++p)
    raise(solid, (matrix(setup, particles.F, p) - F).norm() / F.norm());
  check("pressure", pressure, 1e-12);
  check("J", ratio, 1e-12);
  check("F = diag(J, 1, 1)", others, 0.);
  check("F of the solid", solid, 1e-13);
  check_true("its determinant is lost", std::abs(determinant(F) / static_cast<double>(J) * J_0 - 1) > 0.1);
}

template void stretched_fluid<2>();
template void stretched_fluid<3>();

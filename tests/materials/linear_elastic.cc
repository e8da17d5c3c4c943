#include "point.h"

using namespace Test;

namespace
{
  constexpr double E = 7, nu = 0.2;
  constexpr double lambda = E * nu / ((1 + nu) * (1 - 2 * nu)), G = E / (2 * (1 + nu));

  SinglePoint point(const unsigned int dim = 3)
  {
    return SinglePoint("linear elastic", set("Young's modulus", "7") + set("Poisson's ratio", "0.2"), dim);
  }

} // namespace

/** No spin: sigma = (lambda + 2 G) e along the axis and lambda e across, whatever the steps. */
void uniaxial_strain()
{
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    auto         p = point();
    Tensor<2, 3> L, expected;
    L[axis][axis] = 0.3;
    for (unsigned int n = 0; n < 10; ++n)
      p.advance(L, 0.01);
    for (unsigned int d = 0; d < 3; ++d)
      expected[d][d] = (d == axis ? lambda + 2 * G : lambda) * 0.03;
    check("axis " + std::to_string(axis), distance(p.stress(), expected), 1e-14 * E);
  }
}

/**
 * v_x = g y. With k = g dt, u = (sigma_xx - sigma_yy)/2 - G and z = u + i sigma_xy the Jaumann rate steps by
 * z <- z (1 - i k), from z = -G: the steps have a closed form, and their limit is sigma_xy = G sin(g t),
 * sigma_xx = -sigma_yy = G (1 - cos(g t)), from which it is off by the factor exp(g^2 t^2 / 2 N) - 1 at most.
 */
void simple_shear()
{
  double before = 0;
  for (const unsigned int N : {200, 400})
  {
    auto         p     = point();
    const double gamma = 0.8;
    Tensor<2, 3> L;
    L[0][1] = gamma;
    for (unsigned int n = 0; n < N; ++n)
      p.advance(L, 1. / N);
    const std::complex<double> z = -G * std::pow(std::complex<double>(1, -gamma / N), N);
    Tensor<2, 3>               steps, limit;
    steps[0][1] = steps[1][0] = z.imag();
    steps[0][0]               = z.real() + G;
    steps[1][1]               = -steps[0][0];
    limit[0][1] = limit[1][0] = G * std::sin(gamma);
    limit[0][0]               = G * (1 - std::cos(gamma));
    limit[1][1]               = -limit[0][0];
    check("steps, N = " + std::to_string(N), distance(p.stress(), steps), 1e-12 * G);
    const double error = distance(p.stress(), limit);
    check("limit, N = " + std::to_string(N), error, 2 * G * (std::exp(gamma * gamma / (2 * N)) - 1));
    if (before > 0)
      check_range("first order: ratio", before / error, 1.9, 2.1);
    before = error;
  }
}

/**
 * A quarter turn carries sigma_aa to sigma_bb. Each step stretches the deviator by (1 + 4 w^2 dt^2)^(1/2), so the
 * error after N steps is 2 (pi/2)^2 / N to leading order. Reversed spin leaves sigma_bb as well: the half-way
 * shear sigma_ab = +1/2 tells them apart.
 */
void constant_spin()
{
  for (unsigned int plane = 0; plane < 3; ++plane)
  {
    const unsigned int a = plane, b = (plane + 1) % 3;
    double             before = 0;
    for (const unsigned int N : {1000, 2000})
    {
      auto         p = point();
      Tensor<2, 3> L, start, half, end;
      L[b][a]     = numbers::PI / 2;
      L[a][b]     = -L[b][a];
      start[a][a] = 1;
      p.set_stress(start);
      for (unsigned int n = 0; n < N / 2; ++n)
        p.advance(L, 1. / N);
      half[a][a] = half[b][b] = half[a][b] = half[b][a] = 0.5;
      const std::string name = "plane " + std::to_string(plane) + ", N = " + std::to_string(N);
      check(name + ", 45 degrees", distance(p.stress(), half), 8. / N);
      for (unsigned int n = N / 2; n < N; ++n)
        p.advance(L, 1. / N);
      end[b][b]          = 1;
      const double error = distance(p.stress(), end);
      check(name + ", 90 degrees", error, 8. / N);
      if (before > 0)
        check_range("first order: ratio", before / error, 1.9, 2.1);
      before = error;
    }
  }
}

/** An isotropic law commutes with a fixed rotation of everything. */
void constant_rotation()
{
  const Tensor<2, 3> Q = rotation(0, 1, 0.7) * rotation(1, 2, -1.1) * rotation(2, 0, 2.3);
  const Tensor<2, 3> L = some_tensor(1), start = some_tensor(2) + transpose(some_tensor(2));
  auto               p = point(), q = point();
  p.set_stress(start);
  q.set_stress(Q * start * transpose(Q));
  for (unsigned int n = 0; n < 10; ++n)
  {
    p.advance(L, 0.02);
    q.advance(Q * L * transpose(Q), 0.02);
  }
  check("Q sigma Q^T", distance(Q * p.stress() * transpose(Q), q.stress()), 1e-13 * p.stress().norm());
}

/** A stretch seen from a spinning frame, L = R' R^T + R l R^T, gives R sigma R^T in the limit of small steps. */
void superposed_rotation()
{
  Tensor<2, 3> l; // a stretch without spin: its stress is exact
  l[0][0] = 0.3, l[1][1] = -0.1, l[0][1] = l[1][0] = 0.2, l[0][2] = l[2][0] = -0.15;
  double before = 0;
  for (const unsigned int N : {400, 800})
  {
    const double w = 1.3, dt = 1. / N;
    auto         rotating = point(), still = point();
    Tensor<2, 3> spin;
    spin[1][0] = w;
    spin[0][1] = -w;
    for (unsigned int n = 0; n < N; ++n)
    {
      const Tensor<2, 3> R = rotation(0, 1, w * (n + 0.5) * dt);
      rotating.advance(spin + R * l * transpose(R), dt);
      still.advance(l, dt);
    }
    const Tensor<2, 3> R        = rotation(0, 1, w);
    const Tensor<2, 3> expected = R * still.stress() * transpose(R);
    const double       error    = distance(rotating.stress(), expected);
    // Each step errs by w^2 dt^2 of the stress it turns, or by w dt of the increment that it has not turned yet.
    check("N = " + std::to_string(N), error, (2 * w * w + w) * dt * expected.norm());
    if (before > 0)
      check_range("first order: ratio", before / error, 1.9, 2.1);
    before = error;
  }
}

/** Central differences of the stress in the strain increment against lambda I I + 2 G; the law is linear in it. */
void tangent()
{
  const SymmetricTensor<4, 3> C =
    lambda * outer_product(unit_symmetric_tensor<3>(), unit_symmetric_tensor<3>()) + 2 * G * identity_tensor<3>();
  for (unsigned int i = 0; i < 3; ++i)
    for (unsigned int j = i; j < 3; ++j)
    {
      SymmetricTensor<2, 3> e;
      e[i][j]           = 1;
      const double step = 1e-3;
      auto         plus = point(), minus = point();
      plus.advance(Tensor<2, 3>(e), step);
      minus.advance(Tensor<2, 3>(e), -step);
      const Tensor<2, 3> slope = (plus.stress() - minus.stress()) / (2 * step);
      check("d sigma / d eps_" + std::to_string(i) + std::to_string(j), distance(slope, Tensor<2, 3>(C * e)),
            1e-12 * E);
    }
}

/** Energy 1/2 sigma : eps with eps = (1 + nu)/E sigma - nu/E tr(sigma) I; c^2 = (lambda + 2 G) / rho. */
void energy_and_wave_speed()
{
  auto                        p = point();
  const SymmetricTensor<2, 3> s = symmetrize(some_tensor(4));
  p.set_stress(Tensor<2, 3>(s));
  const SymmetricTensor<2, 3> e = (1 + nu) / E * s - nu / E * trace(s) * unit_symmetric_tensor<3>();
  check("energy density", p.strain_energy_density() - 0.5 * (s * e), 1e-14);
  p.mass   = 6;
  p.volume = 2;
  check("wave speed", p.wave_speed() - std::sqrt((lambda + 2 * G) / 3), 1e-14);
  check("rest stress ratio", p.material->rest_stress_ratio() - nu / (1 - nu), 1e-15);
}

/** In plane strain, where grad v stores four components, the stress is that of three dimensions, sigma_zz included. */
void plane_strain()
{
  Tensor<2, 3> L = some_tensor(3), start;
  for (unsigned int d = 0; d < 3; ++d)
    L[d][2] = L[2][d] = 0;
  start[0][0] = 1, start[1][1] = -2, start[2][2] = 0.5, start[0][1] = start[1][0] = 0.7;
  auto p = point(2), q = point(3);
  p.set_stress(start);
  q.set_stress(start);
  for (unsigned int n = 0; n < 10; ++n)
  {
    p.advance(L, 0.02);
    q.advance(L, 0.02);
  }
  check("2D and 3D", distance(p.stress(), q.stress()), 1e-14 * q.stress().norm());
  check_true("sigma_zz changes", std::abs(p.stress()[2][2] - 0.5) > 0.01);
}

void parameter_errors()
{
  const auto error = [](const std::string &name, const std::string &entry, const std::string &value,
                        const std::string &remedy) {
    check_error<EntryError>(name, {"/Materials/m", entry, remedy},
                            [&] { SinglePoint("linear elastic", set(entry, value), 3); });
  };
  error("nu = 0.5", "Poisson's ratio", "0.5", "Use 0.49");
  error("nu = -1", "Poisson's ratio", "-1", "between -1 and 0.5");
  error("negative density", "Density", "-1000", "must be positive");
  error("zero density", "Density", "0", "must be positive");
  error("negative stiffness", "Young's modulus", "-1", "must be positive");
  check_error<InputError>("stiffness is not a number", {"text:4", "Young's modulus", "'nan' is not a valid value"},
                          [] { SinglePoint("linear elastic", set("Young's modulus", "nan"), 3); });
}

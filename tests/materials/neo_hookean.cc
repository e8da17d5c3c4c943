#include "point.h"

using namespace Test;

namespace
{
  constexpr double lambda = 7 * 0.2 / (1.2 * 0.6), mu = 7 / 2.4;

  SinglePoint point(const unsigned int dim = 3)
  {
    return SinglePoint("neo-Hookean", set("Young's modulus", "7") + set("Poisson's ratio", "0.2"), dim);
  }

  const Tensor<2, 3> I(unit_symmetric_tensor<3>());

  Tensor<2, 3> stress_at(const Tensor<2, 3> &F, const unsigned int dim = 3)
  {
    auto p = point(dim);
    p.set_F(F);
    p.advance(Tensor<2, 3>(), 1.);
    return p.stress();
  }

  /** W per initial volume. */
  double energy_at(const Tensor<2, 3> &F)
  {
    auto p = point();
    p.set_F(F);
    return p.strain_energy_density() * determinant(F);
  }
} // namespace

namespace neo_hookean
{
  /** F = diag(a, 1, 1): sigma_xx = (lambda ln a + mu (a^2 - 1)) / a, sigma_yy = lambda ln a / a. */
  void uniaxial_strain()
  {
    for (const double a : {0.5, 0.9, 1., 1.3, 3.})
    {
      const double across = lambda * std::log(a) / a;
      check("stretch " + std::to_string(a),
            distance(stress_at(diagonal(a, 1, 1)), diagonal(across + mu * (a * a - 1) / a, across, across)), 1e-13);
    }
  }

  /** F_xy = g: sigma_xy = mu g, sigma_xx = mu g^2, nothing else. */
  void simple_shear()
  {
    Tensor<2, 3> F = I, expected;
    F[0][1]        = 0.8;
    expected[0][1] = expected[1][0] = mu * 0.8;
    expected[0][0]                  = mu * 0.64;
    check("stress", distance(stress_at(F), expected), 1e-14);
    check("the same in plane strain", distance(stress_at(F, 2), expected), 1e-14);
    F[0][1] = 0.8, F[1][1] = 1.7;
    check("2D and 3D", distance(stress_at(F, 2), stress_at(F, 3)), 1e-14);
  }

  /** J sigma F^-T = dW/dF by central differences. */
  void energy_and_stress()
  {
    const Tensor<2, 3> F        = I + 0.3 * some_tensor(1);
    const Tensor<2, 3> expected = determinant(F) * stress_at(F) * transpose(invert(F));
    const double       step     = 1e-5;
    Tensor<2, 3>       slope;
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = 0; j < 3; ++j)
      {
        Tensor<2, 3> plus = F, minus = F;
        plus[i][j] += step;
        minus[i][j] -= step;
        slope[i][j] = (energy_at(plus) - energy_at(minus)) / (2 * step);
      }
    check("dW/dF", distance(slope, expected), 1e-9 * expected.norm());
    check("no energy at rest", energy_at(I), 1e-15);
    check("none by rotation", energy_at(rotation(0, 1, 1.) * rotation(1, 2, 2.)), 1e-14);
  }

  void objectivity()
  {
    const Tensor<2, 3> F = I + 0.3 * some_tensor(1), Q = rotation(0, 1, 0.7) * rotation(1, 2, -1.1);
    check("Q sigma Q^T", distance(stress_at(Q * F), Q * stress_at(F) * transpose(Q)), 1e-13);
  }

  /**
   * Waves along the axis of a stretch a, rho c^2 = a^2 W''(a) / J, with W'(a) = P = J sigma_xx / a by central
   * differences; the law's speed is an upper bound of it, sharp at rest.
   */
  void wave_speed()
  {
    const auto exact = [](const double a, const double across) {
      const auto   P = [&](const double x) { return across * across * stress_at(diagonal(x, across, across))[0][0]; };
      const double step = 1e-5 * a;
      return std::sqrt(a * a * (P(a + step) - P(a - step)) / (2 * step)); // of a mass per initial volume of 1
    };
    const auto bound = [](const double a, const double across) {
      auto p = point();
      p.set_F(diagonal(a, across, across));
      p.volume = a * across * across;
      return p.wave_speed();
    };
    check("at rest", bound(1, 1) - exact(1, 1), 1e-9);
    check("at rest, closed form", bound(1, 1) - std::sqrt(lambda + 2 * mu), 1e-14);
    double least = 10;
    for (const double a : {0.3, 0.7, 1.1, 2., 5.})
      for (const double across : {0.4, 0.9, 1., 1.2, 2.})
        least = std::min(least, bound(a, across) / exact(a, across));
    check_range("bound over speed", least, 1 - 1e-9, 1.1);
  }
} // namespace neo_hookean

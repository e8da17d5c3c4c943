#include "point.h"

using namespace Test;

namespace
{
  constexpr double E = 700, nu = 0.2;
  constexpr double K = E / (3 * (1 - 2 * nu)), G = E / (2 * (1 + nu));

  struct Law
  {
    std::string                   hardening, entries;
    std::function<double(double)> strength; // of the equivalent plastic strain
  };

  const std::vector<Law> laws{{"perfect", "", [](const double) { return 3.; }},
                              {"linear", set("Hardening modulus", "50"), [](const double a) { return 3 + 50 * a; }},
                              {"exponential softening", set("Residual yield stress", "1") + set("Softening rate", "60"),
                               [](const double a) { return 1 + 2 * std::exp(-60 * a); }},
                              // nearly as fast as the stress can follow: 3 G / 2 = 437.5
                              {"exponential softening",
                               set("Residual yield stress", "1") + set("Softening rate", "437"),
                               [](const double a) { return 1 + 2 * std::exp(-437 * a); }}};

  SinglePoint point(const Law &law, const unsigned int dim = 3)
  {
    return SinglePoint("von Mises",
                       set("Young's modulus", "700") + set("Poisson's ratio", "0.2") + set("Yield stress", "3") +
                         set("Hardening", law.hardening) + law.entries,
                       dim);
  }

  std::string name(const Law &law) { return law.hardening + (law.entries.find("437") < 1000 ? " 437" : ""); }
} // namespace

namespace von_mises_test
{
  /**
   * Strain e along an axis: 2 G e - 3 G a = sigma_Y(a) once it yields, sigma = K e +- 2/3 sigma_Y along and
   * K e -+ 1/3 sigma_Y across, whatever the steps; then back, so far that it yields again with the other sign.
   */
  void uniaxial_strain()
  {
    for (const auto &law : laws)
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        auto         p = point(law);
        Tensor<2, 3> L;
        double       error = 0, e = 0, least_strain = 1, largest_elastic = 0;
        const auto   step = [&](const double rate) {
          L[axis][axis] = rate;
          p.advance(L, 1e-3);
          e += rate * 1e-3;
          const double q = 1.5 * (p.stress()[axis][axis] - K * e);
          for (unsigned int d = 0; d < 3; ++d)
            raise(error, p.stress()[d][d] - (K * e + (d == axis ? 2 : -1) * q / 3));
          return q;
        };
        for (unsigned int n = 0; n < 20; ++n)
        {
          const double q = step(1), a = p.states[0];
          if (2 * G * e > 3)
          {
            raise(error, q - law.strength(a));
            raise(error, 2 * G * e - 3 * G * a - law.strength(a));
            least_strain = std::min(least_strain, a);
          }
          else
            raise(largest_elastic, a);
        }
        const double top = 2 * G * e - 3 * G * p.states[0];
        raise(error, step(-1e-3) - (top - 2e-6 * G)); // elastic when it turns
        for (unsigned int n = 0; n < 30; ++n)
          step(-1);
        raise(error, step(-1) + law.strength(p.states[0]));
        check(name(law) + ", axis " + std::to_string(axis), error, 1e-11);
        check(name(law) + ", no plastic strain before", largest_elastic, 0.);
        check_true(name(law) + ", plastic strain after", least_strain > 0);
      }
  }

  /** Pure shear: sqrt(3) tau = sqrt(3) G gamma - 3 G a = sigma_Y(a). */
  void pure_shear()
  {
    for (const auto &law : laws)
    {
      auto         p = point(law);
      Tensor<2, 3> L;
      L[0][2] = L[2][0] = 0.5;
      double error      = 0;
      for (unsigned int n = 1; n <= 30; ++n)
      {
        p.advance(L, 1e-3);
        const double gamma = 1e-3 * n, a = p.states[0], tau = p.stress()[0][2];
        raise(error, std::sqrt(3.) * tau - (std::sqrt(3.) * G * gamma - 3 * G * a));
        if (std::sqrt(3.) * G * gamma > 3)
          raise(error, std::sqrt(3.) * tau - law.strength(a));
        raise(error, von_mises(p.stress()) - std::sqrt(3.) * tau);
      }
      check(name(law), error, 1e-11);
    }
  }

  /**
   * A wild path with ever smaller steps. The stress never leaves the yield surface outwards, and lies on it where the
   * plastic strain grows. What the return takes from the trial stress is 2 G times the increment of plastic strain: a
   * sums up sqrt(2/3) of its norm, and dissipates sigma_Y da >= 0.
   */
  void yield_surface_and_dissipation()
  {
    for (const auto &law : laws)
    {
      auto         p       = point(law);
      double       outside = 0, off = 0, strain = 0, dissipation = 0, least = 0;
      unsigned int n_plastic = 0, n_elastic = 0;
      for (unsigned int n = 0; n < 400; ++n)
      {
        // No spin: then the trial stress is known without the law.
        const Tensor<2, 3> A = some_tensor(0.37 * n), L = 0.5 * (A + transpose(A)), before = deviatoric(p.stress());
        const double       a = p.states[0], dt = 2e-3 * std::exp(-0.01 * n);
        p.advance(L, dt);
        const Tensor<2, 3> s = deviatoric(p.stress()), plastic = (before + 2 * G * dt * deviatoric(L) - s) / (2 * G);
        const double       da = p.states[0] - a, strength = law.strength(p.states[0]);
        raise(strain, std::sqrt(2. / 3.) * plastic.norm() - da);
        raise(dissipation, scalar_product(s, plastic) - strength * da);
        least   = std::min(least, da);
        outside = std::max(outside, von_mises(s) - strength);
        if (da > 1e-14)
          raise(off, von_mises(s) - strength);
        ++(da > 0 ? n_plastic : n_elastic);
      }
      check(name(law) + ", outside the surface", outside, 1e-12);
      check(name(law) + ", off the surface", off, 1e-12);
      check(name(law) + ", plastic strain", strain, 1e-14);
      check(name(law) + ", dissipation", dissipation, 1e-14);
      check(name(law) + ", strain that goes back", least, 0.);
      check_true(name(law) + ", both kinds of steps", n_plastic > 20 && n_elastic > 20);
    }
  }

  /** A strip pulled in plane strain with free sides bears 2/sqrt(3) of the yield stress, with sigma_zz half of it. */
  void plane_strain_limit()
  {
    auto         p = point(laws[0], 2);
    Tensor<2, 3> L;
    L[1][1] = 1;
    for (unsigned int n = 0; n < 200; ++n)
      advance_with_lateral_stress(p, L, 5e-4, 0.);
    const double limit = 3 * 2 / std::sqrt(3.);
    check("limit", distance(p.stress(), diagonal(0, limit, limit / 2)), 1e-6);
    check("flow keeps the volume: rates", L[0][0] + L[1][1], 1e-6);
  }

  void plane_strain()
  {
    for (const auto &law : laws)
    {
      auto p = point(law, 2), q = point(law, 3);
      for (unsigned int n = 0; n < 40; ++n)
      {
        const Tensor<2, 3> L = some_tensor(0.2 * n, 2);
        p.advance(L, 1e-3);
        q.advance(L, 1e-3);
      }
      check(name(law) + ", 2D and 3D", distance(p.stress(), q.stress()) + std::abs(p.states[0] - q.states[0]), 1e-13);
      check_true(name(law) + ", sigma_zz and plastic strain", std::abs(p.stress()[2][2]) > 0.1 && p.states[0] > 1e-3);
    }
  }

  void parameter_errors()
  {
    const auto error = [](const std::string &entry, const std::string &value, const std::string &remedy,
                          const std::string &more = "") {
      check_error<EntryError>(entry + " = " + value, {"/Materials/m: " + entry, remedy},
                              [&] { SinglePoint("von Mises", set(entry, value) + more, 3); });
    };
    const std::string softening = set("Hardening", "exponential softening");
    error("Yield stress", "0", "Use 'linear elastic'");
    error("Yield stress", "-1", "must be positive");
    error("Hardening modulus", "-1", "Use 'Hardening = exponential softening'", set("Hardening", "linear"));
    error("Residual yield stress", "-1", "between 0 and the yield stress", softening);
    error("Residual yield stress", "2", "between 0 and the yield stress", softening + set("Yield stress", "1"));
    error("Softening rate", "0", "Use 'Hardening = perfect'", softening);
    // 3 G = 3 * 1e6 / 2.6 over 1000
    error("Softening rate", "1154", "Lower it below 1153.8", softening);
    error("Poisson's ratio", "0.5", "Use 0.49");
    check_error<InputError>("unknown hardening", {"text:4", "Hardening", "'cubic'"},
                            [] { SinglePoint("von Mises", set("Hardening", "cubic"), 3); });
  }
} // namespace von_mises_test

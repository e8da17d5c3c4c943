#include "point.h"

#include <talus/materials/drucker_prager.h>

using namespace Test;

namespace
{
  constexpr double E = 700, nu = 0.2;
  constexpr double K = E / (3 * (1 - 2 * nu)), G = E / (2 * (1 + nu));

  /** Eq. (72), written out once more. */
  double slope(const double degrees)
  {
    const double t = std::tan(degrees * numbers::PI / 180);
    return t / std::sqrt(9 + 12 * t * t);
  }

  struct Sand : SinglePoint
  {
    Sand(const double phi, const double psi, const double c, const unsigned int dim = 3) :
      SinglePoint("Drucker-Prager",
                  set("Young's modulus", "700") + set("Poisson's ratio", "0.2") +
                    set("Friction angle", std::to_string(phi)) + set("Dilatancy angle", std::to_string(psi)) +
                    set("Cohesion", std::to_string(c)),
                  dim),
      alpha(slope(phi)), beta(slope(psi)),
      kappa(3 * c / std::sqrt(9 + 12 * std::pow(std::tan(phi * numbers::PI / 180), 2)))
    {
    }
    double I1() const { return trace(stress()); }
    double sqrt_J2() const { return deviatoric(stress()).norm() / std::sqrt(2.); }
    double F() const { return sqrt_J2() + alpha * I1() - kappa; }

    const double alpha, beta, kappa;
  };

  Tensor<2, 3> pressure(const double p) { return -p * Tensor<2, 3>(unit_symmetric_tensor<3>()); }
} // namespace

namespace drucker_prager
{
  /** Compression e along an axis: dlambda = F / (G + 9 K alpha beta) with sqrt(J2) = 2/sqrt(3) G e, I1 = -3 K e. */
  void uniaxial_strain()
  {
    for (const double psi : {0., 15., 25.})
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        Sand         p(25, psi, 0.3);
        Tensor<2, 3> L;
        L[axis][axis] = -1;
        double error = 0, strain = 0;
        for (unsigned int n = 1; n <= 30; ++n)
        {
          p.advance(L, 1e-3);
          const double e = 1e-3 * n, F = 2 / std::sqrt(3.) * G * e - 3 * K * p.alpha * e - p.kappa;
          const double lambda = std::max(0., F / (G + 9 * K * p.alpha * p.beta));
          const double axial  = -4. / 3. * G * e + 2 / std::sqrt(3.) * G * lambda,
                       mean   = -K * e - 3 * K * p.beta * lambda;
          for (unsigned int d = 0; d < 3; ++d)
            raise(error, p.stress()[d][d] - (mean + (d == axis ? 1 : -0.5) * axial));
          raise(strain, p.states[0] - lambda / std::sqrt(3.));
          raise(strain, p.states[1] - 3 * p.beta * lambda);
        }
        const std::string name = "psi = " + std::to_string(psi) + ", axis " + std::to_string(axis);
        check(name + ", stress", error, 1e-12);
        check(name + ", plastic strains", strain, 1e-14);
        check_true(name + ", yields", p.states[0] > 1e-3);
      }
  }

  /** Pure shear at a pressure: sqrt(J2) = tau = G (gamma - dlambda), I1 = -3 p - 9 K beta dlambda, no more than F = 0.
   */
  void pure_shear()
  {
    for (const double psi : {0., 20.})
    {
      Sand         p(35, psi, 0.1);
      Tensor<2, 3> L;
      L[1][2] = L[2][1] = 0.5;
      p.set_stress(pressure(2));
      double error = 0;
      for (unsigned int n = 1; n <= 30; ++n)
      {
        p.advance(L, 1e-3);
        const double trial  = G * 1e-3 * n;
        const double lambda = std::max(0., (trial - 6 * p.alpha - p.kappa) / (G + 9 * K * p.alpha * p.beta));
        raise(error, p.stress()[1][2] - (trial - G * lambda));
        raise(error, p.I1() + 6 + 9 * K * p.beta * lambda);
        raise(error, p.sqrt_J2() - p.stress()[1][2]);
      }
      check("psi = " + std::to_string(psi), error, 1e-12);
      check("psi = " + std::to_string(psi) + ", F", p.F(), 1e-13);
    }
  }

  /**
   * One step from wild trial stresses: none comes to lie outside the cone, no deviator turns round, the flow is that of
   * Eq. (73) on the cone, the apex is where it should be, and all three kinds of lanes occur.
   */
  void returns()
  {
    for (const double psi : {0., 10., 35.})
    {
      double       outside = 0, turned = 0, flow = 0, apex = 0, strain = 0;
      unsigned int n_elastic = 0, n_cone = 0, n_apex = 0;
      for (unsigned int n = 0; n < 2000; ++n)
      {
        Sand               p(35, psi, 0.5);
        const Tensor<2, 3> A     = some_tensor(0.37 * n);
        const Tensor<2, 3> trial = A + transpose(A) + pressure(3 * std::sin(0.71 * n));
        p.set_stress(trial);
        p.advance(Tensor<2, 3>(), 1.);
        const Tensor<2, 3> s = deviatoric(p.stress()), s_trial = deviatoric(trial);
        const double       J = s_trial.norm() / std::sqrt(2.), I1 = trace(trial);
        outside = std::max(outside, p.F());
        raise(strain, p.states[1] - (I1 - p.I1()) / (3 * K));
        raise(strain, p.states[0] - std::sqrt(2. / 3.) * (s_trial - s).norm() / (2 * G));
        turned = std::min(turned, scalar_product(s, s_trial));
        if (J + p.alpha * I1 - p.kappa <= 0)
        {
          ++n_elastic;
          raise(flow, distance(p.stress(), trial));
        }
        else if (p.sqrt_J2() > 1e-12)
        {
          ++n_cone;
          // along -(G s / sqrt(J2) + 3 K beta I)
          raise(flow, distance(s, p.sqrt_J2() / J * s_trial));
          raise(flow, (I1 - p.I1()) * G - (J - p.sqrt_J2()) * 9 * K * p.beta);
          raise(flow, p.F());
        }
        else
        {
          ++n_apex;
          raise(apex, distance(p.stress(), pressure(-p.kappa / p.alpha / 3)));
          // The cone's return would go beyond: G dlambda > sqrt(J2).
          apex = std::max(apex, J / G - (J + p.alpha * I1 - p.kappa) / (G + 9 * K * p.alpha * p.beta));
        }
      }
      const std::string name = "psi = " + std::to_string(psi) + ", ";
      check(name + "outside the cone", outside, 1e-14);
      check(name + "turned deviator", turned, 1e-14);
      check(name + "flow", flow, 1e-12);
      check(name + "apex", apex, 1e-14);
      check(name + "plastic strains", strain, 1e-16);
      check_true(name + "elastic, cone and apex occur", n_elastic > 100 && n_cone > 100 && n_apex > 100);
    }
  }

  /** Tension on all sides, where sqrt(J2) = 0: the apex; without cohesion no stress at all. */
  void tension()
  {
    Sand dry(35, 0, 0), moist(35, 20, 0.5);
    for (Sand *p : {&dry, &moist})
    {
      p->advance(diagonal(1, 1, 1), 1e-2);
      check("stress", distance(p->stress(), pressure(-p->kappa / p->alpha / 3)), 1e-14);
      check("volumetric plastic strain", p->states[1] - (3e-2 - p->kappa / p->alpha / (3 * K)), 1e-15);
      check("no equivalent plastic strain", p->states[0], 1e-16);
    }
  }

  /** Without friction there is no apex: the law of von Mises with the yield stress sqrt(3) c, Eq. (67). */
  void no_friction()
  {
    Sand        p(0, 0, 2);
    SinglePoint q(
      "von Mises",
      set("Young's modulus", "700") + set("Poisson's ratio", "0.2") + set("Yield stress", "3.4641016151377544"), 3);
    double error = 0, strain = 0;
    for (unsigned int n = 0; n < 200; ++n)
    {
      const Tensor<2, 3> L = some_tensor(0.37 * n) + diagonal(1, 1, 1);
      p.advance(L, 2e-3);
      q.advance(L, 2e-3);
      raise(error, distance(p.stress(), q.stress()));
      raise(strain, p.states[0] - q.states[0]);
    }
    check("stress", error, 1e-11);
    check("equivalent plastic strain", strain, 1e-13);
    check_true("it yields", p.states[0] > 0.1);
  }

  /**
   * A sample squeezed in plane strain at a constant lateral stress. At the limit all strain is plastic, sigma_zz adapts
   * to s_zz = -2 beta sqrt(J2), and sin phi_m = (s1 - s3) / (s1 + s3) = 3 alpha sqrt(1 - 3 beta^2) / (1 - 3 alpha
   * beta): for psi = 0 it is 3 alpha, for psi = phi sin phi. The rates have the dilatancy ratio sin psi.
   */
  void biaxial_test()
  {
    for (const double psi : {0., 10., 35.})
    {
      Sand         p(35, psi, 0, 2);
      Tensor<2, 3> L;
      L[1][1] = -1;
      p.set_stress(pressure(0.1));
      for (unsigned int n = 0; n < 400; ++n)
        advance_with_lateral_stress(p, L, 2e-5, -0.1);
      const double      s3 = -p.stress()[0][0], s1 = -p.stress()[1][1];
      const double      expected = 3 * p.alpha * std::sqrt(1 - 3 * p.beta * p.beta) / (1 - 3 * p.alpha * p.beta);
      const std::string name     = "psi = " + std::to_string(psi) + ", ";
      check(name + "lateral stress", s3 - 0.1, 1e-12);
      check(name + "mobilised friction", (s1 - s3) / (s1 + s3) - expected, 1e-6);
      check(name + "dilatancy", (L[0][0] + L[1][1]) / (L[0][0] - L[1][1]) - std::sin(psi * numbers::PI / 180), 1e-5);
      if (psi == 0)
      {
        check("3 alpha", (s1 - s3) / (s1 + s3) - 0.5444972468, 1e-6);
        check("no plastic volume", p.states[1], 1e-16);
      }
      if (psi == 35)
        check("sin phi", (s1 - s3) / (s1 + s3) - std::sin(35 * numbers::PI / 180), 1e-6);
    }
  }

  void plane_strain()
  {
    Sand p(35, 10, 0.1, 2), q(35, 10, 0.1, 3);
    p.set_stress(pressure(1));
    q.set_stress(pressure(1));
    for (unsigned int n = 0; n < 40; ++n)
    {
      const Tensor<2, 3> L = some_tensor(0.2 * n, 2);
      p.advance(L, 1e-3);
      q.advance(L, 1e-3);
    }
    check("2D and 3D", distance(p.stress(), q.stress()) + std::abs(p.states[0] - q.states[0]), 1e-13);
    check_true("it yields", p.states[0] > 1e-3);
  }

  void parameter_errors()
  {
    const auto error = [](const std::string &entry, const std::string &value, const std::string &remedy,
                          const std::string &more = "") {
      check_error<EntryError>(entry + " = " + value, {"/Materials/m: " + entry, remedy},
                              [&] { SinglePoint("Drucker-Prager", set(entry, value) + more, 3); });
    };
    error("Friction angle", "-1", "between 0 and 90");
    error("Friction angle", "90", "between 0 and 90");
    error("Dilatancy angle", "-1", "must not be negative");
    error("Dilatancy angle", "36", "must not exceed the friction angle", set("Friction angle", "35"));
    error("Cohesion", "-1", "must not be negative");
    error("Cohesion", "0", "Give one of them", set("Friction angle", "0"));
    error("Density", "0", "must be positive");
  }
} // namespace drucker_prager

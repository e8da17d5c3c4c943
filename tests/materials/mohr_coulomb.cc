#include "mohr_coulomb.h"

namespace mohr_coulomb
{
  /** Compression e along an axis: the two others are equal, so that two faces are active. */
  void uniaxial_compression()
  {
    for (const double psi : {0., 15., 25.})
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        Soil         p(25, psi, 0.3);
        Tensor<2, 3> L;
        L[axis][axis] = -1;
        double error = 0, strain = 0;
        for (unsigned int n = 1; n <= 30; ++n)
        {
          p.advance(L, 1e-3);
          const double e = 1e-3 * n, s = p.s, d = p.d;
          const double f = -(1 + s) * lambda * e + (1 - s) * (lambda + 2 * G) * e - p.twice_c;
          const double factor =
            std::max(0., f / (8 * lambda * s * d + 4 * G * (1 + s * d) + 2 * G * (1 - s) * (1 - d)));
          const double axial = -(lambda + 2 * G) * e - 4 * lambda * d * factor + 4 * G * (1 - d) * factor,
                       side  = -lambda * e - 4 * lambda * d * factor - 2 * G * (1 + d) * factor;
          for (unsigned int i = 0; i < 3; ++i)
            raise(error, p.stress()[i][i] - (i == axis ? axial : side));
          raise(strain, p.states[1] - 4 * d * factor);
          // The deviator of (1 + d, 1 + d, -2 (1 - d)) is (1, 1, -2) (1 - d/3 ...): written out by its parts.
          const double mean = 4 * d / 3, a = 1 + d - mean, b = -2 * (1 - d) - mean;
          raise(strain, p.states[0] - factor * std::sqrt(2. / 3. * (2 * a * a + b * b)));
        }
        const std::string name = "psi = " + std::to_string(psi) + ", axis " + std::to_string(axis);
        check(name + ", stress", error, 1e-12);
        check(name + ", plastic strains", strain, 1e-14);
        check_true(name + ", yields", p.states[0] > 1e-3);
      }
  }

  /** Extension under pressure: the other edge. */
  void uniaxial_extension()
  {
    for (const double psi : {0., 10., 30.})
    {
      Soil         p(30, psi, 0.2);
      Tensor<2, 3> L;
      L[1][1] = 1;
      p.set_stress(pressure(8));
      double error = 0;
      for (unsigned int n = 1; n <= 20; ++n)
      {
        p.advance(L, 5e-4);
        const double e = 5e-4 * n, s = p.s, d = p.d;
        const double f      = (1 + s) * (-8 + (lambda + 2 * G) * e) - (1 - s) * (-8 + lambda * e) - p.twice_c;
        const double factor = std::max(0., f / (8 * lambda * s * d + 4 * G * (1 + s * d) + 2 * G * (1 + s) * (1 + d)));
        raise(error,
              p.stress()[1][1] - (-8 + (lambda + 2 * G) * e - 4 * lambda * d * factor - 4 * G * (1 + d) * factor));
        raise(error, p.stress()[0][0] - (-8 + lambda * e - 4 * lambda * d * factor + 2 * G * (1 - d) * factor));
        raise(error, p.stress()[2][2] - p.stress()[0][0]);
      }
      check("psi = " + std::to_string(psi), error, 1e-12);
      check_true("yields", p.states[0] > 1e-3);
    }
  }

  /** Pure shear at a pressure: one face, tau = G (gamma - 2 Delta lambda), and the middle stress follows by lambda. */
  void pure_shear()
  {
    for (const double psi : {0., 20.})
    {
      Soil         p(35, psi, 0.1);
      Tensor<2, 3> L;
      L[1][2] = L[2][1] = 0.5;
      p.set_stress(pressure(2));
      double error = 0;
      for (unsigned int n = 1; n <= 30; ++n)
      {
        p.advance(L, 1e-3);
        const double trial = G * 1e-3 * n;
        const double factor =
          std::max(0., (2 * trial - 4 * p.s - p.twice_c) / (4 * lambda * p.s * p.d + 4 * G * (1 + p.s * p.d)));
        raise(error, p.stress()[1][2] - (trial - 2 * G * factor));
        raise(error, p.stress()[1][1] - (-2 - 2 * (lambda + G) * p.d * factor));
        raise(error, p.stress()[2][2] - p.stress()[1][1]);
        raise(error, p.stress()[0][0] - (-2 - 2 * lambda * p.d * factor));
      }
      check("psi = " + std::to_string(psi), error, 1e-12);
      // In principal stresses: sigma_m sin phi + tau = c cos phi.
      check("psi = " + std::to_string(psi) + ", F", p.stress()[1][1] * p.s + p.stress()[1][2] - 0.5 * p.twice_c, 1e-13);
    }
  }

  /** A sample squeezed in plane strain: sin phi is mobilised and the dilatancy is sin psi, whatever they are. */
  void biaxial_test()
  {
    for (const double psi : {0., 10., 35.})
    {
      Soil         p(35, psi, 0, "", 2);
      Tensor<2, 3> L;
      L[1][1] = -1;
      p.set_stress(pressure(0.1));
      for (unsigned int n = 0; n < 400; ++n)
        advance_with_lateral_stress(p, L, 2e-5, -0.1);
      const double      s3 = -p.stress()[0][0], s1 = -p.stress()[1][1];
      const std::string name = "psi = " + std::to_string(psi) + ", ";
      check(name + "lateral stress", s3 - 0.1, 1e-12);
      check(name + "mobilised friction", (s1 - s3) / (s1 + s3) - p.s, 1e-12);
      check(name + "dilatancy", (L[0][0] + L[1][1]) / (L[0][0] - L[1][1]) - p.d, 1e-10);
    }
  }

  /** Cohesion and angles between peak and residual: a step in pure shear stands at the strength of its start. */
  void softening()
  {
    Soil         p(30, 10, 1,
                   set("Residual friction angle", "20") + set("Residual dilatancy angle", "0") +
                     set("Residual cohesion", "0.2") + set("Softening strain", "0.02"));
    Tensor<2, 3> L;
    L[0][1] = L[1][0] = 0.5;
    p.set_stress(pressure(3));
    double error = 0;
    for (unsigned int n = 0; n < 60; ++n)
    {
      const double share = std::min(p.states[0] / 0.02, 1.), before = p.states[0];
      const double s = p.s + (std::sin(radians(20)) - p.s) * share, c = 1 - 0.8 * share;
      p.advance(L, 1e-3);
      if (p.states[0] > before)
        raise(error, p.stress()[0][0] * s + p.stress()[0][1] - c * std::sqrt(1 - s * s));
    }
    check("strength", error, 1e-12);
    check_true("down to the residual", p.states[0] > 0.021);
    check("residual strength",
          p.stress()[0][1] - (0.2 * std::cos(radians(20)) - p.stress()[0][0] * std::sin(radians(20))), 1e-12);
  }

  /** No step gives back more than it takes: sigma : d is never less than the growth of the elastic energy. */
  void dissipation()
  {
    for (const double psi : {0., 30.})
    {
      Soil   p(30, psi, 0.3, set("Tension strength", "0.1"));
      double least = 0;
      for (unsigned int n = 0; n < 2000; ++n)
      {
        const Tensor<2, 3> L =
          some_tensor(0.31 * n) + transpose(some_tensor(0.31 * n)) + diagonal(1, 1, 1) * std::sin(0.05 * n);
        const double       before = p.strain_energy_density();
        const Tensor<2, 3> first  = p.stress();
        p.advance(L, 1e-3);
        // The plastic strain works at the stress of the end: sigma : d of backward differences.
        least = std::min(least, 1e-3 * scalar_product(p.stress(), L) - (p.strain_energy_density() - before) +
                                  0.5 * (p.stress() - first).norm_square() / (2 * G));
      }
      check("psi = " + std::to_string(psi), least, 1e-12);
      check_true("it yields", p.states[0] > 0.01);
    }
  }

  void plane_strain()
  {
    Soil p(35, 10, 0.1, "", 2), q(35, 10, 0.1, "", 3);
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
                              [&] { SinglePoint("Mohr-Coulomb", set(entry, value) + more, 3); });
    };
    error("Friction angle", "-1", "between 0 and 90");
    error("Friction angle", "90", "between 0 and 90");
    error("Dilatancy angle", "-1", "must not be negative");
    error("Dilatancy angle", "36", "must not exceed the friction angle", set("Friction angle", "35"));
    error("Cohesion", "-1", "must not be negative");
    error("Cohesion", "0", "Give one of them", set("Friction angle", "0"));
    error("Residual friction angle", "90", "between 0 and 90");
    error("Residual dilatancy angle", "12", "must not exceed the friction angle", set("Residual friction angle", "10"));
    error("Softening strain", "0", "must be positive");
  }
} // namespace mohr_coulomb

#include "point.h"

#include <algorithm>

using namespace Test;

namespace mohr_coulomb
{
  namespace
  {
    constexpr double E = 700, nu = 0.2;
    constexpr double K = E / (3 * (1 - 2 * nu)), G = E / (2 * (1 + nu)), lambda = K - 2. / 3. * G;

    double radians(const double degrees) { return degrees * numbers::PI / 180; }

    struct Soil : SinglePoint
    {
      Soil(const double phi, const double psi, const double c, const std::string &more = "",
           const unsigned int dim = 3) :
        SinglePoint("Mohr-Coulomb",
                    set("Young's modulus", "700") + set("Poisson's ratio", "0.2") +
                      set("Friction angle", std::to_string(phi)) + set("Dilatancy angle", std::to_string(psi)) +
                      set("Cohesion", std::to_string(c)) + more,
                    dim),
        s(std::sin(radians(phi))), d(std::sin(radians(psi))), twice_c(2 * c * std::cos(radians(phi)))
      {
      }

      /** F of the principal stresses of a tensor that is diagonal. */
      double face(const unsigned int i, const unsigned int j) const
      {
        return (1 + s) * stress()[i][i] - (1 - s) * stress()[j][j] - twice_c;
      }

      const double s, d, twice_c; // sin phi, sin psi, 2 c cos phi
    };

    Tensor<2, 3> pressure(const double p) { return -p * Tensor<2, 3>(unit_symmetric_tensor<3>()); }

    /** The plastic strain that takes a trial stress to another: D^-1 of the difference, both diagonal. */
    Tensor<1, 3> plastic_strain(const Tensor<2, 3> &trial, const Tensor<2, 3> &stress)
    {
      const Tensor<2, 3> difference = trial - stress;
      Tensor<1, 3>       e;
      for (unsigned int i = 0; i < 3; ++i)
        e[i] = difference[i][i] / (2 * G) - lambda / (2 * G * (3 * lambda + 2 * G)) * trace(difference);
      return e;
    }

    /**
     * How far `e` is from the cone of the directions: the least residual over all subsets of up to three that take part
     * with factors that are not negative. An independent check of a return: it knows nothing of planes, edges and
     * points.
     */
    double distance_to_cone(const Tensor<1, 3> &e, const std::vector<Tensor<1, 3>> &directions)
    {
      double             least = e.norm();
      const unsigned int n     = directions.size();
      for (unsigned int set = 1; set < 1u << n; ++set)
      {
        std::vector<Tensor<1, 3>> basis;
        for (unsigned int i = 0; i < n; ++i)
          if (set >> i & 1)
            basis.push_back(directions[i]);
        if (basis.size() > 3)
          continue;
        // The normal equations, filled up to three by ones.
        Tensor<2, 3> A = unit_symmetric_tensor<3>();
        Tensor<1, 3> b;
        for (unsigned int i = 0; i < basis.size(); ++i)
        {
          for (unsigned int j = 0; j < basis.size(); ++j)
            A[i][j] = basis[i] * basis[j];
          b[i] = basis[i] * e;
        }
        if (std::abs(determinant(A)) < 1e-12)
          continue;
        const Tensor<1, 3> factor = invert(A) * b;
        Tensor<1, 3>       rest   = e;
        bool               is_in  = true;
        for (unsigned int i = 0; i < basis.size(); ++i)
        {
          rest -= factor[i] * basis[i];
          is_in = is_in && factor[i] > -1e-12;
        }
        if (is_in)
          least = std::min(least, rest.norm());
      }
      return least;
    }
  } // namespace

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

  /** All kinds of returns from wild trial stresses: on the surface, by a plastic strain of the active faces. */
  void returns()
  {
    for (const double phi : {0., 20., 40.})
      for (const double share : {0., 0.3, 1.})
        for (const std::string tension : {"-1", "0", "0.05", "0.4"})
        {
          double       outside = 0, flow = 0, states = 0;
          unsigned int n_active[4] = {};
          Soil         p(phi, share * phi, 0.5, set("Tension strength", tension));
          for (unsigned int n = 0; n < 1000; ++n)
          {
            p.states.fill(0.);
            const double size = 1 + 3 * std::abs(std::sin(0.11 * n));
            Tensor<2, 3> trial =
              diagonal(size * std::sin(2.3 * n), size * std::sin(5.1 * n + 1), size * std::sin(7.7 * n + 2)) +
              pressure(2 * std::sin(0.71 * n));
            if (n % 5 == 0) // on the edges too
              trial[1][1] = trial[0][0];
            p.set_stress(trial);
            p.advance(Tensor<2, 3>(), 1.);
            const double limit =
              std::min(std::stod(tension) < 0 ? 1e300 : std::stod(tension), p.s > 0 ? p.twice_c / (2 * p.s) : 1e300);
            std::vector<Tensor<1, 3>> directions;
            for (unsigned int i = 0; i < 3; ++i)
              for (unsigned int j = 0; j < 3; ++j)
                if (i == j ? p.stress()[i][i] > limit - 1e-9 : p.face(i, j) > -1e-9)
                {
                  Tensor<1, 3> direction;
                  direction[i] = i == j ? 1. : 1 + p.d;
                  if (i != j)
                    direction[j] = -(1 - p.d);
                  directions.push_back(direction);
                }
            for (unsigned int i = 0; i < 3; ++i)
              for (unsigned int j = 0; j < 3; ++j)
                outside = std::max(outside, i == j ? p.stress()[i][i] - limit : p.face(i, j));
            const auto e = plastic_strain(trial, p.stress());
            flow         = std::max(flow, distance_to_cone(e, directions));
            raise(states, p.states[1] - (e[0] + e[1] + e[2]));
            raise(states, p.states[0] - std::sqrt(2. / 3.) * deviatoric(diagonal(e[0], e[1], e[2])).norm());
            ++n_active[std::min<std::size_t>(directions.size(), 3)];
          }
          const std::string name =
            "phi " + std::to_string(phi) + ", psi " + std::to_string(share * phi) + ", tension " + tension;
          check(name + ": outside", outside, 1e-13);
          check(name + ": flow", flow, 1e-13);
          check(name + ": states", states, 1e-14);
          check_true(name + ": inside, faces, edges and points",
                     n_active[0] > 10 && n_active[1] > 30 && n_active[2] > 30 && (phi == 0 || n_active[3] > 10));
        }
  }

  /** Tension on all sides: the apex, or the limit. */
  void tension()
  {
    Soil         dry(35, 0, 0), moist(35, 20, 0.5), weak(35, 20, 0.5, set("Tension strength", "0.1"));
    const double stresses[] = {0, 0.5 / std::tan(radians(35)), 0.1};
    unsigned int i          = 0;
    for (Soil *p : {&dry, &moist, &weak})
    {
      p->advance(diagonal(1, 1, 1), 1e-2);
      check("stress", distance(p->stress(), pressure(-stresses[i])), 1e-13);
      check("volumetric plastic strain", p->states[1] - (3e-2 - stresses[i] / K), 1e-15);
      check("no equivalent plastic strain", p->states[0], 1e-15);
      ++i;
    }
  }

  /** Without friction: the greatest shear stress is c (Tresca), whatever the middle stress. */
  void no_friction()
  {
    Soil   p(0, 0, 2);
    double shear = 0;
    for (unsigned int n = 0; n < 200; ++n)
    {
      p.advance(some_tensor(0.37 * n) + diagonal(1, 1, 1), 2e-3);
      SymmetricTensor<2, 3> stress = symmetrize(p.stress());
      const auto            values = eigenvectors(stress, SymmetricTensorEigenvectorMethod::jacobi);
      shear                        = std::max(shear, (values[0].first - values[2].first) / 2);
    }
    check("greatest shear stress", shear - 2, 1e-12);
    check("no plastic volume", p.states[1], 1e-14);
    check_true("it yields", p.states[0] > 0.1);
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

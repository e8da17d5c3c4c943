#include "point.h"

#include <talus/materials/drucker_prager.h>

using namespace Test;

namespace
{
  constexpr double gap_E = 700, gap_nu = 0.2;
  constexpr double gap_K = gap_E / (3 * (1 - 2 * gap_nu)), gap_G = gap_E / (2 * (1 + gap_nu));

  struct LooseSand : SinglePoint
  {
    LooseSand(const double psi, const double c, const unsigned int dim = 3, const bool remembers = true) :
      SinglePoint("Drucker-Prager",
                  set("Young's modulus", "700") + set("Poisson's ratio", "0.2") + set("Friction angle", "35") +
                    set("Dilatancy angle", std::to_string(psi)) + set("Cohesion", std::to_string(c)) +
                    set("Remember loosening", remembers ? "true" : "false"),
                  dim),
      law(dynamic_cast<const DruckerPrager &>(*material))
    {
    }
    double I1() const { return trace(stress()); }
    double F() const { return deviatoric(stress()).norm() / std::sqrt(2.) + law.alpha() * I1() - law.kappa(); }
    double gap() const { return states[2]; }

    /** n steps of the rate of deformation L, `increment` of it each. */
    void advance_by(const Tensor<2, 3> &L, const double increment, const unsigned int n)
    {
      for (unsigned int k = 0; k < n; ++k)
        advance(L, increment);
    }

    const DruckerPrager &law;
  };

  Tensor<2, 3> isotropic(const double p) { return p * Tensor<2, 3>(unit_symmetric_tensor<3>()); }
} // namespace

namespace gap
{
  /** Opened by 10 %, closed again, then compressed by e: uniaxial strain of sand that was never loose. */
  void uniaxial_strain()
  {
    for (const unsigned int dim : {2, 3})
      for (unsigned int axis = 0; axis < dim; ++axis)
      {
        LooseSand    p(0, 0, dim);
        Tensor<2, 3> L;
        L[axis][axis] = 1;
        p.advance_by(L, 1e-3, 100);
        check("stress of loose sand", p.stress().norm(), 1e-13);
        check("gap", p.gap() - 0.1, 1e-15);
        p.advance_by(-L, 1e-3, 60);
        check("stress while it closes", p.stress().norm(), 1e-13);
        check("gap that is left", p.gap() - 0.04, 1e-15);
        p.advance_by(-L, 1e-3, 39);
        check("stress just before it is closed", p.stress().norm(), 1e-13);
        p.advance_by(-L, 1e-3, 31); // 30 beyond
        const double e = 0.03, lambda = (2 / std::sqrt(3.) * gap_G - 3 * gap_K * p.law.alpha()) * e / gap_G;
        const double axial = -4. / 3. * gap_G * e + 2 / std::sqrt(3.) * gap_G * lambda;
        Tensor<2, 3> expected;
        for (unsigned int d = 0; d < 3; ++d)
          expected[d][d] = -gap_K * e + (d == axis ? 1 : -0.5) * axial;
        check(std::to_string(dim) + "D, axis " + std::to_string(axis), distance(p.stress(), expected), 2e-12);
        check("closed", p.gap(), 0.);
        check("volumetric plastic strain", p.states[1], 1e-15);
      }
  }

  /** With cohesion the apex bears tension: it unloads elastically, the gap closes at I1 = 0, where shear is borne. */
  void cohesive()
  {
    LooseSand    p(20, 0.5);
    const double apex = p.law.kappa() / p.law.alpha() / 3, opened = 0.03 - apex / gap_K; // mean stress, gap
    p.advance_by(diagonal(1, 1, 1), 1e-3, 10);
    check("apex", distance(p.stress(), isotropic(apex)), 1e-12);
    check("gap", p.gap() - opened, 1e-15);
    p.advance(diagonal(-1, -1, -1), apex / gap_K / 6);
    check("unloads", distance(p.stress(), isotropic(apex / 2)), 1e-12);
    check("its gap stays", p.gap() - opened, 1e-15);
    p.advance(diagonal(1, 1, 1), apex / gap_K / 6);
    check("loads again", distance(p.stress(), isotropic(apex)), 1e-12);
    p.advance(diagonal(-1, -1, -1), apex / gap_K / 3 + 0.002);
    check("closes without pressure", p.stress().norm(), 1e-12);
    check("gap that is left", p.gap() - opened + 0.006, 1e-15);
    Tensor<2, 3> shear;
    shear[1][2] = shear[2][1] = 0.5;
    p.advance(shear, 0.6 * p.law.kappa() / gap_G);
    check("bears shear", p.stress()[1][2] - 0.6 * p.law.kappa(), 1e-13);
    p.advance(shear, 0.6 * p.law.kappa() / gap_G);
    check("up to the cohesion", p.stress()[1][2] - p.law.kappa(), 1e-13);
    check("no mean stress", p.I1(), 1e-12);
    // What it dilates meanwhile takes up the gap.
    const double left = opened - 0.006 - 3 * p.law.beta() * 0.2 * p.law.kappa() / gap_G;
    check("dilation fills the gap", p.gap() - left, 1e-15);
    p.advance(diagonal(-1, -1, -1), (left + 0.003) / 3);
    check("then pressure", p.I1() + 3 * gap_K * 0.003, 1e-12);
    check("closed", p.gap(), 0.);
  }

  /** Shear at constant volume: dilation fills the gap, 3 beta of each shear, then it builds up pressure. */
  void dilation()
  {
    LooseSand    p(20, 0);
    const double beta = p.law.beta(), alpha = p.law.alpha();
    Tensor<2, 3> shear;
    shear[0][1] = shear[1][0] = 0.5;
    p.advance_by(diagonal(1, 1, 1), 1e-3, 5);
    p.advance_by(shear, 1e-3, 10);
    check("stress", p.stress().norm(), 1e-12);
    check("gap", p.gap() - 0.015 + 3 * beta * 0.01, 1e-15);
    const double rest = p.gap() / (3 * beta); // of shear, until it is closed
    p.advance_by(shear, rest / 16, 16);
    p.advance_by(shear, 1e-4, 20);
    // sqrt(J2) = G (gamma - lambda) = -alpha I1 = 9 K alpha beta lambda
    const double lambda = gap_G * 2e-3 / (gap_G + 9 * gap_K * alpha * beta);
    check("shear stress", p.stress()[0][1] - gap_G * (2e-3 - lambda), 1e-11);
    check("pressure", p.I1() + 9 * gap_K * beta * lambda, 1e-11);
    check("all plastic volume is dilation", p.states[1] - 3 * beta * std::sqrt(3.) * p.states[0], 1e-14);
  }

  /**
   * Wild paths: F <= 0; what is open bears no pressure; plastic volume is what is not elastic, and dilation and gap
   * make it up; no step gains energy: sigma : d >= the growth of p^2/(2 K) + s : s/(4 G).
   */
  void invariants()
  {
    for (const double c : {0., 0.5})
      for (const double psi : {0., 10., 35.})
      {
        LooseSand    p(psi, c);
        double       outside = 0, pressure = 0, volume = 0, parts = 0, gained = 0, strain = 0;
        unsigned int n_open = 0, n_closed = 0, n_closing = 0;
        for (unsigned int n = 0; n < 3000; ++n)
        {
          // Some directions for 20 steps each, drawn apart and pressed together in turn.
          const Tensor<2, 3> A = some_tensor(0.7 * (n / 20)), L = A + transpose(A) + isotropic(12 * std::cos(0.05 * n));
          const double       before = p.gap(), energy = p.strain_energy_density();
          p.advance(L, 1e-4);
          strain += 1e-4 * trace(L);
          ++(p.gap() > 0 ? n_open : n_closed);
          n_closing += before > 0 && p.gap() == 0;
          outside = std::max(outside, p.F());
          if (p.gap() > 0)
            pressure = std::max(pressure, -p.I1());
          raise(volume, p.states[1] - (strain - p.I1() / (3 * gap_K)));
          raise(parts, p.states[1] - 3 * p.law.beta() * std::sqrt(3.) * p.states[0] - p.gap());
          gained =
            std::max({gained, p.strain_energy_density() - energy - 1e-4 * scalar_product(p.stress(), L), -p.gap()});
        }
        const std::string name = "c = " + std::to_string(c) + ", psi = " + std::to_string(psi) + ", ";
        check(name + "outside the cone", outside, 1e-13);
        check(name + "pressure in an open gap", pressure, 1e-12);
        check(name + "plastic volume", volume, 1e-14);
        check(name + "dilation and gap", parts, 1e-14);
        check(name + "energy gained, negative gap", gained, 1e-14);
        check_true(name + "open, closed, closing", n_open > 100 && n_closed > 100 && n_closing > 3);
      }
  }

  /** In a frame that is turned, and in plane strain, the same. */
  void frames()
  {
    const Tensor<2, 3> Q = rotation(0, 1, 0.7) * rotation(1, 2, -1.1) * rotation(2, 0, 2.3);
    LooseSand          p(10, 0.1), turned(10, 0.1), flat(10, 0.1, 2), full(10, 0.1);
    double             stress = 0, gap = 0, plane = 0;
    unsigned int       n_open = 0;
    for (unsigned int n = 0; n < 600; ++n)
    {
      const Tensor<2, 3> L = some_tensor(0.02 * n) + isotropic(3 * std::cos(0.1 * n));
      p.advance(L, 1e-3);
      turned.advance(Q * L * transpose(Q), 1e-3);
      raise(stress, distance(Q * p.stress() * transpose(Q), turned.stress()));
      raise(gap, p.gap() - turned.gap());
      Tensor<2, 3> in_plane = L;
      for (unsigned int d = 0; d < 3; ++d)
        in_plane[d][2] = in_plane[2][d] = 0;
      flat.advance(in_plane, 1e-3);
      full.advance(in_plane, 1e-3);
      raise(plane, distance(flat.stress(), full.stress()) + std::abs(flat.gap() - full.gap()));
      n_open += p.gap() > 0;
    }
    check("turned: stress", stress, 1e-11);
    check("turned: gap", gap, 1e-13);
    check("2D and 3D", plane, 1e-13);
    check_true("open and closed", n_open > 100 && n_open < 500);
  }

  /** Switched off: pressure from the first compression on. */
  void forgotten()
  {
    LooseSand p(0, 0, 3, false);
    p.advance_by(diagonal(1, 1, 1), 1e-3, 5);
    p.advance_by(diagonal(-1, -1, -1), 1e-3, 5);
    check("pressure", distance(p.stress(), isotropic(-gap_K * 0.015)), 1e-12);
    check("no gap", p.gap(), 0.);
    check("plastic volume", p.states[1] - 0.015, 1e-15);
  }
} // namespace gap

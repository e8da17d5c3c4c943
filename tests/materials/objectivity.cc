#include "point.h"

using namespace Test;

namespace
{
  struct Case
  {
    std::string name, type, entries;
    bool        is_history; // the stress turns by adding up increments: first order in the step
  };

  /** All laws, with a strength that the paths below exceed. */
  std::vector<Case> cases()
  {
    const std::string elastic = set("Young's modulus", "70") + set("Poisson's ratio", "0.2");
    return {
      {"neo-Hookean", "neo-Hookean", elastic, false},
      {"Newtonian fluid", "Newtonian fluid", set("Density", "1") + set("Sound speed", "5") + set("Viscosity", "1"),
       false},
      {"linear elastic", "linear elastic", elastic, true},
      {"perfect", "von Mises", elastic + set("Yield stress", "3"), true},
      {"softening", "von Mises",
       elastic + set("Yield stress", "3") + set("Hardening", "exponential softening") + set("Softening rate", "2"),
       true},
      {"Hencky", "Hencky",
       elastic + set("Yield stress", "3") + set("Hardening", "exponential softening") + set("Softening rate", "2"),
       true},
      {"sand", "Drucker-Prager",
       elastic + set("Friction angle", "35") + set("Dilatancy angle", "10") + set("Cohesion", "1"), true},
      {"Mohr-Coulomb", "Mohr-Coulomb",
       elastic + set("Friction angle", "35") + set("Dilatancy angle", "10") + set("Cohesion", "1"), true}};
  }

  bool has_yielded(const SinglePoint &p) { return p.material->state_names().empty() || p.states[0] > 0.01; }
} // namespace

namespace objectivity
{
  /** Isotropic laws commute with a fixed rotation of everything. */
  void constant_rotation()
  {
    const Tensor<2, 3> Q = rotation(0, 1, 0.7) * rotation(1, 2, -1.1) * rotation(2, 0, 2.3);
    for (const auto &law : cases())
    {
      SinglePoint p(law.type, law.entries, 3), q(law.type, law.entries, 3);
      for (unsigned int n = 0; n < 20; ++n)
      {
        const Tensor<2, 3> L = some_tensor(0.2 * n);
        p.advance(L, 0.01);
        q.advance(Q * L * transpose(Q), 0.01);
      }
      check(law.name, distance(Q * p.stress() * transpose(Q), q.stress()), 1e-12 * p.stress().norm());
      check(law.name + ", state", p.states[0] - q.states[0], 1e-13);
      check_true(law.name + ", yields", has_yielded(p));
    }
  }

  /**
   * A stretch l seen from a frame that turns, L = R' R^T + R l R^T: R sigma R^T in the limit of small steps, or at
   * once for laws without increments. F follows by finite steps, so that it has a first-order error as well.
   */
  void superposed_rotation()
  {
    Tensor<2, 3> l; // no spin
    l[0][0] = 0.3, l[1][1] = -0.1, l[2][2] = -0.3, l[0][1] = l[1][0] = 0.2, l[0][2] = l[2][0] = -0.15;
    const double w = 1.3;
    Tensor<2, 3> spin;
    spin[1][0] = w, spin[0][1] = -w;
    for (const auto &law : cases())
    {
      if (law.type == "Hencky") // hencky::objectivity() turns exactly, without an error of the step
        continue;
      double before = 0;
      for (const unsigned int N : {400, 800})
      {
        SinglePoint  turning(law.type, law.entries, 3), still(law.type, law.entries, 3);
        const double dt = 1. / N;
        for (unsigned int n = 0; n < N; ++n)
        {
          const Tensor<2, 3> R = rotation(0, 1, w * (n + 0.5) * dt);
          turning.advance(spin + R * l * transpose(R), dt);
          still.advance(l, dt);
        }
        if (!law.is_history)
        {
          // These look at nothing but the end: F, V and rate of a step without length.
          const Tensor<2, 3> R = rotation(0, 1, w);
          turning.set_F(R * still.deformation());
          turning.volume = still.volume;
          turning.advance(spin + R * l * transpose(R), 0.);
          still.advance(l, 0.);
        }
        const Tensor<2, 3> R        = rotation(0, 1, w);
        const Tensor<2, 3> expected = R * still.stress() * transpose(R);
        const double       error    = distance(turning.stress(), expected);
        const std::string  name     = law.name + ", N = " + std::to_string(N);
        check_true(name + ", yields", has_yielded(still));
        check(name, error, law.is_history ? (2 * w * w + w) * dt * expected.norm() : 1e-12 * expected.norm());
        if (before > 0 && law.is_history)
          check_range(law.name + ", first order: ratio", before / error, 1.8, 2.2);
        before = error;
      }
    }
  }

  /** A quarter turn carries sigma_aa to sigma_bb, by way of a positive sigma_ab, also at the yield surface. */
  void constant_spin()
  {
    for (const auto &law : cases())
    {
      // A step I + dt L stretches what it turns, which laws of F answer: hencky::objectivity() turns exactly.
      if (!law.is_history || law.type == "Hencky")
        continue;
      for (unsigned int a = 0; a < 3; ++a)
      {
        const unsigned int b = (a + 1) % 3, N = 2000;
        SinglePoint        p(law.type, law.entries, 3);
        Tensor<2, 3>       L, start, half, end;
        L[b][a] = numbers::PI / 2, L[a][b] = -L[b][a];
        start[a][a] = -1, half[a][a] = half[b][b] = half[a][b] = half[b][a] = -0.5, end[b][b] = -1;
        // Stretched beyond its strength where it has one; then only the deviator is scaled back.
        p.set_stress((law.name == "sand" || law.type == "Mohr-Coulomb" ? 100. : 3.001) * start);
        p.advance(Tensor<2, 3>(), 0.);
        const Tensor<2, 3> first = p.stress(), Q = rotation(a, b, numbers::PI / 2), H = rotation(a, b, numbers::PI / 4);
        const std::string  name = law.name + ", axis " + std::to_string(a);
        for (unsigned int n = 0; n < N / 2; ++n)
          p.advance(L, 1. / N);
        check(name + ", 45 degrees", distance(p.stress(), H * first * transpose(H)), 8. / N * first.norm());
        check_true(name + ", sign of the shear", p.stress()[a][b] < -0.1 * deviatoric(first).norm());
        for (unsigned int n = N / 2; n < N; ++n)
          p.advance(L, 1. / N);
        check(name + ", 90 degrees", distance(p.stress(), Q * first * transpose(Q)), 8. / N * first.norm());
        check_true(name + ", from axis to axis", p.stress()[b][b] < p.stress()[a][a] - 0.1);
      }
    }
  }
} // namespace objectivity

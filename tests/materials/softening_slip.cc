#include "point.h"

namespace softening_slip
{
  using namespace Test;

  namespace
  {
    const std::string elastic = set("Young's modulus", "3e5") + set("Poisson's ratio", "0.3");
    const std::string slip    = set("Softening slip", "0.3") + set("Band width", "2.5");

    /** What a band takes per area beyond its residual strength in shear: width times the integral of tau - residual
     * over gamma_p. */
    double energy_of_band(const std::string &type, const std::string &entries, const double spacing,
                          const double residual)
    {
      SinglePoint p(type, elastic + entries + slip, 3);
      p.material->set_spacing(spacing);
      Tensor<2, 3> L;
      const double width = 2.5 * spacing, step = 2e-4 * 0.3 / width;
      L[0][1] = L[1][0] = 0.5 * step; // gamma' = step
      double energy     = 0;
      for (unsigned int n = 0; n < 60000; ++n)
      {
        const double before = p.states[0], tau = std::abs(p.stress()[0][1]);
        p.advance(L, 1);
        const double mean = 0.5 * (tau + std::abs(p.stress()[0][1]));
        energy += width * (mean - residual) * std::sqrt(3.) * (p.states[0] - before);
      }
      return energy;
    }
  } // namespace

  /** Whatever the spacing: u (tau_p - tau_r) of exponential softening, half of it of linear. */
  void energy()
  {
    // Strengths in shear of 10 and 2; a step is 2e-4 of the slip.
    const std::string mises = set("Yield stress", std::to_string(10 * std::sqrt(3.))) +
                              set("Residual yield stress", std::to_string(2 * std::sqrt(3.))) +
                              set("Hardening", "exponential softening");
    const std::string soil = set("Friction angle", "0") + set("Cohesion", "10") + set("Residual cohesion", "2");
    for (const double h : {0.02, 0.1, 0.4})
    {
      const std::string at = ", spacing " + std::to_string(h);
      check("von Mises" + at, energy_of_band("von Mises", mises, h, 2) / (0.3 * 8) - 1, 2e-3);
      check("Mohr-Coulomb" + at, energy_of_band("Mohr-Coulomb", soil, h, 2) / (0.5 * 0.3 * 8) - 1, 2e-3);
    }
  }

  /** Too coarse a grid is refused, with the spacing that would do: u G/(width (tau_p - tau_r)). */
  void errors()
  {
    const double      G = 3e5 / 2.6;
    const std::string brittle =
      set("Friction angle", "0") + set("Cohesion", std::to_string(G / 10)) + set("Residual cohesion", "0");
    SinglePoint p("Mohr-Coulomb", elastic + brittle + slip, 3); // largest spacing 0.3 * 10 / 2.5
    p.material->set_spacing(1.19);
    check_error<EntryError>("coarse", {"Softening slip", "Take a spacing below 1.2,"},
                            [&] { p.material->set_spacing(1.21); });
    const auto wrong = [](const std::string &name, const std::string &type, const std::string &entries,
                          const std::string &words) {
      check_error<EntryError>(name, {words}, [&] { SinglePoint q(type, elastic + entries, 3); });
    };
    wrong("negative", "Mohr-Coulomb", set("Cohesion", "1") + set("Softening slip", "-1"), "must be positive, or 0");
    wrong("width", "Mohr-Coulomb", set("Cohesion", "1") + set("Band width", "0"), "two or three spacings wide");
    wrong("hardening", "von Mises", set("Softening slip", "0.1"), "it belongs to 'Hardening = exponential softening'");
  }
} // namespace softening_slip

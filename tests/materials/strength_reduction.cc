#include "point.h"

namespace strength_reduction
{
  using namespace Test;

  namespace
  {
    const std::string elastic = set("Young's modulus", "1e6") + set("Poisson's ratio", "0.3");

    /** The shear stress at which a point flows that is sheared from rest under a pressure. */
    double shear_strength(const std::string &type, const std::string &entries)
    {
      SinglePoint  p(type, elastic + entries, 3);
      Tensor<2, 3> L;
      L[0][1] = L[1][0] = 5e-5;
      for (unsigned int n = 0; n < 2000; ++n)
        p.advance(L, 1);
      return std::abs(p.stress()[0][1]);
    }

    std::string angles(const double phi, const double psi)
    {
      return set("Friction angle", std::to_string(phi)) + set("Dilatancy angle", std::to_string(psi));
    }
  } // namespace

  /** Strengths in shear are divided by it, and a law so reduced is the law with the strengths that one computes. */
  void strengths()
  {
    const std::string reduced = set("Strength reduction", "1.25");
    const double      degree  = numbers::PI / 180;
    const std::string half    = set("Cohesion", "100") + angles(0, 0);
    for (const auto &[type, entries, strength] :
         {std::make_tuple("von Mises", set("Yield stress", std::to_string(100 * std::sqrt(3.))), 100.),
          std::make_tuple("Hencky", set("Yield stress", std::to_string(100 * std::sqrt(3.))), 100.),
          std::make_tuple("Mohr-Coulomb", half, 100.)})
    {
      check(std::string(type) + " as it is", shear_strength(type, entries) / strength - 1, 2e-3);
      check(std::string(type) + " over 1.25", shear_strength(type, entries + reduced) / (strength / 1.25) - 1, 2e-3);
    }
    const double phi = std::atan(std::tan(30 * degree) / 1.25) / degree,
                 psi = std::atan(std::tan(10 * degree) / 1.25) / degree;
    for (const std::string type : {"Mohr-Coulomb", "Drucker-Prager"})
    {
      const double found    = shear_strength(type, set("Cohesion", "100") + angles(30, 10) + reduced),
                   expected = shear_strength(type, set("Cohesion", "80") + angles(phi, psi));
      check(type + " with angles", found / expected - 1, 1e-6); // angles are printed with six digits
    }
  }

  void errors()
  {
    for (const std::string type : {"von Mises", "Hencky", "Mohr-Coulomb", "Drucker-Prager"})
      for (const std::string factor : {"0", "-1"})
        check_error<EntryError>(type + " " + factor, {"Strength reduction", "it must be positive"}, [&] {
          SinglePoint p(type,
                        elastic + set("Strength reduction", factor) +
                          (type == "Mohr-Coulomb" || type == "Drucker-Prager" ? set("Cohesion", "1") : ""),
                        3);
        });
  }
} // namespace strength_reduction

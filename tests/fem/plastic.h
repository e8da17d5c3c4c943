#pragma once

#include "reference.h"

#include <cmath>

/** A plastic material and its hardening laws in closed form. */
namespace Test
{
  const double E = 1000., nu = .333, Y = 10., K = E / 3. / (1. - 2. * nu), G = E / 2. / (1. + nu);

  /** A law, written here once more. */
  struct Hardening
  {
    std::string name;
    double      modulus, residual, reference_strain;

    double yield_stress(const double alpha) const
    {
      return name == "linear"      ? Y + modulus * alpha :
             name == "exponential" ? residual + (Y - residual) * std::exp(-alpha / reference_strain) :
                                     Y;
    }

    /** Where elastic - slope alpha = yield stress, by bisection; 0 below yield. */
    double alpha(const double elastic, const double slope) const
    {
      if (elastic <= Y)
        return 0.;
      double low = 0., high = elastic / slope;
      for (unsigned int n = 0; n < 200; ++n)
      {
        const double middle                                            = .5 * (low + high);
        (elastic - slope * middle > yield_stress(middle) ? low : high) = middle;
      }
      return low;
    }

    std::string entries() const
    {
      std::ostringstream text;
      text.precision(17);
      text << "  set Young's modulus = " << E << "\n  set Poisson's ratio = " << nu << "\n  set Yield stress = " << Y
           << "\n  set Hardening = " << name << "\n  set Hardening modulus = " << modulus
           << "\n  set Residual yield stress = " << residual << "\n  set Reference strain = " << reference_strain
           << "\n";
      return text.str();
    }

    /** As a section of a reference. */
    std::string section() const { return "  subsection J2\n" + entries() + "  end\n"; }
  };

  inline std::vector<Hardening> hardenings()
  {
    return {{"perfect", 0., 0., .01}, {"linear", 200., 0., .01}, {"exponential", 0., 4., .03}};
  }
} // namespace Test

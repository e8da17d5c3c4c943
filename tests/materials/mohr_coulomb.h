#pragma once

#include "point.h"

namespace mohr_coulomb
{
  using namespace Test;

  inline constexpr double E = 700, nu = 0.2;
  inline constexpr double K = E / (3 * (1 - 2 * nu)), G = E / (2 * (1 + nu)), lambda = K - 2. / 3. * G;

  inline double radians(const double degrees) { return degrees * numbers::PI / 180; }

  struct Soil : SinglePoint
  {
    Soil(const double phi, const double psi, const double c, const std::string &more = "", const unsigned int dim = 3) :
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

  inline Tensor<2, 3> pressure(const double p) { return -p * Tensor<2, 3>(unit_symmetric_tensor<3>()); }
} // namespace mohr_coulomb

#pragma once

#include <talus/materials/material.h>

namespace Talus
{
  /**
   * Isotropic linear elasticity in rate form with the Jaumann rate, Eqs. (28)-(30):
   * @f[ \sigma^{n+1} = \sigma^n + \lambda\,\mathrm{tr}(\Delta d) I + 2 G \Delta d
   *                    + \Delta\omega\cdot\sigma^n - \sigma^n\cdot\Delta\omega . @f]
   * No state. Throws nothing: any increment has a stress.
   * Theory: doc/materials.md. Test: tests/materials/linear_elastic.cc.
   */
  class LinearElastic : public Material
  {
  public:
    explicit LinearElastic(const std::string &section);

    void   update(const MaterialRange &range) const override;
    double wave_speed(const double rho) const override;
    double strain_energy_density(const dealii::SymmetricTensor<2, 3> &stress) const override;
    double rest_stress_ratio() const override { return poisson_ratio / (1 - poisson_ratio); }

    void parse_parameters(dealii::ParameterHandler &prm) override;

    double bulk_modulus() const { return youngs_modulus / (3 * (1 - 2 * poisson_ratio)); }
    double shear_modulus() const { return youngs_modulus / (2 * (1 + poisson_ratio)); }

  private:
    double youngs_modulus = 1e6; // [stress]
    double poisson_ratio  = 0.3; // [1]

    double pressure_wave_modulus = 0; // K + 4 G / 3 [stress]
  };
} // namespace Talus

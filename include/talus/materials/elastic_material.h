#pragma once

#include <talus/materials/material.h>

namespace Talus
{
  /**
   * What materials with isotropic elasticity share: Young's modulus and Poisson's
   * ratio, the speed of their pressure waves, Eq. (34), and the energy
   * @f[ p^2 / (2 K) + s : s / (4 G) @f]
   * of a stress. Test: tests/materials/linear_elastic.cc.
   */
  class ElasticMaterial : public Material
  {
  public:
    explicit ElasticMaterial(const std::string &section);

    void   wave_speeds(const MaterialRange &range, double *speeds) const override;
    void   strain_energy_densities(const MaterialRange &range, double *densities) const override;
    double rest_stress_ratio() const override { return poisson_ratio / (1 - poisson_ratio); }

    void parse_parameters(dealii::ParameterHandler &prm) override;

    double bulk_modulus() const { return youngs_modulus / (3 * (1 - 2 * poisson_ratio)); }
    double shear_modulus() const { return youngs_modulus / (2 * (1 + poisson_ratio)); }
    double lame_modulus() const { return bulk_modulus() - 2. / 3. * shear_modulus(); }

  private:
    double youngs_modulus = 1e6; // [stress]
    double poisson_ratio  = 0.3; // [1]
  };
} // namespace Talus

#pragma once

#include <talus/materials/elastic_material.h>

namespace Talus
{
  /**
   * Compressible neo-Hookean elasticity,
   * @f[ \sigma = \frac{\lambda \ln J}{J} I + \frac{\mu}{J} (F F^T - I) , \qquad
   *     W = \frac{\mu}{2} (\mathrm{tr} F F^T - 3 - 2 \ln J) + \frac{\lambda}{2} \ln^2 J , @f]
   * W per initial volume; Bonet & Wood (2008), section 6.4.3. The stress follows from F
   * alone: an initial stress would be lost in the first step and is refused. J > 0 is watched by the run.
   * Theory: doc/materials.md. Test: tests/materials/neo_hookean.cc.
   */
  class NeoHookean : public ElasticMaterial
  {
  public:
    using ElasticMaterial::ElasticMaterial;

    void update(const MaterialRange &range) const override;

    /**
     * An upper bound, sharp at F = I. A uniaxial stretch a has
     * rho c^2 = (lambda (1 - ln J) + mu (1 + a^2)) / J, and ln J >= 1 - 1/J.
     */
    void wave_speeds(const MaterialRange &range, double *speeds) const override;
    void strain_energy_densities(const MaterialRange &range, double *densities) const override;

    bool        starts_deformed() const override { return true; }
    std::string refusal(const std::array<double, 6> &initial_stress) const override;
  };
} // namespace Talus

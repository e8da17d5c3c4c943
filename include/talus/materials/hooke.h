#pragma once

#include <talus/materials/elastic_material.h>

namespace Talus
{
  /**
   * Hooke's law of the displacement gradient,
   * @f[ \sigma = \lambda\,\mathrm{tr}(\varepsilon) I + 2\mu\varepsilon , \quad
   *     \varepsilon = \tfrac12 (F + F^T) - I , \quad W = \frac{1}{J}\left(\frac\lambda2 (\mathrm{tr}\,\varepsilon)^2 +
   *     \mu\,\varepsilon : \varepsilon\right) \text{ per current volume.} @f]
   * For verification: of a bar with nu = 0 the equations of motion are linear whatever its strain, as the stress is the
   * force on the initial area, and W is exact. Rotations give stress: bodies must not turn. An initial stress would be
   * lost and is refused. Theory: doc/materials.md. Test: tests/materials/hooke.cc.
   */
  class Hooke : public ElasticMaterial
  {
  public:
    using ElasticMaterial::ElasticMaterial;

    void        update(const MaterialRange &range) const override;
    void        wave_speeds(const MaterialRange &range, double *speeds) const override;
    void        strain_energy_densities(const MaterialRange &range, double *densities) const override;
    bool        starts_deformed() const override { return true; }
    std::string refusal(const std::array<double, 6> &initial_stress) const override;
  };
} // namespace Talus

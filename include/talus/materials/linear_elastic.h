#pragma once

#include <talus/materials/elastic_material.h>

namespace Talus
{
  /**
   * Isotropic linear elasticity in rate form with the Jaumann rate, Eqs. (28)-(30):
   * @f[ \sigma^{n+1} = \sigma^n + \lambda\,\mathrm{tr}(\Delta d) I + 2 G \Delta d
   *                    + \Delta\omega\cdot\sigma^n - \sigma^n\cdot\Delta\omega . @f]
   * No state. Throws nothing: any increment has a stress.
   * Theory: doc/materials.md. Test: tests/materials/linear_elastic.cc.
   */
  class LinearElastic : public ElasticMaterial
  {
  public:
    using ElasticMaterial::ElasticMaterial;

    void update(const MaterialRange &range) const override;
  };
} // namespace Talus

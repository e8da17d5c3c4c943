#pragma once

#include <talus/materials/elastic_material.h>

namespace Talus
{
  /**
   * Von Mises plasticity,
   * @f[ f = \sqrt{3/2}\,|s| - \sigma_Y(\bar\varepsilon) \le 0 , @f]
   * with the yield stress constant, growing linearly, or falling exponentially:
   * @f[ \sigma_Y = \sigma_0 , \qquad \sigma_0 + H \bar\varepsilon , \qquad
   *     \sigma_r + (\sigma_0 - \sigma_r) \exp(-\eta\bar\varepsilon) . @f]
   * Radial return of the elastic trial stress, Eq. (28): Simo & Hughes (1998), box 3.1.
   * State: equivalent plastic strain [1]. Throws nothing: any increment has a return, since
   * parse_parameters() refuses softening faster than the elastic unloading, 3 G.
   * Theory: doc/materials.md. Test: tests/materials/von_mises.cc.
   */
  class VonMises : public ElasticMaterial
  {
  public:
    explicit VonMises(const std::string &section);

    std::vector<std::string> state_names() const override { return {"equivalent plastic strain"}; }
    void                     update(const MaterialRange &range) const override;

    void parse_parameters(dealii::ParameterHandler &prm) override;

  private:
    std::string hardening         = "perfect";
    double      yield_stress      = 1e3; // [stress]
    double      hardening_modulus = 0;   // [stress]
    double      residual_stress   = 0;   // [stress]
    double      softening_rate    = 1;   // [1]
  };
} // namespace Talus

#pragma once

#include <talus/materials/elastic_material.h>
#include <talus/materials/strength_reduction.h>

#include <limits>

namespace Talus
{
  /**
   * Drucker-Prager plasticity with a flow rule of its own, Eqs. (71)-(74), tension positive:
   * @f[ F = \sqrt{J_2} + \alpha I_1 - \kappa \le 0 , \qquad G = \sqrt{J_2} + \beta I_1 . @f]
   * The elastic trial stress, Eq. (28), returns to the cone by
   * @f[ \Delta\lambda = F / (G + 9 K \alpha \beta) @f]
   * (G: shear modulus), or to the apex, I_1 = kappa / alpha and s = 0, where that would make sqrt(J_2) < 0.
   *
   * Expansion beyond what shear dilates, at the apex, opens a *gap* g between the grains, and no pressure is borne
   * before compression has closed it:
   * @f[ \dot g = \mathrm{tr}\, d_p - 3 \beta \dot\lambda , \qquad g \ge 0 , \qquad
   *     g > 0 \Rightarrow I_1 \ge 0 , \qquad \dot g < 0 \Rightarrow I_1 \le 0 . @f]
   * A gap closes without work; it is the volume correction of Tampubolon et al. (2017) in rate form. An entry leaves
   * it out.
   *
   * State: equivalent plastic strain, the sum of sqrt(2/3) |dev d_p| dt = dlambda / sqrt(3); volumetric plastic strain,
   * the sum of tr(d_p) dt = 3 beta dlambda + dg; and the gap [1].
   * Throws nothing: any increment has a return.
   * Theory: doc/materials.md. Test: tests/materials/drucker_prager.cc.
   */
  class DruckerPrager : public ElasticMaterial
  {
  public:
    explicit DruckerPrager(const std::string &section);

    std::vector<std::string> state_names() const override
    {
      return {"equivalent plastic strain", "volumetric plastic strain", "gap"};
    }
    void update(const MaterialRange &range) const override;

    /** Loose grains at the apex fly apart without stress, as far as they like. */
    double largest_volume_ratio() const override { return std::numeric_limits<double>::max(); }

    void parse_parameters(dealii::ParameterHandler &prm) override;

    std::vector<EntryError> doubts() const override;

    bool bears_tension() const override { return cohesion > 0; }

    double alpha() const { return plane_strain_slope(friction_angle); } // [1]
    double beta() const { return plane_strain_slope(dilatancy_angle); } // [1]
    double kappa() const;                                               // [stress]

  private:
    /** Eq. (72): tan a / sqrt(9 + 12 tan^2 a). */
    static double plane_strain_slope(const double angle);

    double friction_angle  = 30; // [degrees]
    double dilatancy_angle = 0;  // [degrees]
    double cohesion        = 0;  // [stress]

    bool remembers_loosening = true;

    StrengthReduction strength_reduction;
  };
} // namespace Talus

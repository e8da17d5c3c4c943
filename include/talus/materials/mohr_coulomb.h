#pragma once

#include <talus/materials/elastic_material.h>
#include <talus/materials/softening_slip.h>
#include <talus/materials/strength_reduction.h>

#include <limits>

namespace Talus
{
  /**
   * Mohr-Coulomb plasticity with a flow rule of its own and a limit on tension; tension positive, sigma_1 >= sigma_2 >=
   * sigma_3,
   * @f[ F = (1 + \sin\phi)\,\sigma_1 - (1 - \sin\phi)\,\sigma_3 - 2 c \cos\phi \le 0 , \quad
   *     \sigma_1 \le \sigma_t \le c \cot\phi , @f]
   * @f[ G = (1 + \sin\psi)\,\sigma_1 - (1 - \sin\psi)\,\sigma_3 , \quad G_t = \sigma_1 . @f]
   * The trial stress, Eq. (28), returns along its principal axes to the plane, line or point of this surface whose
   * multipliers are not negative (Clausen, Damkilde & Andersen 2006). Cohesion, friction and dilatancy go linearly from
   * peak to residual values over a range of the equivalent plastic strain; a step takes them as they are at its start.
   *
   * State: equivalent plastic strain, the sum of sqrt(2/3) |dev d_p| dt, and volumetric plastic strain, the sum of
   * tr(d_p) dt [1]. Throws nothing: any increment has a return.
   * Theory: doc/materials.md. Test: tests/materials/mohr_coulomb.cc.
   */
  class MohrCoulomb : public ElasticMaterial
  {
  public:
    explicit MohrCoulomb(const std::string &section);

    std::vector<std::string> state_names() const override
    {
      return {"equivalent plastic strain", "volumetric plastic strain"};
    }
    void update(const MaterialRange &range) const override;

    /** Particles that are drawn apart at the limit of tension go as far as they like. */
    double largest_volume_ratio() const override { return std::numeric_limits<double>::max(); }

    void parse_parameters(dealii::ParameterHandler &prm) override;

    void set_spacing(const double spacing) override;

    std::vector<EntryError> doubts() const override;

    bool bears_tension() const override { return cohesion > 0 && (tension_strength < 0 || tension_strength > 0); }

  private:
    /** Throws EntryError if they are none of a soil. */
    void check_angles(const std::string &prefix, const double friction, const double dilatancy) const;

    SofteningSlip     softening_slip;
    StrengthReduction strength_reduction;

    double friction_angle = 30, dilatancy_angle = 0, cohesion = 0;                              // [degrees], [stress]
    double residual_friction_angle = -1, residual_dilatancy_angle = -1, residual_cohesion = -1; // < 0: as at the peak
    double softening_strain = 0.1;                                                              // [1]
    double tension_strength = -1; // [stress]; < 0: c cot phi
  };
} // namespace Talus

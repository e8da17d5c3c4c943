#pragma once

#include <talus/materials/elastic_material.h>
#include <talus/materials/hardening.h>
#include <talus/materials/softening_slip.h>
#include <talus/materials/strength_reduction.h>

#include <cmath>

namespace Talus
{
  /**
   * Von Mises plasticity,
   * @f[ f = \sqrt{3/2}\,|s| - \sigma_Y(\bar\varepsilon) \le 0 , @f]
   * with the yield stress constant, growing linearly, or falling exponentially:
   * @f[ \sigma_Y = \sigma_0 , \qquad \sigma_0 + H \bar\varepsilon , \qquad
   *     \sigma_r + (\sigma_0 - \sigma_r) \exp(-\eta\bar\varepsilon) . @f]
   * `Softening slip` u_s gives the rate by the spacing, eta = sqrt(3) w h/u_s: the strength of a band falls by 1/e
   * over it. The entries can give bounds of |s| instead, which are sqrt(2/3) of these.
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
    void                     plastic_work_densities(const MaterialRange &range, double *densities) const override;

    void parse_parameters(dealii::ParameterHandler &prm) override;
    void set_spacing(const double spacing) override;

  protected:
    /** Calls `body(law)` with the hardening law that was chosen. */
    template <class Body>
    void with_hardening(const Body &body) const
    {
      const double scale = in_tension(), initial = scale * yield_stress, residual = scale * residual_stress;
      if (hardening == "perfect")
        body(PerfectPlasticity{initial});
      else if (hardening == "linear")
        body(LinearHardening{initial, scale * hardening_modulus});
      else
        body(ExponentialSoftening{residual, initial - residual, softening_rate});
    }

  private:
    /** Yield stress in tension over the strength as the entries give it. */
    double in_tension() const { return norm == "deviator" ? std::sqrt(1.5) : 1.; }

    SofteningSlip     softening_slip;
    StrengthReduction strength_reduction;

    std::string hardening         = "perfect";
    std::string norm              = "von Mises";
    double      yield_stress      = 1e3; // [stress]
    double      hardening_modulus = 0;   // [stress]
    double      residual_stress   = 0;   // [stress]
    double      softening_rate    = 1;   // [1]
  };
} // namespace Talus

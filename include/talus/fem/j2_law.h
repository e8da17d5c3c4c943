#pragma once

#include <deal.II/base/parameter_acceptor.h>
#include <deal.II/base/symmetric_tensor.h>

#include <string>

namespace Talus
{
  /**
   * Elastoplasticity at small strains with the von Mises yield function and isotropic hardening or softening,
   * @f[ f = \sqrt{3/2}\,|s| - \sigma_y(\alpha) \le 0 , \quad \dot\varepsilon^p = \dot\alpha \sqrt{3/2}\; s/|s| , @f]
   * where @f$ \sigma_y @f$ is one of
   * @f[ \sigma_Y , \quad \sigma_Y + H \alpha , \quad \sigma_r + (\sigma_Y - \sigma_r) e^{-\alpha/\alpha_0} . @f]
   *
   * Backward Euler: the stress returns along the radius of the trial stress, Simo & Hughes (1998), box 3.2. It is
   * written apart from the materials of a run, so that a reference is independent of them.
   *
   * Throws EntryError for moduli, yield stresses and a softening so steep that a return is not unique. Any strain has
   * a return. Theory: doc/fem_reference.md. Test: tests/fem/j2_law.cc.
   */
  class J2Law : public dealii::ParameterAcceptor
  {
  public:
    explicit J2Law(const std::string &section);

    void parse_parameters(dealii::ParameterHandler &prm) override;

    /** What a material point remembers. */
    struct State
    {
      dealii::SymmetricTensor<2, 3> plastic_strain; // without trace [1]
      double                        alpha = 0.;     // equivalent plastic strain [1]
    };

    /** Cauchy stress, and the state that goes with it. */
    struct Response
    {
      dealii::SymmetricTensor<2, 3> stress;
      State                         state;
    };

    /** The response to a total strain from the state before the step. */
    Response respond(const dealii::SymmetricTensor<2, 3> &strain, const State &old_state) const;

    /** The derivative of that stress by that strain [stress]. */
    dealii::SymmetricTensor<4, 3> tangent(const dealii::SymmetricTensor<2, 3> &strain, const State &old_state) const;

    double yield_stress(const double alpha) const;
    double yield_slope(const double alpha) const;

    double bulk_modulus() const { return youngs_modulus / (3. * (1. - 2. * poisson_ratio)); }
    double shear_modulus() const { return youngs_modulus / (2. * (1. + poisson_ratio)); }

  private:
    /** Increment of @f$ \alpha @f$ that brings a trial stress of von Mises stress `q` back to the yield surface. */
    double plastic_increment(const double q, const double alpha) const;

    double      youngs_modulus = 1e6, poisson_ratio = 0.3; // [stress], [1]
    std::string hardening         = "perfect";
    double      initial_stress    = 1e3;                       // [stress]
    double      hardening_modulus = 0.;                        // [stress]
    double      residual_stress = 0., reference_strain = 0.01; // [stress], [1]
  };
} // namespace Talus

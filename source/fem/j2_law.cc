#include <talus/core/exceptions.h>
#include <talus/fem/j2_law.h>

#include <cmath>

namespace Talus
{
  using namespace dealii;

  J2Law::J2Law(const std::string &section) : ParameterAcceptor(section)
  {
    add_parameter("Young's modulus", youngs_modulus, "Stiffness in uniaxial stress [stress].", prm, Patterns::Double());
    add_parameter("Poisson's ratio", poisson_ratio, "Lateral contraction over extension [1], -1 < nu < 0.5.", prm,
                  Patterns::Double());
    add_parameter("Hardening", hardening,
                  "How the yield stress depends on the equivalent plastic strain a: 'perfect', not at all; 'linear', "
                  "Y + H a; 'exponential', R + (Y - R) exp(-a/a0), softening when R < Y.",
                  prm, Patterns::Selection("perfect|linear|exponential"));
    add_parameter("Yield stress", initial_stress, "Y, in uniaxial stress at first yield [stress].", prm,
                  Patterns::Double());
    add_parameter("Hardening modulus", hardening_modulus, "H of the linear law [stress].", prm, Patterns::Double());
    add_parameter("Residual yield stress", residual_stress, "R of the exponential law [stress].", prm,
                  Patterns::Double());
    add_parameter("Reference strain", reference_strain, "a0 of the exponential law [1].", prm, Patterns::Double());
  }

  void J2Law::parse_parameters(ParameterHandler &)
  {
    const auto require = [&](const bool holds, const std::string &entry, const std::string &message) {
      if (!holds)
        throw EntryError(get_section_name(), entry, message);
    };
    require(youngs_modulus > 0., "Young's modulus", "it must be positive.");
    require(poisson_ratio > -1. && poisson_ratio < 0.5, "Poisson's ratio",
            "it must lie between -1 and 0.5, both excluded: at 0.5 the bulk modulus is infinite.");
    require(initial_stress > 0., "Yield stress", "it must be positive.");
    require(hardening_modulus >= 0., "Hardening modulus",
            "it must not be negative, or the yield stress would become so. The exponential law softens.");
    require(residual_stress >= 0., "Residual yield stress", "it must not be negative.");
    require(reference_strain > 0., "Reference strain", "it must be positive.");
    require(3. * shear_modulus() + yield_slope(0.) > 0., "Reference strain",
            "the yield stress falls so steeply that stress does not determine strain. It must exceed "
            "(Y - R)/(3 G) = " +
              std::to_string((initial_stress - residual_stress) / (3. * shear_modulus())) + ".");
  }

  double J2Law::yield_stress(const double alpha) const
  {
    if (hardening == "linear")
      return initial_stress + hardening_modulus * alpha;
    if (hardening == "exponential")
      return residual_stress + (initial_stress - residual_stress) * std::exp(-alpha / reference_strain);
    return initial_stress;
  }

  double J2Law::yield_slope(const double alpha) const
  {
    if (hardening == "linear")
      return hardening_modulus;
    if (hardening == "exponential")
      return -(initial_stress - residual_stress) / reference_strain * std::exp(-alpha / reference_strain);
    return 0.;
  }

  double J2Law::plastic_increment(const double q, const double alpha) const
  {
    // q - 3 G x = yield_stress(alpha + x). The left minus the right side falls with x and its curvature has one sign,
    // so that Newton's method comes to the root from one side.
    const double G = shear_modulus();
    double       x = 0.;
    for (unsigned int n = 0; n < 100; ++n)
    {
      const double step = (q - 3. * G * x - yield_stress(alpha + x)) / (3. * G + yield_slope(alpha + x));
      x += step;
      if (std::abs(step) <= 1e-15 * (alpha + std::abs(x)))
        break;
    }
    return x;
  }

  J2Law::Response J2Law::respond(const SymmetricTensor<2, 3> &strain, const State &old_state) const
  {
    const double                K = bulk_modulus(), G = shear_modulus();
    const SymmetricTensor<2, 3> s = 2. * G * (deviator(strain) - old_state.plastic_strain); // trial
    const SymmetricTensor<2, 3> p = K * trace(strain) * unit_symmetric_tensor<3>();
    const double                q = std::sqrt(1.5) * s.norm();
    if (q <= yield_stress(old_state.alpha))
      return {p + s, old_state};

    const double                increment = plastic_increment(q, old_state.alpha);
    const SymmetricTensor<2, 3> flow      = 1.5 / q * s; // sqrt(3/2) times the unit normal
    return {p + (1. - 3. * G * increment / q) * s,
            {old_state.plastic_strain + increment * flow, old_state.alpha + increment}};
  }

  SymmetricTensor<4, 3> J2Law::tangent(const SymmetricTensor<2, 3> &strain, const State &old_state) const
  {
    const double                K = bulk_modulus(), G = shear_modulus();
    const SymmetricTensor<4, 3> volumetric = K * outer_product(unit_symmetric_tensor<3>(), unit_symmetric_tensor<3>());
    const SymmetricTensor<2, 3> s          = 2. * G * (deviator(strain) - old_state.plastic_strain);
    const double                q          = std::sqrt(1.5) * s.norm();
    if (q <= yield_stress(old_state.alpha))
      return volumetric + 2. * G * deviator_tensor<3>();

    // s = (1 - 3 G x/q) s_trial, where dx/dq = 1/(3 G + slope) and dq = 3 G n : d(strain) with n = s_trial/q.
    const double                x     = plastic_increment(q, old_state.alpha);
    const double                dx_dq = 1. / (3. * G + yield_slope(old_state.alpha + x));
    const SymmetricTensor<2, 3> n     = s / q;
    return volumetric + 2. * G * (1. - 3. * G * x / q) * deviator_tensor<3>() -
           9. * G * G * (dx_dq - x / q) * outer_product(n, n);
  }
} // namespace Talus

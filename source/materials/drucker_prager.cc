#include <talus/core/exceptions.h>
#include <talus/core/registry.h>
#include <talus/materials/drucker_prager.h>
#include <talus/materials/point.h>

#include <cmath>

namespace Talus
{
  using namespace dealii;

  DruckerPrager::DruckerPrager(const std::string &section) : ElasticMaterial(section)
  {
    add_parameter(
      "Friction angle", friction_angle,
      "Friction angle phi of the Mohr-Coulomb law that is matched in plane strain, Eq. (72) [degrees]. The "
      "match is exact for a dilatancy angle psi = phi; for psi = 0 the angle that the material mobilises in "
      "plane strain is asin(3 alpha), 32.99 for phi = 35.",
      prm, Patterns::Double());
    add_parameter("Dilatancy angle", dilatancy_angle,
                  "Dilatancy angle psi, from 0 (plastic flow keeps the volume) to the friction angle [degrees].", prm,
                  Patterns::Double());
    add_parameter("Cohesion", cohesion, "Cohesion of the matched Mohr-Coulomb law [stress].", prm, Patterns::Double());
  }

  void DruckerPrager::parse_parameters(ParameterHandler &prm)
  {
    ElasticMaterial::parse_parameters(prm);
    const auto check = [&](const bool holds, const std::string &entry, const std::string &message) {
      if (!holds)
        throw EntryError(get_section_name(), entry, message);
    };
    check(friction_angle >= 0 && friction_angle < 90, "Friction angle",
          "it must lie between 0 and 90 degrees, 90 excluded; sand has 30 to 40.");
    check(dilatancy_angle >= 0, "Dilatancy angle", "it must not be negative; 0 keeps the volume.");
    check(dilatancy_angle <= friction_angle, "Dilatancy angle",
          "it must not exceed the friction angle, or plastic flow would create energy. Lower it; 0 keeps the volume.");
    check(cohesion >= 0, "Cohesion", "it must not be negative; dry sand has 0.");
    check(cohesion > 0 || friction_angle > 0, "Cohesion",
          "with neither cohesion nor friction the material has no strength. Give one of them, or use a fluid.");
  }

  double DruckerPrager::plane_strain_slope(const double angle)
  {
    const double t = std::tan(angle * numbers::PI / 180);
    return t / std::sqrt(9 + 12 * t * t);
  }

  double DruckerPrager::kappa() const
  {
    const double t = std::tan(friction_angle * numbers::PI / 180);
    return 3 * cohesion / std::sqrt(9 + 12 * t * t);
  }

  void DruckerPrager::update(const MaterialRange &range) const
  {
    for_each_point(range, [lambda = lame_modulus(), K = bulk_modulus(), G = shear_modulus(), alpha = alpha(),
                           beta = beta(), kappa = kappa()](const auto &point) {
      using Number         = std::decay_t<decltype(point.mass())>;
      auto         stress  = elastic_step(point, lambda, G);
      const auto   s       = deviator(stress);
      const Number I1      = trace(stress);
      const Number sqrt_J2 = sqrt(0.5 * (s * s));
      const Number F       = sqrt_J2 + alpha * I1 - kappa;
      const auto   yields  = F > Number(0.);
      if (any(yields))
      {
        const double apex_I1 = alpha > 0 ? kappa / alpha : 0.; // alpha = 0 has no apex
        // On the cone sqrt(J2) would come out negative.
        const auto   at_apex  = yields & (G * (alpha * I1 - kappa) > 9 * K * alpha * beta * sqrt_J2);
        const Number cone     = F / (G + 9 * K * alpha * beta);
        const Number d_lambda = select(yields, select(at_apex, Number(sqrt_J2 / G), cone),
                                       Number(0.)); // such that sqrt(J2) falls by G times it
        const Number d_volume =
          select(at_apex, Number((I1 - apex_I1) / (3 * K)), Number(3 * beta * d_lambda)); // tr(d_p) dt
        // Where sqrt(J2) = 0 the deviator vanishes as well, and any factor will do.
        const Number scale =
          select(at_apex, Number(1.), Number(G * d_lambda / select(sqrt_J2 > Number(0.), sqrt_J2, Number(1.))));
        stress -= scale * s;
        for (unsigned int i = 0; i < 3; ++i)
          stress[i][i] -= K * d_volume;
        point.set_state(0, point.state(0) + d_lambda / std::sqrt(3.));
        point.set_state(1, point.state(1) + d_volume);
      }
      point.set_stress(stress);
    });
  }

  namespace
  {
    const Register<Material, DruckerPrager> registration("Drucker-Prager",
                                                         "plastic with friction, cohesion and dilatancy; sand");
  }
} // namespace Talus

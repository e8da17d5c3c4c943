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
    add_parameter("Remember loosening", remembers_loosening,
                  "Expansion at the apex opens a gap between the grains, which compression closes before it meets "
                  "pressure; false: loose sand bears pressure from the first compression on, as in the papers.");
    strength_reduction.add_entry(*this);
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
    strength_reduction.check(get_section_name());
    strength_reduction.reduce(cohesion);
    strength_reduction.reduce_angles(friction_angle, dilatancy_angle);
  }

  std::vector<EntryError> DruckerPrager::doubts() const
  {
    std::vector<EntryError> doubts;
    if ((friction_angle > 0 && friction_angle < 1) || friction_angle > 60)
      doubts.emplace_back(get_section_name(), "Friction angle",
                          "it is " + std::to_string(friction_angle) +
                            " degrees; soils have 15 to 45. Radians and tangents are no degrees.");
    if (dilatancy_angle > 0 && dilatancy_angle < 1)
      doubts.emplace_back(get_section_name(), "Dilatancy angle",
                          "it is " + std::to_string(dilatancy_angle) +
                            " degrees; dense sands have 5 to 15. Radians and tangents are no degrees.");
    return doubts;
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

  namespace
  {
    template <typename Number>
    struct PlasticStep
    {
      Number d_lambda, d_volume; // d_volume: tr(d_p) dt
      Number share;              // of the deviator that goes

      decltype((Number() > Number()) & (Number() > Number())) at_apex;
    };

    struct Cone
    {
      double K, G, alpha, beta, kappa;

      template <typename Number>
      auto yields(const Number &I1, const Number &sqrt_J2) const
      {
        return sqrt_J2 + alpha * I1 - kappa > Number(0.);
      }

      /** The return from a trial stress to the cone or to its apex. */
      template <typename Number>
      PlasticStep<Number> step(const Number &I1, const Number &sqrt_J2) const
      {
        const double apex_I1 = alpha > 0 ? kappa / alpha : 0.; // alpha = 0 has no apex
        const auto   outside = yields(I1, sqrt_J2);
        // On the cone sqrt(J2) would come out negative.
        const auto   at_apex  = outside & (G * (alpha * I1 - kappa) > 9 * K * alpha * beta * sqrt_J2);
        const Number cone     = (sqrt_J2 + alpha * I1 - kappa) / (G + 9 * K * alpha * beta);
        const Number d_lambda = select(outside, select(at_apex, Number(sqrt_J2 / G), cone),
                                       Number(0.)); // such that sqrt(J2) falls by G times it
        return {d_lambda, select(at_apex, Number((I1 - apex_I1) / (3 * K)), Number(3 * beta * d_lambda)),
                select(at_apex, Number(1.), share(d_lambda, sqrt_J2)), at_apex};
      }

      template <typename Number>
      Number share(const Number &d_lambda, const Number &sqrt_J2) const
      {
        // Where sqrt(J2) = 0 the deviator vanishes as well, and any factor will do.
        return G * d_lambda / select(sqrt_J2 > Number(0.), sqrt_J2, Number(1.));
      }

      /** The same where a gap is open: no pressure before it is closed. Changes the gap. */
      template <typename Number>
      PlasticStep<Number> step(const Number &I1, const Number &sqrt_J2, Number &gap) const
      {
        PlasticStep<Number> result = step(I1, sqrt_J2);
        const auto          closes = (gap > Number(0.)) & (I1 - 3 * K * result.d_volume < Number(0.));
        // On the cone the two are the same, but for round-off, which would open it.
        const Number opened =
          gap + select(result.at_apex, Number(result.d_volume - 3 * beta * result.d_lambda), Number(0.));
        if (!any(closes))
        {
          gap = opened;
          return result;
        }
        const auto   closed  = step(Number(I1 + 3 * K * gap), sqrt_J2); // it closes altogether
        const auto   is_open = closed.at_apex | (I1 + 3 * K * (gap - closed.d_volume) > Number(0.));
        const Number shear   = max(Number((sqrt_J2 - kappa) / G), Number(0.)); // dlambda at I1 = 0
        const Number left    = gap + I1 / (3 * K) - 3 * beta * shear;
        const auto   choose  = [&](const Number &open, const Number &shut, const Number &other) {
          return select(closes, select(is_open, open, shut), other);
        };
        result.d_lambda = choose(shear, closed.d_lambda, result.d_lambda);
        result.share    = choose(kappa > 0 ? share(shear, sqrt_J2) : Number(1.), closed.share, result.share);
        result.d_volume = choose(I1 / (3 * K), closed.d_volume - gap, result.d_volume);
        gap             = choose(left, Number(0.), opened);
        return result;
      }
    };
  } // namespace

  void DruckerPrager::update(const MaterialRange &range) const
  {
    const Cone cone{bulk_modulus(), shear_modulus(), alpha(), beta(), kappa()};
    for_each_point(range, [lambda = lame_modulus(), cone, remembers = remembers_loosening](const auto &point) {
      using Number         = std::decay_t<decltype(point.mass())>;
      auto         stress  = elastic_step(point, lambda, cone.G);
      const auto   s       = deviator(stress);
      const Number I1      = trace(stress);
      const Number sqrt_J2 = sqrt(0.5 * (s * s));
      Number       gap     = remembers ? point.state(2) : Number(0.);
      if (any(cone.yields(I1, sqrt_J2) | ((gap > Number(0.)) & (I1 < Number(0.)))))
      {
        const auto plastic = remembers ? cone.step(I1, sqrt_J2, gap) : cone.step(I1, sqrt_J2);
        stress -= plastic.share * s;
        for (unsigned int i = 0; i < 3; ++i)
          stress[i][i] -= cone.K * plastic.d_volume;
        point.set_state(0, point.state(0) + plastic.d_lambda / std::sqrt(3.));
        point.set_state(1, point.state(1) + plastic.d_volume);
        if (remembers)
          point.set_state(2, gap);
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

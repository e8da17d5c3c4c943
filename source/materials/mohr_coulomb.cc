#include <talus/core/eigen.h>
#include <talus/core/exceptions.h>
#include <talus/core/registry.h>
#include <talus/materials/mohr_coulomb.h>
#include <talus/materials/mohr_coulomb_return.h>
#include <talus/materials/point.h>

#include <algorithm>
#include <cmath>

namespace Talus
{
  using namespace dealii;

  MohrCoulomb::MohrCoulomb(const std::string &section) : ElasticMaterial(section)
  {
    add_parameter("Friction angle", friction_angle, "Friction angle phi, at the peak [degrees].", prm,
                  Patterns::Double());
    add_parameter("Dilatancy angle", dilatancy_angle,
                  "Dilatancy angle psi, from 0 (plastic flow keeps the volume) to the friction angle [degrees].", prm,
                  Patterns::Double());
    add_parameter("Cohesion", cohesion, "Cohesion c, at the peak [stress].", prm, Patterns::Double());
    add_parameter("Residual friction angle", residual_friction_angle,
                  "Friction angle after softening [degrees]; negative: it stays.", prm, Patterns::Double());
    add_parameter("Residual dilatancy angle", residual_dilatancy_angle,
                  "Dilatancy angle after softening [degrees]; negative: it stays.", prm, Patterns::Double());
    add_parameter("Residual cohesion", residual_cohesion, "Cohesion after softening [stress]; negative: it stays.", prm,
                  Patterns::Double());
    add_parameter("Softening strain", softening_strain,
                  "Equivalent plastic strain at which the residual values are reached [1].", prm, Patterns::Double());
    softening_slip.add_entries(*this,
                               "In place of a softening strain: slip of a shear band at which the residual values "
                               "are reached");
    add_parameter("Tension strength", tension_strength,
                  "Greatest tension [stress]; negative, or more than c cot(phi): that.", prm, Patterns::Double());
    strength_reduction.add_entry(*this);
  }

  void MohrCoulomb::check_angles(const std::string &prefix, const double friction, const double dilatancy) const
  {
    const std::string name = prefix.empty() ? "Friction angle" : "Residual friction angle",
                      flow = prefix.empty() ? "Dilatancy angle" : "Residual dilatancy angle";
    if (!(friction >= 0 && friction < 90))
      throw EntryError(get_section_name(), name,
                       "it must lie between 0 and 90 degrees, 90 excluded; sand has 30 to 40.");
    if (!(dilatancy >= 0))
      throw EntryError(get_section_name(), flow, "it must not be negative; 0 keeps the volume.");
    if (!(dilatancy <= friction))
      throw EntryError(
        get_section_name(), flow,
        "it must not exceed the friction angle, or plastic flow would create energy. Lower it; 0 keeps the "
        "volume.");
  }

  void MohrCoulomb::parse_parameters(ParameterHandler &prm)
  {
    ElasticMaterial::parse_parameters(prm);
    check_angles("", friction_angle, dilatancy_angle);
    if (!(cohesion >= 0))
      throw EntryError(get_section_name(), "Cohesion", "it must not be negative; dry sand has 0.");
    if (!(cohesion > 0 || friction_angle > 0))
      throw EntryError(
        get_section_name(), "Cohesion",
        "with neither cohesion nor friction the material has no strength. Give one of them, or use a fluid.");
    if (residual_friction_angle < 0)
      residual_friction_angle = friction_angle;
    if (residual_dilatancy_angle < 0)
      residual_dilatancy_angle = std::min(dilatancy_angle, residual_friction_angle);
    if (residual_cohesion < 0)
      residual_cohesion = cohesion;
    check_angles("Residual", residual_friction_angle, residual_dilatancy_angle);
    if (!(softening_strain > 0))
      throw EntryError(get_section_name(), "Softening strain",
                       "it must be positive. A law that does not soften leaves out the residual values.");
    softening_slip.check(get_section_name());
    strength_reduction.check(get_section_name());
    strength_reduction.reduce(cohesion, residual_cohesion, tension_strength);
    strength_reduction.reduce_angles(friction_angle, dilatancy_angle, residual_friction_angle,
                                     residual_dilatancy_angle);
  }

  void MohrCoulomb::set_spacing(const double spacing)
  {
    if (!softening_slip.is_given())
      return;
    softening_strain = softening_slip.strain(spacing);
    // What friction loses hangs on the pressure, and is not known here.
    if (cohesion > residual_cohesion)
      softening_slip.check_spacing(get_section_name(), spacing, cohesion - residual_cohesion, shear_modulus());
  }

  std::vector<EntryError> MohrCoulomb::doubts() const
  {
    std::vector<EntryError> doubts;
    if ((friction_angle > 0 && friction_angle < 1) || friction_angle > 60)
      doubts.emplace_back(get_section_name(), "Friction angle",
                          "it is " + std::to_string(friction_angle) +
                            " degrees; soils have 15 to 45. Radians and tangents are no degrees.");
    return doubts;
  }

  namespace
  {
    double sine(const double degrees) { return std::sin(degrees * numbers::PI / 180); }

    /** A value that goes from its peak to its residual. */
    struct Softening
    {
      double peak, residual;

      template <typename Number>
      Number operator()(const Number &share) const
      {
        return peak + (residual - peak) * share;
      }
    };

    struct Surface
    {
      double    lambda, G, softening_strain, tension_strength;
      Softening sin_phi, sin_psi, cohesion;

      template <typename Number>
      MohrCoulombReturn<Number> at(const Number &plastic_strain) const
      {
        const Number share   = min(Number(plastic_strain / softening_strain), Number(1.));
        const Number s       = sin_phi(share);
        const Number twice_c = 2. * cohesion(share) * sqrt(1. - s * s);
        // Without friction the pyramid has no apex: a limit that no stress reaches.
        const Number apex = select(s > Number(1e-9), twice_c / (2. * max(s, Number(1e-9))), Number(1e3 * G));
        return {lambda,         G,       s,
                sin_psi(share), twice_c, tension_strength < 0 ? apex : min(apex, Number(tension_strength))};
      }
    };

    /** Whether a stress can yield, from its invariants: no principal stress or difference is greater. */
    template <typename Number>
    auto may_yield(const MohrCoulombReturn<Number> &surface, const SymmetricTensor<2, 3, Number> &stress)
    {
      const auto   s       = deviator(stress);
      const Number mean    = trace(stress) / 3.;
      const Number sqrt_J2 = sqrt(0.5 * (s * s));
      const Number face    = 2. * sqrt_J2 + surface.sin_phi * (2. * mean + sqrt_J2 / std::sqrt(3.)) - surface.twice_c;
      return (face > Number(0.)) | (mean + 2. / std::sqrt(3.) * sqrt_J2 > surface.limit);
    }

    /** Swaps so that a >= b, and what belongs to them. */
    template <typename Number>
    void order(Number (&value)[3], Number (&place)[3], const unsigned int a, const unsigned int b)
    {
      const auto is_wrong = value[a] < value[b];
      for (Number(*pair)[3] : {&value, &place})
      {
        const Number x = (*pair)[a], y = (*pair)[b];
        (*pair)[a] = select(is_wrong, y, x);
        (*pair)[b] = select(is_wrong, x, y);
      }
    }

    /** The principal stresses of `system` returned to the surface, in its order. */
    template <typename Number>
    void returned(const MohrCoulombReturn<Number> &surface, const EigenSystem<Number> &system, Number (&result)[3])
    {
      Number value[3] = {system.value[0], system.value[1], system.value[2]}, place[3] = {0., 1., 2.};
      order(value, place, 0, 1);
      order(value, place, 1, 2);
      order(value, place, 0, 1);
      const auto s = surface({{value[0], value[1], value[2]}});
      for (unsigned int a = 0; a < 3; ++a)
      {
        const Number here = static_cast<double>(a);
        result[a]         = select(place[0] == here, s.value[0], select(place[1] == here, s.value[1], s.value[2]));
      }
    }
  } // namespace

  void MohrCoulomb::update(const MaterialRange &range) const
  {
    const Surface surface{lame_modulus(),
                          shear_modulus(),
                          softening_strain,
                          tension_strength,
                          {sine(friction_angle), sine(residual_friction_angle)},
                          {sine(dilatancy_angle), sine(residual_dilatancy_angle)},
                          {cohesion, residual_cohesion}};
    for_each_point(range, [surface](const auto &point) {
      using Number   = std::decay_t<decltype(point.mass())>;
      const double G = surface.G, lambda = surface.lambda;
      auto         stress = elastic_step(point, lambda, G);
      const auto   here   = surface.at(point.state(0));
      const auto   yields = may_yield(here, stress);
      if (any(yields))
      {
        const EigenSystem<Number> system(stress);
        Number                    after[3], strain[3], sum = 0.;
        returned(here, system, after);
        auto has_flown = Number(1.) < Number(0.);
        for (unsigned int a = 0; a < 3; ++a)
        {
          strain[a] = (system.value[a] - after[a]) / (2 * G);
          has_flown = has_flown | !(strain[a] == Number(0.));
          sum += strain[a];
        }
        // D^-1: volumetric / 3 is what all three share.
        const Number volumetric = sum * (2 * G / (3 * lambda + 2 * G));
        Number       squares    = 0.;
        for (const Number &e : strain)
          squares += (e - sum / 3.) * (e - sum / 3.);
        const auto assembled = system.assemble(after);
        for (unsigned int c = 0; c < 6; ++c)
          stress.access_raw_entry(c) = select(has_flown, assembled.access_raw_entry(c), stress.access_raw_entry(c));
        point.set_state(0, point.state(0) + sqrt(2. / 3. * squares));
        point.set_state(1, point.state(1) + volumetric);
      }
      point.set_stress(stress);
    });
  }

  namespace
  {
    const Register<Material, MohrCoulomb> registration(
      "Mohr-Coulomb", "plastic with friction, cohesion, dilatancy and a limit of tension; softening");
  }
} // namespace Talus

#include <talus/core/exceptions.h>
#include <talus/core/registry.h>
#include <talus/materials/point.h>
#include <talus/materials/von_mises.h>

#include <sstream>

namespace Talus
{
  using namespace dealii;

  VonMises::VonMises(const std::string &section) : ElasticMaterial(section)
  {
    add_parameter("Yield stress", yield_stress, "Initial yield stress in uniaxial tension [stress].", prm,
                  Patterns::Double());
    add_parameter("Hardening", hardening, "How the yield stress depends on the equivalent plastic strain.", prm,
                  Patterns::Selection("perfect|linear|exponential softening"));
    add_parameter("Hardening modulus", hardening_modulus,
                  "Of linear hardening: slope of the yield stress over the equivalent plastic strain [stress].", prm,
                  Patterns::Double());
    add_parameter("Residual yield stress", residual_stress,
                  "Of exponential softening: yield stress after large strains [stress].", prm, Patterns::Double());
    add_parameter("Softening rate", softening_rate,
                  "Of exponential softening: eta in exp(-eta times equivalent plastic strain) [1].", prm,
                  Patterns::Double());
    softening_slip.add_entries(*this,
                               "Of exponential softening, in place of a rate: slip of a shear band over which what "
                               "strength is lost falls to 1/e");
    add_parameter("Strength norm", norm,
                  "What of the deviator s the entries bound: von Mises: sqrt(3/2) |s|, tension; deviator: |s|.", prm,
                  Patterns::Selection("von Mises|deviator"));
    strength_reduction.add_entry(*this);
  }

  void VonMises::parse_parameters(ParameterHandler &prm)
  {
    ElasticMaterial::parse_parameters(prm);
    const auto check = [&](const bool holds, const std::string &entry, const std::string &message) {
      if (!holds)
        throw EntryError(get_section_name(), entry, message);
    };
    check(yield_stress > 0, "Yield stress", "it must be positive. Use 'linear elastic' for a material without one.");
    strength_reduction.check(get_section_name());
    strength_reduction.reduce(yield_stress, residual_stress);
    if (hardening == "linear")
      check(hardening_modulus >= 0, "Hardening modulus",
            "it must not be negative. Use 'Hardening = exponential softening' for a falling yield stress.");
    if (hardening == "exponential softening")
    {
      check(residual_stress >= 0 && residual_stress <= yield_stress, "Residual yield stress",
            "it must lie between 0 and the yield stress.");
      softening_slip.check(get_section_name());
      check(softening_rate > 0, "Softening rate",
            "it must be positive. Use 'Hardening = perfect' for a constant yield stress.");
      std::ostringstream greatest;
      const double       range = in_tension() * (yield_stress - residual_stress);
      greatest << 3 * shear_modulus() / range;
      check(
        softening_slip.is_given() || softening_rate * range < 3 * shear_modulus(), "Softening rate",
        "the yield stress falls faster than the stress can follow (3 G), which has no unique answer. Lower it below " +
          greatest.str() + ", or raise Young's modulus.");
    }
    else
      check(!softening_slip.is_given(), "Softening slip", "it belongs to 'Hardening = exponential softening'.");
  }

  void VonMises::set_spacing(const double spacing)
  {
    if (!softening_slip.is_given())
      return;
    softening_rate    = 1 / softening_slip.strain(spacing);
    const double drop = in_tension() * (yield_stress - residual_stress) / std::sqrt(3.); // in shear
    if (drop > 0)
      softening_slip.check_spacing(get_section_name(), spacing, drop, shear_modulus());
  }

  namespace
  {
    template <class Law>
    void radial_return(const MaterialRange &range, const double lambda, const double G, const Law &law)
    {
      for_each_point(range, [lambda, G, law](const auto &point) {
        using Number          = std::decay_t<decltype(point.mass())>;
        auto         stress   = elastic_step(point, lambda, G);
        const auto   s        = deviator(stress);
        const Number strain   = point.state(0);
        const Number q        = sqrt(1.5 * (s * s));
        const Number strength = law.strength(strain);
        const auto   yields   = q > strength;
        if (any(yields))
        {
          // Elastic lanes take part with x = 0.
          const Number x     = select(yields, law.increment(max(q, strength), strain, G), Number(0.));
          const Number scale = 3 * G * x / select(yields, q, Number(1.));
          stress -= scale * s;
          point.set_state(0, strain + x);
        }
        point.set_stress(stress);
      });
    }
  } // namespace

  void VonMises::update(const MaterialRange &range) const
  {
    with_hardening([&](const auto &law) { radial_return(range, lame_modulus(), shear_modulus(), law); });
  }

  void VonMises::plastic_work_densities(const MaterialRange &range, double *densities) const
  {
    with_hardening([&](const auto &law) {
      evaluate_points(range, densities, [law](const auto &point) { return law.work(point.state(0)); });
    });
  }

  namespace
  {
    const Register<Material, VonMises> registration("von Mises",
                                                    "plastic: perfect, linear hardening, exponential softening");
  }
} // namespace Talus

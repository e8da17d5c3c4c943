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
  }

  void VonMises::parse_parameters(ParameterHandler &prm)
  {
    ElasticMaterial::parse_parameters(prm);
    const auto check = [&](const bool holds, const std::string &entry, const std::string &message) {
      if (!holds)
        throw EntryError(get_section_name(), entry, message);
    };
    check(yield_stress > 0, "Yield stress", "it must be positive. Use 'linear elastic' for a material without one.");
    if (hardening == "linear")
      check(hardening_modulus >= 0, "Hardening modulus",
            "it must not be negative. Use 'Hardening = exponential softening' for a falling yield stress.");
    if (hardening == "exponential softening")
    {
      check(residual_stress >= 0 && residual_stress <= yield_stress, "Residual yield stress",
            "it must lie between 0 and the yield stress.");
      check(softening_rate > 0, "Softening rate",
            "it must be positive. Use 'Hardening = perfect' for a constant yield stress.");
      std::ostringstream greatest;
      greatest << 3 * shear_modulus() / (yield_stress - residual_stress);
      check(
        softening_rate * (yield_stress - residual_stress) < 3 * shear_modulus(), "Softening rate",
        "the yield stress falls faster than the stress can follow (3 G), which has no unique answer. Lower it below " +
          greatest.str() + ", or raise Young's modulus.");
    }
  }

  namespace
  {
    struct Perfect
    {
      double yield_stress;

      /** The equivalent plastic strain that a trial stress q above the yield stress adds, from 3 G x = q - sigma_Y. */
      template <typename Number>
      Number increment(const Number &q, const Number & /* strain */, const double G) const
      {
        return (q - yield_stress) / (3 * G);
      }
      template <typename Number>
      Number strength(const Number & /* strain */) const
      {
        return yield_stress;
      }
    };

    struct Linear
    {
      double yield_stress, modulus;

      template <typename Number>
      Number increment(const Number &q, const Number &strain, const double G) const
      {
        return (q - strength(strain)) / (3 * G + modulus);
      }
      template <typename Number>
      Number strength(const Number &strain) const
      {
        return yield_stress + modulus * strain;
      }
    };

    struct Exponential
    {
      double residual, range, rate; // range: initial less residual strength

      /**
       * Newton's method on g(x) = q - 3 G x - sigma_Y(strain + x), which falls and is concave: from the right of the
       * root it comes down to it monotonically, and the first step from x = 0 leads there. The halvings of the worst
       * case, softening at nearly 3 G, need most of the iterations; a usual one takes three.
       */
      template <typename Number>
      Number increment(const Number &q, const Number &strain, const double G) const
      {
        Number x = 0.;
        for (unsigned int i = 0; i < 40; ++i)
        {
          const Number drop = range * exp(-rate * (strain + x));
          const Number g    = q - 3 * G * x - (residual + drop);
          if (!any(abs(g) > 1e-14 * q))
            break;
          x = min(Number(x + g / (3 * G - rate * drop)), Number(q / (3 * G)));
        }
        return x;
      }
      template <typename Number>
      Number strength(const Number &strain) const
      {
        return residual + range * exp(-rate * strain);
      }
    };

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
    const double lambda = lame_modulus(), G = shear_modulus();
    if (hardening == "perfect")
      radial_return(range, lambda, G, Perfect{yield_stress});
    else if (hardening == "linear")
      radial_return(range, lambda, G, Linear{yield_stress, hardening_modulus});
    else
      radial_return(range, lambda, G, Exponential{residual_stress, yield_stress - residual_stress, softening_rate});
  }

  namespace
  {
    const Register<Material, VonMises> registration("von Mises",
                                                    "plastic: perfect, linear hardening, exponential softening");
  }
} // namespace Talus

#include <talus/core/exceptions.h>
#include <talus/core/registry.h>
#include <talus/materials/newtonian_fluid.h>
#include <talus/materials/point.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace Talus
{
  using namespace dealii;

  NewtonianFluid::NewtonianFluid(const std::string &section) : Material(section)
  {
    add_parameter("Viscosity", viscosity, "Dynamic viscosity mu [stress time].", prm, Patterns::Double());
    add_parameter("Sound speed", sound_speed,
                  "Speed of sound c [length/time]; ten times the greatest velocity keeps changes of density near 1 %.",
                  prm, Patterns::Double());
    add_parameter("J smoothing", smoothing,
                  "beta in alpha = min(1, beta c dt/h), the share of the difference to its neighbours' mean that a "
                  "particle's volume loses in a step [1]: 0.1 quiets rows at a slip wall; 0: none.",
                  prm, Patterns::Double());
  }

  void NewtonianFluid::parse_parameters(ParameterHandler &prm)
  {
    Material::parse_parameters(prm);
    if (!(viscosity >= 0))
      throw EntryError(get_section_name(), "Viscosity", "it must not be negative; 0 is a fluid without friction.");
    if (!(sound_speed > 0))
      throw EntryError(get_section_name(), "Sound speed",
                       "it must be positive: choose ten times the greatest velocity that the flow will reach.");
    if (!(smoothing >= 0))
      throw EntryError(get_section_name(), "J smoothing", "it must not be negative; 0.1 is a good choice, 0 is none.");
  }

  void NewtonianFluid::update(const MaterialRange &range) const
  {
    for_each_point(range, [mu = viscosity, c2 = sound_speed * sound_speed, reference = density](const auto &point) {
      const auto d         = symmetrize(point.grad_v());
      auto       stress    = 2 * mu * d;
      const auto isotropic = c2 * (point.density() - reference) + 2. / 3. * mu * trace(d);
      for (unsigned int i = 0; i < 3; ++i)
        stress[i][i] -= isotropic;
      point.set_stress(stress);
    });
  }

  void NewtonianFluid::wave_speeds(const MaterialRange &range, double *speeds) const
  {
    evaluate_points(range, speeds, [c = sound_speed, reference = density](const auto &point) {
      using Number = std::decay_t<decltype(point.mass())>;
      return c * sqrt(max(Number(1.), Number(reference * point.specific_volume())));
    });
  }

  void NewtonianFluid::strain_energy_densities(const MaterialRange &range, double *densities) const
  {
    evaluate_points(range, densities, [c2 = sound_speed * sound_speed, reference = density](const auto &point) {
      const auto rho = point.density();
      return c2 * (rho * log(rho / reference) - (rho - reference));
    });
  }

  double NewtonianFluid::initial_density(const double pressure) const
  {
    const double initial = density + pressure / (sound_speed * sound_speed);
    if (!(initial > 0))
    {
      std::ostringstream message;
      message << "the initial pressure " << pressure
              << " is below what the fluid can bear, -rho c^2: no density gives it. Raise the sound speed, or correct "
                 "the initial stress.";
      throw EntryError(get_section_name(), "Sound speed", message.str());
    }
    return initial;
  }

  std::string NewtonianFluid::refusal(const std::array<double, 6> &initial_stress) const
  {
    const double pressure = -(initial_stress[0] + initial_stress[1] + initial_stress[2]) / 3;
    double       deviator = 0, largest = std::abs(pressure);
    for (unsigned int c = 0; c < 6; ++c)
    {
      deviator = std::max(deviator, std::abs(initial_stress[c] + (c < 3 ? pressure : 0.)));
      largest  = std::max(largest, std::abs(initial_stress[c]));
    }
    if (deviator <= 1e-12 * largest)
      return "";
    return "the material '" + get_section_name().substr(std::string("/Materials/").size()) +
           "' (Newtonian fluid) bears nothing but pressure at rest, and would lose the rest of this stress in the first "
           "step. Give equal normal stresses xx, yy, zz and no shear, or 'Initial stress = hydrostatic'.";
  }

  namespace
  {
    const Register<Material, NewtonianFluid> registration("Newtonian fluid",
                                                          "viscous, nearly incompressible: Morris' equation of state");
  }
} // namespace Talus

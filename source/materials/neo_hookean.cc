#include <talus/core/registry.h>
#include <talus/materials/neo_hookean.h>
#include <talus/materials/point.h>

namespace Talus
{
  using namespace dealii;

  void NeoHookean::update(const MaterialRange &range) const
  {
    for_each_point(range, [lambda = lame_modulus(), mu = shear_modulus()](const auto &point) {
      const auto F         = point.F();
      const auto J         = determinant(F);
      const auto inverse_J = 1. / J;
      auto       stress    = mu * inverse_J * symmetrize(F * transpose(F));
      const auto isotropic = (lambda * log(J) - mu) * inverse_J;
      for (unsigned int i = 0; i < 3; ++i)
        stress[i][i] += isotropic;
      point.set_stress(stress);
    });
  }

  void NeoHookean::wave_speeds(const MaterialRange &range, double *speeds) const
  {
    evaluate_points(range, speeds, [lambda = lame_modulus(), mu = shear_modulus()](const auto &point) {
      using Number         = std::decay_t<decltype(point.mass())>;
      const auto F         = point.F();
      const auto b         = F * transpose(F);
      const auto inverse_J = 1. / determinant(F);
      // Gershgorin: no stretch is greater than the largest sum of a row.
      Number largest = 0.;
      for (unsigned int i = 0; i < 3; ++i)
        largest = max(largest, Number(abs(b[i][0]) + abs(b[i][1]) + abs(b[i][2])));
      return sqrt((lambda * inverse_J + mu * (1. + largest)) * inverse_J * point.specific_volume());
    });
  }

  void NeoHookean::strain_energy_densities(const MaterialRange &range, double *densities) const
  {
    evaluate_points(range, densities, [lambda = lame_modulus(), mu = shear_modulus()](const auto &point) {
      const auto F     = point.F();
      const auto J     = determinant(F);
      const auto log_J = log(J);
      return (0.5 * mu * (trace(F * transpose(F)) - 3. - 2. * log_J) + 0.5 * lambda * log_J * log_J) / J;
    });
  }

  std::string NeoHookean::refusal(const std::array<double, 6> &initial_stress) const
  {
    if (initial_stress == std::array<double, 6>{})
      return "";
    return "the material '" + get_section_name().substr(std::string("/Materials/").size()) +
           "' (neo-Hookean) has its stress from its deformation alone and would lose an initial stress in the first "
           "step. Use 'linear elastic', or 'Initial stress = none' and let the body settle with 'Run/Local damping'.";
  }

  namespace
  {
    const Register<Material, NeoHookean> registration("neo-Hookean", "compressible, finite strains");
  }
} // namespace Talus

#include <talus/core/exceptions.h>
#include <talus/materials/elastic_material.h>
#include <talus/materials/point.h>

namespace Talus
{
  using namespace dealii;

  ElasticMaterial::ElasticMaterial(const std::string &section) : Material(section)
  {
    add_parameter("Young's modulus", youngs_modulus, "Stiffness in uniaxial stress [stress].", prm, Patterns::Double());
    add_parameter("Poisson's ratio", poisson_ratio, "Lateral contraction over extension [1], -1 < nu < 0.5.", prm,
                  Patterns::Double());
  }

  void ElasticMaterial::parse_parameters(ParameterHandler &prm)
  {
    Material::parse_parameters(prm);
    if (!(youngs_modulus > 0))
      throw EntryError(get_section_name(), "Young's modulus", "it must be positive.");
    if (!(poisson_ratio > -1 && poisson_ratio < 0.5))
      throw EntryError(get_section_name(), "Poisson's ratio",
                       "it must lie between -1 and 0.5, both excluded: at 0.5 the bulk modulus is infinite. "
                       "Use 0.49 for a nearly incompressible material.");
  }

  void ElasticMaterial::wave_speeds(const MaterialRange &range, double *speeds) const
  {
    evaluate_points(range, speeds, [M = bulk_modulus() + 4. / 3. * shear_modulus()](const auto &point) {
      return sqrt(M * point.specific_volume()); // Eq. (34)
    });
  }

  void ElasticMaterial::strain_energy_densities(const MaterialRange &range, double *densities) const
  {
    evaluate_points(range, densities, [K = bulk_modulus(), G = shear_modulus()](const auto &point) {
      const auto stress   = point.stress();
      const auto s        = deviator(stress);
      const auto pressure = trace(stress) / 3.;
      return pressure * pressure / (2 * K) + (s * s) / (4 * G);
    });
  }
} // namespace Talus

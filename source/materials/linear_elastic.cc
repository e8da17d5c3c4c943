#include <talus/core/exceptions.h>
#include <talus/core/registry.h>
#include <talus/materials/linear_elastic.h>
#include <talus/materials/update.h>

namespace Talus
{
  using namespace dealii;

  LinearElastic::LinearElastic(const std::string &section) : Material(section)
  {
    add_parameter("Young's modulus", youngs_modulus, "Stiffness in uniaxial stress [stress].", prm, Patterns::Double());
    add_parameter("Poisson's ratio", poisson_ratio, "Lateral contraction over extension [1], -1 < nu < 0.5.", prm,
                  Patterns::Double());
  }

  void LinearElastic::parse_parameters(ParameterHandler &prm)
  {
    Material::parse_parameters(prm);
    if (!(youngs_modulus > 0))
      throw EntryError(get_section_name(), "Young's modulus", "it must be positive.");
    if (!(poisson_ratio > -1 && poisson_ratio < 0.5))
      throw EntryError(get_section_name(), "Poisson's ratio",
                       "it must lie between -1 and 0.5, both excluded: at 0.5 the bulk modulus is infinite. "
                       "Use 0.49 for a nearly incompressible material.");
    pressure_wave_modulus = bulk_modulus() + 4. / 3. * shear_modulus();
  }

  void LinearElastic::update(const MaterialRange &range) const
  {
    const double G = shear_modulus(), lambda = bulk_modulus() - 2. / 3. * G;
    update_stress(range, [=](const Tensor<2, 3> &grad_v_dt, const SymmetricTensor<2, 3> &stress, unsigned int) {
      const SymmetricTensor<2, 3> d = symmetrize(grad_v_dt);
      // Eq. (28)
      return stress + lambda * trace(d) * unit_symmetric_tensor<3>() + 2 * G * d + jaumann_increment(grad_v_dt, stress);
    });
  }

  double LinearElastic::wave_speed(const double rho) const
  {
    return std::sqrt(pressure_wave_modulus / rho); // Eq. (34)
  }

  double LinearElastic::strain_energy_density(const SymmetricTensor<2, 3> &stress) const
  {
    const double pressure = trace(stress) / 3;
    return pressure * pressure / (2 * bulk_modulus()) + deviator(stress) * deviator(stress) / (4 * shear_modulus());
  }

  namespace
  {
    const Register<Material, LinearElastic> registration("linear elastic",
                                                         "isotropic, rate form with the Jaumann rate");
  }
} // namespace Talus

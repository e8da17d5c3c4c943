#include <talus/core/registry.h>
#include <talus/materials/hooke.h>
#include <talus/materials/point.h>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    template <class Point>
    typename Point::Symmetric strain(const Point &point)
    {
      auto epsilon = symmetrize(point.F());
      for (unsigned int i = 0; i < 3; ++i)
        epsilon[i][i] -= 1.;
      return epsilon;
    }
  } // namespace

  void Hooke::update(const MaterialRange &range) const
  {
    for_each_point(range, [lambda = lame_modulus(), mu = shear_modulus()](const auto &point) {
      const auto epsilon   = strain(point);
      const auto isotropic = lambda * trace(epsilon);
      auto       stress    = 2. * mu * epsilon;
      for (unsigned int i = 0; i < 3; ++i)
        stress[i][i] += isotropic;
      point.set_stress(stress);
    });
  }

  void Hooke::wave_speeds(const MaterialRange &range, double *speeds) const
  {
    evaluate_points(range, speeds, [M = bulk_modulus() + 4. / 3. * shear_modulus()](const auto &point) {
      // Of waves along a uniaxial stretch J: they run at the speed of the initial state, over a longer way.
      return sqrt(M * point.specific_volume() * determinant(point.F()));
    });
  }

  void Hooke::strain_energy_densities(const MaterialRange &range, double *densities) const
  {
    evaluate_points(range, densities, [lambda = lame_modulus(), mu = shear_modulus()](const auto &point) {
      const auto epsilon  = strain(point);
      const auto dilation = trace(epsilon);
      return (0.5 * lambda * dilation * dilation + mu * (epsilon * epsilon)) / determinant(point.F());
    });
  }

  std::string Hooke::refusal(const std::array<double, 6> &initial_stress) const
  {
    if (initial_stress == std::array<double, 6>{})
      return "";
    return "the material '" + get_section_name().substr(std::string("/Materials/").size()) +
           "' (Hooke) has its stress from its deformation alone and would lose an initial stress in the first step. "
           "Use 'linear elastic'.";
  }

  namespace
  {
    const Register<Material, Hooke> registration("Hooke", "linear in F, for verification without rotations");
  }
} // namespace Talus

#include <talus/core/registry.h>
#include <talus/materials/linear_elastic.h>
#include <talus/materials/point.h>

namespace Talus
{
  void LinearElastic::update(const MaterialRange &range) const
  {
    for_each_point(range, [lambda = lame_modulus(), G = shear_modulus()](const auto &point) {
      const auto grad_v_dt = point.grad_v_dt();
      const auto old       = point.stress();
      const auto d         = symmetrize(grad_v_dt);
      auto       stress    = old + 2 * G * d + jaumann_increment(grad_v_dt, old); // Eq. (28)
      const auto isotropic = lambda * trace(d);
      for (unsigned int i = 0; i < 3; ++i)
        stress[i][i] += isotropic;
      point.set_stress(stress);
    });
  }

  namespace
  {
    const Register<Material, LinearElastic> registration("linear elastic",
                                                         "isotropic, rate form with the Jaumann rate");
  }
} // namespace Talus

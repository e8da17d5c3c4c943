#include <talus/core/registry.h>
#include <talus/materials/linear_elastic.h>
#include <talus/materials/point.h>

namespace Talus
{
  void LinearElastic::update(const MaterialRange &range) const
  {
    for_each_point(range, [lambda = lame_modulus(), G = shear_modulus()](const auto &point) {
      point.set_stress(elastic_step(point, lambda, G));
    });
  }

  namespace
  {
    const Register<Material, LinearElastic> registration("linear elastic",
                                                         "isotropic, rate form with the Jaumann rate");
  }
} // namespace Talus

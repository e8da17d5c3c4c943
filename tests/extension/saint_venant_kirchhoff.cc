#include <talus/core/registry.h>
#include <talus/materials/elastic_material.h>
#include <talus/materials/point.h>

namespace
{
  /** sigma = F S F^T / J, S = lambda tr(E) I + 2 mu E, E = (F^T F - I)/2. */
  class SaintVenantKirchhoff : public Talus::ElasticMaterial
  {
  public:
    using ElasticMaterial::ElasticMaterial;

    void update(const Talus::MaterialRange &range) const override
    {
      Talus::for_each_point(range, [lambda = lame_modulus(), mu = shear_modulus()](const auto &point) {
        const auto F = point.F();
        auto       E = 0.5 * (transpose(F) * F);
        for (unsigned int i = 0; i < 3; ++i)
          E[i][i] -= 0.5;
        const auto isotropic = lambda * trace(E);
        auto       S         = 2. * mu * E;
        for (unsigned int i = 0; i < 3; ++i)
          S[i][i] += isotropic;
        point.set_stress(symmetrize(F * S * transpose(F)) / determinant(F));
      });
    }

    bool starts_deformed() const override { return true; }
  };

  const Talus::Register<Talus::Material, SaintVenantKirchhoff> registration("Saint Venant-Kirchhoff",
                                                                            "linear in Green's strain");
} // namespace

#include "point.h"

using namespace Test;

namespace hooke
{
  /**
   * Uniaxial strain with nu = 0: the stress is E (a - 1), force per initial area, whatever the stretch a; its energy
   * per initial volume E (a - 1)^2 / 2, waves run at a sqrt(E/rho_0). And the whole tensor with nu = .2.
   */
  void uniaxial_and_general()
  {
    for (const double a : {0.5, 1., 1.3, 3.})
    {
      SinglePoint p("Hooke", set("Young's modulus", "7") + set("Poisson's ratio", "0") + set("Density", "2"), 3);
      p.set_F(diagonal(a, 1, 1));
      p.advance(Tensor<2, 3>(), 1.);
      const std::string name = "stretch " + std::to_string(a);
      check(name + ", stress", distance(p.stress(), diagonal(7 * (a - 1), 0, 0)), 1e-14);
      check(name + ", energy", p.strain_energy_density() * a - 3.5 * (a - 1) * (a - 1), 1e-13);
    }
    const double lambda = 7 * 0.2 / (1.2 * 0.6), mu = 7 / 2.4;
    for (const unsigned int dim : {2, 3})
    {
      SinglePoint        p("Hooke", set("Young's modulus", "7") + set("Poisson's ratio", "0.2"), dim);
      const Tensor<2, 3> I(unit_symmetric_tensor<3>()), F = I + 0.3 * some_tensor(1, dim);
      p.set_F(F);
      p.advance(Tensor<2, 3>(), 1.);
      const Tensor<2, 3> strain = (F + transpose(F)) / 2. - I;
      check("any F, " + std::to_string(dim) + "D", distance(p.stress(), lambda * trace(strain) * I + 2 * mu * strain),
            1e-14);
    }
  }
} // namespace hooke

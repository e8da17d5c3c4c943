#include <talus/simulation/element_point.h>

#include <cmath>

namespace Talus
{
  using namespace dealii;

  ElementPoint::ElementPoint(const Material &material, const std::array<double, 6> &stress) :
    F(unit_symmetric_tensor<3>()), stress(stress), material(&material), seen_F(F),
    mass(initial_volume * material.initial_density(-(stress[0] + stress[1] + stress[2]) / 3))
  {
    const auto states = material.initial_states(stress);
    std::copy(states.begin(), states.end(), state.begin());
    if (material.carries_volume_only())
      seen_F[0][0] = material.density * volume / mass;
  }

  MaterialRange ElementPoint::range(const double dt)
  {
    MaterialRange range;
    range.begin    = 0;
    range.end      = 1;
    range.dt       = dt;
    range.is_plain = true;
    for (unsigned int c = 0; c < 9; ++c)
    {
      range.grad_v[c] = &grad_v[c / 3][c % 3];
      range.F[c]      = &seen_F[c / 3][c % 3];
    }
    for (unsigned int c = 0; c < 6; ++c)
      range.stress[c] = &stress[c];
    range.mass   = &mass;
    range.volume = &volume;
    for (unsigned int s = 0; s < state.size(); ++s)
      range.state[s] = &state[s];
    return range;
  }

  void ElementPoint::advance(const Tensor<2, 3> &increment, const double dt)
  {
    grad_v = increment / dt;
    auto f = dt * grad_v;
    for (unsigned int d = 0; d < 3; ++d)
      f[d][d] += 1.;
    F = f * F;
    volume *= determinant(f);
    if (material->carries_volume_only())
      seen_F[0][0] = material->density * volume / mass;
    else
      seen_F = F;
    if (determinant(f) > 0)
      material->update(range(dt));
  }

  bool ElementPoint::is_sound() const
  {
    return volume > 0 && std::all_of(stress.begin(), stress.end(), [](const double s) { return std::isfinite(s); });
  }

  double ElementPoint::strain_energy_density() const
  {
    ElementPoint copy    = *this;
    double       density = 0;
    material->strain_energy_densities(copy.range(1.), &density);
    return density;
  }

  double ElementPoint::plastic_work_density() const
  {
    ElementPoint copy    = *this;
    double       density = 0;
    material->plastic_work_densities(copy.range(1.), &density);
    return density;
  }

  double ElementPoint::stiffness() const
  {
    ElementPoint copy  = *this;
    double       speed = 0;
    material->wave_speeds(copy.range(1.), &speed);
    return mass / volume * speed * speed;
  }
} // namespace Talus

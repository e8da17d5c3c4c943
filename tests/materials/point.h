#pragma once

#include "../setup.h"

#include <deal.II/base/symmetric_tensor.h>

#include <complex>

namespace Test
{
  using namespace dealii;

  /** One point of a material, of which plane strain (dim = 2) stores fewer components. */
  class SinglePoint
  {
  public:
    SinglePoint(const std::string &type, const std::string &entries, const unsigned int dim)
    {
      Parameters parameters = Parameters::from_text(section("Materials", section("m", set("Type", type) + entries)));
      material              = parameters.make<Material>("/Materials/m", "Type", type, "");
      parameters.parse();
      for (unsigned int c = 0; c < 9; ++c)
      {
        const bool is_stored = dim == 3 || (c / 3 < 2 && c % 3 < 2);
        range.grad_v[c]      = is_stored ? &grad_v[c] : nullptr;
        range.F[c]           = is_stored ? &F[c] : nullptr;
      }
      for (unsigned int c = 0; c < 6; ++c)
        range.stress[c] = dim == 3 || c < 4 ? &sigma[c] : nullptr;
      range.state.fill(nullptr);
      range.begin  = 0;
      range.end    = 1;
      range.mass   = &mass;
      range.volume = &volume;
    }
    SinglePoint(const SinglePoint &) = delete;

    void advance(const Tensor<2, 3> &L, const double dt)
    {
      for (unsigned int c = 0; c < 9; ++c)
        grad_v[c] = L[c / 3][c % 3];
      range.dt = dt;
      material->update(range);
    }

    Tensor<2, 3> stress() const
    {
      Tensor<2, 3> s;
      for (unsigned int d = 0; d < 3; ++d)
        s[d][d] = sigma[d];
      s[0][1] = s[1][0] = sigma[3];
      s[0][2] = s[2][0] = sigma[4];
      s[1][2] = s[2][1] = sigma[5];
      return s;
    }

    void set_stress(const Tensor<2, 3> &s) { sigma = {{s[0][0], s[1][1], s[2][2], s[0][1], s[0][2], s[1][2]}}; }

    double wave_speed() const
    {
      double speed;
      material->wave_speeds(range, &speed);
      return speed;
    }
    double strain_energy_density() const
    {
      double density;
      material->strain_energy_densities(range, &density);
      return density;
    }

    /** The deformation that materials see which depend on F. */
    void set_F(const Tensor<2, 3> &value)
    {
      for (unsigned int c = 0; c < 9; ++c)
        F[c] = value[c / 3][c % 3];
    }

    std::unique_ptr<Material> material;
    double                    mass = 1, volume = 1;

  private:
    MaterialRange         range;
    std::array<double, 9> grad_v{}, F{{1, 0, 0, 0, 1, 0, 0, 0, 1}};
    std::array<double, 6> sigma{};
  };
} // namespace Test

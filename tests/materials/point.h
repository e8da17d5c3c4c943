#pragma once

#include "../setup.h"

#include <deal.II/base/symmetric_tensor.h>

#include <complex>

namespace Test
{
  using namespace dealii;

  /** Rotation by `angle` in the plane of axes a and b, from a to b. */
  inline Tensor<2, 3> rotation(const unsigned int a, const unsigned int b, const double angle)
  {
    Tensor<2, 3> R = unit_symmetric_tensor<3>();
    R[a][a] = R[b][b] = std::cos(angle);
    R[b][a]           = std::sin(angle);
    R[a][b]           = -std::sin(angle);
    return R;
  }

  /** Numbers between -1 and 1 without a pattern; in plane strain without those of the third axis. */
  inline Tensor<2, 3> some_tensor(const double seed, const unsigned int dim = 3)
  {
    Tensor<2, 3> A;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        A[i][j] = std::sin(seed + 2.3 * i + 5.1 * j);
    return A;
  }

  inline Tensor<2, 3> diagonal(const double x, const double y, const double z)
  {
    Tensor<2, 3> A;
    A[0][0] = x, A[1][1] = y, A[2][2] = z;
    return A;
  }

  inline Tensor<2, 3> deviatoric(const Tensor<2, 3> &A)
  {
    return A - trace(A) / 3 * Tensor<2, 3>(unit_symmetric_tensor<3>());
  }

  inline double von_mises(const Tensor<2, 3> &stress) { return std::sqrt(1.5) * deviatoric(stress).norm(); }

  inline double distance(const Tensor<2, 3> &a, const Tensor<2, 3> &b) { return (a - b).norm(); }

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
      for (unsigned int s = 0; s < material->state_names().size(); ++s)
        range.state[s] = &states[s];
      range.begin  = 0;
      range.end    = 1;
      range.mass   = &mass;
      range.volume = &volume;
    }
    SinglePoint(const SinglePoint &) = delete;

    /** One step of the run: deformation gradient and volume, then stress and state. */
    void advance(const Tensor<2, 3> &L, const double dt)
    {
      for (unsigned int c = 0; c < 9; ++c)
        grad_v[c] = L[c / 3][c % 3];
      const Tensor<2, 3> f = Tensor<2, 3>(unit_symmetric_tensor<3>()) + dt * L;
      set_F(f * deformation());
      volume *= determinant(f);
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

    /** As a body starts with it. */
    void set_stress(const Tensor<2, 3> &s)
    {
      sigma            = {{s[0][0], s[1][1], s[2][2], s[0][1], s[0][2], s[1][2]}};
      const auto start = material->initial_states(sigma);
      std::copy(start.begin(), start.end(), states.begin());
    }

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

    Tensor<2, 3> deformation() const
    {
      Tensor<2, 3> value;
      for (unsigned int c = 0; c < 9; ++c)
        value[c / 3][c % 3] = F[c];
      return value;
    }

    std::unique_ptr<Material>                     material;
    double                                        mass = 1, volume = 1;
    std::array<double, MaterialRange::max_states> states{};

  private:
    MaterialRange         range;
    std::array<double, 9> grad_v{}, F{{1, 0, 0, 0, 1, 0, 0, 0, 1}};
    std::array<double, 6> sigma{};
  };

  /**
   * A step at the rate L in which L_xx is such that sigma_xx comes out as wanted: what a testing machine does.
   * Regula falsi by halving the weight of the end that stays, to round-off.
   */
  inline void advance_with_lateral_stress(SinglePoint &p, Tensor<2, 3> &L, const double dt, const double sigma_xx)
  {
    const Tensor<2, 3> stress = p.stress(), F = p.deformation();
    const double       volume = p.volume;
    const auto         states = p.states;
    const auto         error  = [&](const double rate) {
      p.set_stress(stress);
      p.set_F(F);
      p.volume = volume;
      p.states = states;
      L[0][0]  = rate;
      p.advance(L, dt);
      return p.stress()[0][0] - sigma_xx;
    };
    double a = L[0][0] - 10 * L.norm(), b = L[0][0] + 10 * L.norm(), f_a = error(a), f_b = error(b);
    for (unsigned int i = 0; i < 100; ++i)
    {
      const double c = b - f_b * (b - a) / (f_b - f_a), f_c = error(c);
      if (f_c == 0 || std::abs(c - b) < 1e-15 * L.norm())
        return;
      if (f_c * f_b < 0)
        a = b, f_a = f_b;
      else
        f_a /= 2;
      b = c, f_b = f_c;
    }
  }
} // namespace Test

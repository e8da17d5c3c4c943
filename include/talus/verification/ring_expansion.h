#pragma once

#include <talus/verification/standing_wave.h>

namespace Talus
{
  /**
   * Radial motion of a ring around the z axis in plane strain,
   * @f[ u_r = A \sin\frac{\pi c t}{2 \bar r} \, g(R) , \qquad g = c_3 R^3 + c_2 R^2 + c_1 R , \qquad
   *     \bar r = (r_i + r_o) / 2 , @f]
   * with constants that make u_r' zero at both rims. They are free of traction then, if lambda = 0: Poisson's ratio
   * must be 0. The period is @f$ 4 \bar r / c @f$. With the principal stretches F_r = 1 + u_r', F_t = 1 + u_r / R,
   * @f[ b_r = \ddot u_r - \frac{1}{\rho} \left[ P_r' + \frac{P_r - P_t}{R} \right] . @f]
   * Tran et al. (2019), Eqs. 57-59, corrected; after Wallstedt & Guilkey (2008).
   */
  template <int dim>
  class RingExpansion : public StandingWave<dim>
  {
  public:
    using Point  = dealii::Point<dim>;
    using Vector = dealii::Tensor<1, dim>;
    using Matrix = dealii::Tensor<2, dim>;

    explicit RingExpansion(const std::string &section);

    void parse_parameters(dealii::ParameterHandler &prm) override;
    void check(const NeoHookeanConstants &material) const override;

    Vector body_force(const Point &X, const double t) const override;

    using StandingWave<dim>::displacement;

    /** u for any kind of number. */
    template <typename Number>
    std::array<Number, dim> displacement(const std::array<Number, dim> &X, const Number &t) const
    {
      using std::sin;
      using std::sqrt;
      const Number            R      = sqrt(X[0] * X[0] + X[1] * X[1]);
      const Number            factor = amplitude * sin(omega() * t) * (c3 * R * R + c2 * R + c1); // u_r / R
      std::array<Number, dim> u;
      for (unsigned int d = 0; d < dim; ++d)
        u[d] = d < 2 ? Number(factor * X[d]) : Number(0.);
      return u;
    }

  private:
    double omega() const override { return dealii::numbers::PI * this->material.wave_speed() / (inner + outer); }
    Vector shape(const Point &X) const override;
    Matrix shape_gradient(const Point &X) const override;

    double ratio(const double R) const { return (c3 * R + c2) * R + c1; }         // g / R
    double slope(const double R) const { return (3 * c3 * R + 2 * c2) * R + c1; } // g'

    double amplitude = 0.1, inner = 0.4, outer = 0.6;
    double c1 = 0, c2 = 0, c3 = 0;
  };
} // namespace Talus

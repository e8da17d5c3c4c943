#pragma once

#include <talus/verification/manufactured_solution.h>

namespace Talus
{
  /**
   * The generalised vortex: each circle of the ring .75 < R < 1.25 around the z axis turns by its own angle,
   * @f[ x = Q(\alpha) X , \qquad \alpha = A \sin(\pi c t) \, g(R) , \qquad g = (1 - 16 (R - 1)^2)^2 . @f]
   * J = 1, and the rims neither move nor carry traction; lengths are in the unit in which the ring has these radii.
   * Along the current radial and tangential directions
   * @f[ b_r = R (-\dot\alpha^2 + \frac{\mu}{\rho} \alpha'^2) , \qquad
   *     b_t = R \ddot\alpha - \frac{\mu}{\rho} (3 \alpha' + R \alpha'') . @f]
   * Kamojjala et al. (2013); Tran et al. (2019), Eqs. 60-74, corrected.
   */
  template <int dim>
  class Vortex : public ManufacturedSolution<dim>
  {
  public:
    using Point  = dealii::Point<dim>;
    using Vector = dealii::Tensor<1, dim>;
    using Matrix = dealii::Tensor<2, dim>;

    explicit Vortex(const std::string &section);

    Vector displacement(const Point &X, const double t) const override;
    Vector velocity(const Point &X, const double t) const override;
    Matrix deformation_gradient(const Point &X, const double t) const override;
    Matrix deformation_rate(const Point &X, const double t) const override;
    Vector body_force(const Point &X, const double t) const override;

    /** u for any kind of number. */
    template <typename Number>
    std::array<Number, dim> displacement(const std::array<Number, dim> &X, const Number &t) const
    {
      using std::cos;
      using std::sin;
      using std::sqrt;
      const Number            s = sqrt(X[0] * X[0] + X[1] * X[1]) - 1., root = 1. - 16. * s * s;
      const Number            alpha = amplitude * sin(omega() * t) * root * root;
      std::array<Number, dim> u;
      u[0] = cos(alpha) * X[0] - sin(alpha) * X[1] - X[0];
      u[1] = sin(alpha) * X[0] + cos(alpha) * X[1] - X[1];
      if (dim == 3)
        u[dim - 1] = Number(0.);
      return u;
    }

  private:
    double omega() const { return dealii::numbers::PI * this->material.wave_speed(); } // lengths have no unit

    /** What the other functions share at one place and time. */
    struct State
    {
      double R, alpha, alpha_t, alpha_tt, alpha_R, alpha_RR, alpha_Rt;
      Vector N, x; // X / R and the current place, in the plane
    };
    State state(const Point &X, const double t) const;

    /** n x a: the derivative of Q a with respect to the angle is that of Q a turned by a right angle. */
    static Vector turned(const Vector &a)
    {
      Vector result;
      result[0] = -a[1];
      result[1] = a[0];
      return result;
    }

    double amplitude = 1;
  };
} // namespace Talus

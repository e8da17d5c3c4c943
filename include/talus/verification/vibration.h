#pragma once

#include <talus/verification/standing_wave.h>

namespace Talus
{
  /**
   * Axis-aligned vibration of a box with sides on symmetry planes,
   * @f[ u_i = \pm A \sin(k \pi X_i / L) \sin(\pi c t / L) , \qquad c = \sqrt{E / \rho} , @f]
   * + along x and z, - along y, 0 along axes that are not among the entry's. F is diagonal, and each of its numbers
   * a function of one coordinate:
   * @f[ b_i = \frac{\pi^2 u_i}{L^2} \left[ k^2 \frac{\mu}{\rho} - c^2
   *           - k^2 \frac{\lambda (\ln J - 1) - \mu}{\rho F_i^2} \right] . @f]
   * The period is 2 L / c. Needs A k pi / L < 1, so that F_i > 0. Tran et al. (2019), Eqs. 48-51, corrected.
   */
  template <int dim>
  class Vibration : public StandingWave<dim>
  {
  public:
    using Point  = dealii::Point<dim>;
    using Vector = dealii::Tensor<1, dim>;
    using Matrix = dealii::Tensor<2, dim>;

    explicit Vibration(const std::string &section);

    void parse_parameters(dealii::ParameterHandler &prm) override;

    Vector body_force(const Point &X, const double t) const override;

    using StandingWave<dim>::displacement;

    /** u for any kind of number. */
    template <typename Number>
    std::array<Number, dim> displacement(const std::array<Number, dim> &X, const Number &t) const
    {
      using std::sin;
      std::array<Number, dim> u;
      for (unsigned int d = 0; d < dim; ++d)
        u[d] = amplitudes[d] * sin(k() * X[d]) * sin(omega() * t);
      return u;
    }

  private:
    double omega() const override { return dealii::numbers::PI * this->material.wave_speed() / length; }
    Vector shape(const Point &X) const override;
    Matrix shape_gradient(const Point &X) const override;
    double k() const { return wave_number * dealii::numbers::PI / length; } // [1/length]

    double                  amplitude = 0.1, length = 1, wave_number = 2;
    std::string             directions = dim == 2 ? "x, y" : "x, y, z";
    std::array<double, dim> amplitudes; // by axis
  };
} // namespace Talus

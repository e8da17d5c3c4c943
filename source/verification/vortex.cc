#include <talus/core/registry.h>
#include <talus/verification/vortex.h>

namespace Talus
{
  using namespace dealii;

  template <int dim>
  Vortex<dim>::Vortex(const std::string &section) : ManufacturedSolution<dim>(section)
  {
    this->add_parameter("Amplitude", amplitude, "Greatest angle A by which a circle turns [1].", this->prm,
                        Patterns::Double());
  }

  template <int dim>
  typename Vortex<dim>::State Vortex<dim>::state(const Point &X, const double t) const
  {
    const Oscillation sine(omega(), t);
    State             at;
    at.R           = std::hypot(X[0], X[1]);
    const double s = at.R - 1, g = std::pow(1 - 16 * s * s, 2), g_R = -64 * s + 1024 * s * s * s;
    at.alpha    = amplitude * sine.value * g;
    at.alpha_t  = amplitude * sine.first * g;
    at.alpha_tt = amplitude * sine.second * g;
    at.alpha_R  = amplitude * sine.value * g_R;
    at.alpha_Rt = amplitude * sine.first * g_R;
    at.alpha_RR = amplitude * sine.value * (-64 + 3072 * s * s);
    at.N[0]     = X[0] / at.R;
    at.N[1]     = X[1] / at.R;
    at.x        = at.R * (std::cos(at.alpha) * at.N + std::sin(at.alpha) * turned(at.N));
    return at;
  }

  template <int dim>
  Tensor<1, dim> Vortex<dim>::displacement(const Point &X, const double t) const
  {
    const State at = state(X, t);
    return at.x - at.R * at.N;
  }

  template <int dim>
  Tensor<1, dim> Vortex<dim>::velocity(const Point &X, const double t) const
  {
    const State at = state(X, t);
    return at.alpha_t * turned(at.x);
  }

  template <int dim>
  Tensor<2, dim> Vortex<dim>::deformation_gradient(const Point &X, const double t) const
  {
    const State at = state(X, t);
    Matrix      F  = at.alpha_R * outer_product(turned(at.x), at.N); // F = Q + alpha' (-y, x) (x) N
    F[0][0] += std::cos(at.alpha);
    F[1][1] += std::cos(at.alpha);
    F[0][1] -= std::sin(at.alpha);
    F[1][0] += std::sin(at.alpha);
    if (dim == 3)
      F[dim - 1][dim - 1] = 1;
    return F;
  }

  template <int dim>
  Tensor<2, dim> Vortex<dim>::deformation_rate(const Point &X, const double t) const
  {
    const State  at   = state(X, t);
    const Vector rate = at.alpha_Rt * turned(at.x) + at.alpha_R * at.alpha_t * turned(turned(at.x));
    Matrix       F_t  = outer_product(rate, at.N);
    F_t[0][0] -= at.alpha_t * std::sin(at.alpha);
    F_t[1][1] -= at.alpha_t * std::sin(at.alpha);
    F_t[0][1] -= at.alpha_t * std::cos(at.alpha);
    F_t[1][0] += at.alpha_t * std::cos(at.alpha);
    return F_t;
  }

  template <int dim>
  Tensor<1, dim> Vortex<dim>::body_force(const Point &X, const double t) const
  {
    const State  at  = state(X, t);
    const double c2  = this->material.mu / this->material.density; // of shear waves, squared
    const double b_r = at.R * (c2 * at.alpha_R * at.alpha_R - at.alpha_t * at.alpha_t),
                 b_t = at.R * at.alpha_tt - c2 * (3 * at.alpha_R + at.R * at.alpha_RR);
    return (b_r * at.x + b_t * turned(at.x)) / at.R;
  }

  template class Vortex<2>;
  template class Vortex<3>;

  namespace
  {
    const RegisterDimensions<ManufacturedSolution, Vortex> registration("vortex",
                                                                        "generalised vortex in a ring of radius 1");
  }
} // namespace Talus

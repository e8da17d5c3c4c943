#pragma once

#include <deal.II/base/parameter_acceptor.h>
#include <deal.II/base/point.h>
#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <cmath>

namespace Talus
{
  /** Moduli [stress] and initial density of the neo-Hookean body for which a solution is manufactured. */
  struct NeoHookeanConstants
  {
    double lambda = 0, mu = 0.5, density = 1;

    double youngs_modulus() const { return mu * (3 * lambda + 2 * mu) / (lambda + mu); }
    double wave_speed() const { return std::sqrt(youngs_modulus() / density); } // the papers' c
  };

  /**
   * A motion x = X + u(X, t) of a compressible neo-Hookean body, and the body force per mass that makes it one,
   * @f[ b = \ddot u - \frac{1}{\rho_0} \nabla_X \cdot P, \qquad P = \lambda \ln J \, F^{-T} + \mu (F - F^{-T}) , @f]
   * all as functions of the reference position X. The body is undeformed at t = 0: u(X, 0) = 0. A method is verified
   * by its errors against what these functions say of each particle at the place where it began.
   *
   * Sources: Tran, Solowski, Berzins & Guilkey (2019); Kamojjala et al. (2013). Test of all solutions: u as a function
   * of automatically differentiated numbers gives v, F, their rates and b; tests/verification.
   */
  template <int dim>
  class ManufacturedSolution : public dealii::ParameterAcceptor
  {
  public:
    using Point  = dealii::Point<dim>;
    using Vector = dealii::Tensor<1, dim>;
    using Matrix = dealii::Tensor<2, dim>;

    using dealii::ParameterAcceptor::ParameterAcceptor;

    /** Throws EntryError when the solution needs other constants, or its own entries do not go with these. */
    virtual void check(const NeoHookeanConstants &) const {}

    virtual Vector displacement(const Point &X, const double t) const         = 0; // u [length]
    virtual Vector velocity(const Point &X, const double t) const             = 0; // du/dt [length/time]
    virtual Matrix deformation_gradient(const Point &X, const double t) const = 0; // F [1]
    virtual Matrix deformation_rate(const Point &X, const double t) const     = 0; // dF/dt [1/time]
    virtual Vector body_force(const Point &X, const double t) const           = 0; // b [force/mass]

    /** dv/dx = dF/dt F^-1 [1/time]. */
    Matrix velocity_gradient(const Point &X, const double t) const
    {
      return deformation_rate(X, t) * invert(deformation_gradient(X, t));
    }

    /** Cauchy stress @f$ (\lambda \ln J \, I + \mu (F F^T - I)) / J @f$, components of the plane in 2D [stress]. */
    Matrix stress(const Point &X, const double t) const;

    NeoHookeanConstants material;
  };

  /** sin(omega t) and its first two derivatives with respect to time. */
  struct Oscillation
  {
    Oscillation(const double omega, const double t) :
      value(std::sin(omega * t)), first(omega * std::cos(omega * t)), second(-omega * omega * std::sin(omega * t))
    {
    }

    const double value, first, second;
  };
} // namespace Talus

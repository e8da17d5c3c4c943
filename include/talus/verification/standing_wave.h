#pragma once

#include <talus/verification/manufactured_solution.h>

namespace Talus
{
  /** A motion u = U(X) sin(omega t): each particle swings along a line, all of them in step. */
  template <int dim>
  class StandingWave : public ManufacturedSolution<dim>
  {
  public:
    using Point  = dealii::Point<dim>;
    using Vector = dealii::Tensor<1, dim>;
    using Matrix = dealii::Tensor<2, dim>;

    using ManufacturedSolution<dim>::ManufacturedSolution;

    Vector displacement(const Point &X, const double t) const override { return sine(t).value * shape(X); }
    Vector velocity(const Point &X, const double t) const override { return sine(t).first * shape(X); }
    Matrix deformation_rate(const Point &X, const double t) const override { return sine(t).first * shape_gradient(X); }

    Matrix deformation_gradient(const Point &X, const double t) const override
    {
      Matrix F = sine(t).value * shape_gradient(X);
      for (unsigned int d = 0; d < dim; ++d)
        F[d][d] += 1;
      return F;
    }

  protected:
    virtual double omega() const                        = 0; // [1/time]
    virtual Vector shape(const Point &X) const          = 0; // U [length]
    virtual Matrix shape_gradient(const Point &X) const = 0; // dU_i/dX_j [1]

    Oscillation sine(const double t) const { return {omega(), t}; }
  };
} // namespace Talus

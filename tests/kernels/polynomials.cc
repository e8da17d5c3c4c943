#include "points.h"
#include "reference.h"

using namespace Test;

namespace
{
  /** The polynomials of one function beside sums over its nodes, from random values there. */
  template <class Function>
  void compare_polynomials(const std::string &name)
  {
    const Reference::Function reference(name);
    constexpr unsigned int    n           = Function::n;
    double                    value_error = 0, slope_error = 0, moment_error = 0;
    for (unsigned int i = 0; i < 1000; ++i)
    {
      double u[n], a[n];
      for (unsigned int k = 0; k < n; ++k)
        a[k] = u[k] = hashed_jitter(7, i, k);
      Function::to_polynomial(a);
      // The particle's distance from the first node of its stencil.
      const double s = Function::shift + (i + 0.5) / 1000, t = s - Function::centre;
      double       value = 0, slope = 0, moment = 0, p = 0, dp = 0;
      for (unsigned int k = 0; k < n; ++k)
      {
        value += reference.weight(s - k) * u[k];
        slope += reference.derivative(s - k) * u[k];
        moment += reference.weight(s - k) * (k - s) * u[k];
        p += a[k] * std::pow(t, k);
        dp += k == 0 ? 0. : k * a[k] * std::pow(t, k - 1.);
      }
      raise(value_error, p - value);
      raise(slope_error, dp - slope);
      raise(moment_error, Function::second_moment * dp + Function::excess(t) * a[n - 1] - moment);
    }
    check(name + ": value", value_error, 1e-14);
    check(name + ": derivative", slope_error, 1e-14);
    check(name + ": first moment", moment_error, 1e-14);
  }
} // namespace

/** Inside a stencil the field of a B-spline is a polynomial, and so is its first moment: by the recursion of splines.
 */
void polynomials()
{
  compare_polynomials<LinearFunction>("linear");
  compare_polynomials<QuadraticBSpline>("quadratic B-spline");
  compare_polynomials<CubicBSpline>("cubic B-spline");
}

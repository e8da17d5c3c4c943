#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

/** Kernel functions from their definitions, not from the formulas of the code under test. */
namespace Reference
{
  /** Centred B-spline of degree k by the recursion of Cox and de Boor; r in units of the spacing. */
  inline double b_spline(const int k, const double r)
  {
    if (k == 0)
      return r >= -0.5 && r < 0.5 ? 1. : 0.;
    const double half = 0.5 * (k + 1);
    return ((half + r) * b_spline(k - 1, r + 0.5) + (half - r) * b_spline(k - 1, r - 0.5)) / k;
  }

  /** Integral of the hat function from -infinity to r. */
  inline double hat_integral(const double r)
  {
    if (r <= 0)
      return 0.5 * std::pow(std::max(0., 1 + r), 2);
    return 1 - 0.5 * std::pow(std::max(0., 1 - r), 2);
  }

  struct Function
  {
    explicit Function(const std::string &kernel) :
      degree(kernel == "linear"             ? 1 :
             kernel == "quadratic B-spline" ? 2 :
             kernel == "cubic B-spline"     ? 3 :
                                              0),
      support(degree > 0 ? 0.5 * (degree + 1) : 1 + lp)
    {
    }
    /** The hat averaged over [r - lp, r + lp] for uGIMP (degree 0 here). */
    double weight(const double r) const
    {
      return degree > 0 ? b_spline(degree, r) : (hat_integral(r + lp) - hat_integral(r - lp)) / (2 * lp);
    }
    double derivative(const double r) const
    {
      if (degree > 0)
        return b_spline(degree - 1, r + 0.5) - b_spline(degree - 1, r - 0.5);
      return (b_spline(1, r + lp) - b_spline(1, r - lp)) / (2 * lp);
    }

    static constexpr double lp = 0.25;
    int                     degree;
    double                  support;
  };

  const std::vector<std::string> kernels = {"linear", "quadratic B-spline", "cubic B-spline", "uGIMP"};
} // namespace Reference

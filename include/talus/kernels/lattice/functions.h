#pragma once

#include <talus/core/simd.h>

#include <deal.II/base/parameter_acceptor.h>

#include <variant>

namespace Talus
{
  /** Linear hat, FE_Q(1): 1 - |r| for |r| < 1. */
  struct LinearFunction
  {
    static constexpr unsigned int n              = 2;
    static constexpr double       shift          = 0;
    static constexpr double       boundary_scale = 1;
    static constexpr double       second_moment  = 0;

    double support() const { return 1; }
    void   add_parameters(dealii::ParameterAcceptor &) {}
    template <typename Number>
    void evaluate(const Number &s, Number *weight, Number *derivative) const
    {
      weight[0]     = 1 - s;
      weight[1]     = s;
      derivative[0] = -1.;
      derivative[1] = 1.;
    }

    static constexpr bool   is_polynomial = true;
    static constexpr double centre        = 0;
    template <typename Values>
    static void to_polynomial(Values &u)
    {
      u[1] -= u[0];
    }
    template <typename Number>
    static Number excess(const Number &t)
    {
      return t * (1. - t);
    }
  };

  /** Quadratic B-spline, Eq. (51): support 3/2. */
  struct QuadraticBSpline
  {
    static constexpr unsigned int n              = 3;
    static constexpr double       shift          = 0.5;
    static constexpr double       boundary_scale = 4. / 3.;
    static constexpr double       second_moment  = 1. / 4.;

    double support() const { return 1.5; }
    void   add_parameters(dealii::ParameterAcceptor &) {}
    template <typename Number>
    void evaluate(const Number &s, Number *weight, Number *derivative) const
    {
      // s in [1/2, 3/2): the middle node is the nearest.
      weight[0]     = 0.5 * (1.5 - s) * (1.5 - s);
      weight[1]     = 0.75 - (s - 1) * (s - 1);
      weight[2]     = 0.5 * (s - 0.5) * (s - 0.5);
      derivative[0] = s - 1.5;
      derivative[1] = -2 * (s - 1);
      derivative[2] = s - 0.5;
    }

    static constexpr bool   is_polynomial = true;
    static constexpr double centre        = 1;
    template <typename Values>
    static void to_polynomial(Values &u)
    {
      const auto slope = 0.5 * (u[2] - u[0]), curvature = 0.5 * (u[2] + u[0]) - u[1];
      u[0] = u[1] + 0.25 * curvature;
      u[1] = slope;
      u[2] = curvature;
    }
    template <typename Number>
    static Number excess(const Number &t)
    {
      return t * (0.25 - t * t);
    }
  };

  /** Cubic B-spline: 2/3 - r^2 + |r|^3 / 2 for |r| < 1, (2 - |r|)^3 / 6 up to the support 2. */
  struct CubicBSpline
  {
    static constexpr unsigned int n              = 4;
    static constexpr double       shift          = 1;
    static constexpr double       boundary_scale = 1.5;
    static constexpr double       second_moment  = 1. / 3.;

    double support() const { return 2; }
    void   add_parameters(dealii::ParameterAcceptor &) {}
    template <typename Number>
    void evaluate(const Number &s, Number *weight, Number *derivative) const
    {
      // t in [0, 1): distance from the second node.
      const Number t = s - 1., u = 1. - t;
      weight[0]     = u * u * u / 6;
      weight[1]     = 2. / 3. - t * t + t * t * t / 2;
      weight[2]     = 2. / 3. - u * u + u * u * u / 2;
      weight[3]     = t * t * t / 6;
      derivative[0] = -u * u / 2;
      derivative[1] = t * (1.5 * t - 2);
      derivative[2] = -u * (1.5 * u - 2);
      derivative[3] = t * t / 2;
    }

    static constexpr bool   is_polynomial = true;
    static constexpr double centre        = 1;
    template <typename Values>
    static void to_polynomial(Values &u)
    {
      const auto slope = 0.5 * (u[2] - u[0]), curvature = 0.5 * (u[2] + u[0]) - u[1];
      u[3] = (u[3] - u[0]) * (1. / 6) + 0.5 * (u[1] - u[2]);
      u[0] = u[1] + (1. / 3) * curvature;
      u[1] = slope;
      u[2] = curvature;
    }
    template <typename Number>
    static Number excess(const Number &t)
    {
      const Number product = t * (1. - t);
      return -product * product;
    }
  };

  /**
   * uGIMP, Bardenhagen & Kober (2004): the hat averaged over a particle's
   * undeformed box of half length lp [h].
   */
  struct GimpFunction
  {
    static constexpr unsigned int n              = 3;
    static constexpr double       shift          = 0.5;
    static constexpr double       boundary_scale = 0;
    static constexpr double       second_moment  = 0;

    double lp = 0.25;

    double support() const { return 1 + lp; }
    void   add_parameters(dealii::ParameterAcceptor &object)
    {
      object.add_parameter("Half length", lp,
                           "Half edge of a particle's box in units of the spacing [1]: 1 / (2 n) for n particles per "
                           "cell and direction.",
                           object.prm, dealii::Patterns::Double(1e-3, 0.5));
    }
    template <typename Number>
    void evaluate(const Number &s, Number *weight, Number *derivative) const
    {
      for (unsigned int k = 0; k < n; ++k)
      {
        const Number r = s - static_cast<double>(k), d = abs(r), sign = select(r < Number(0.), Number(-1.), Number(1.));
        // From the middle outwards: |r| < lp, < 1 - lp, < 1 + lp, and nothing beyond.
        const Number tail = max(Number(1 + lp - d), Number(0.));
        weight[k]         = select(d < Number(1 - lp), 1. - d, tail * tail / (4 * lp));
        weight[k]         = select(d < Number(lp), 1. - (d * d + lp * lp) / (2 * lp), weight[k]);
        derivative[k]     = select(d < Number(1 - lp), -sign, -sign * tail / (2 * lp));
        derivative[k]     = select(d < Number(lp), -r / lp, derivative[k]);
      }
    }

    static constexpr bool is_polynomial = false; // but of several pieces
  };

  // second_moment: sum phi_i (x_i - x)^2 along an axis, if it is the same everywhere, or 0 [h^2].
  // is_polynomial: whether sum phi_i u_i is one polynomial p in t = s - centre throughout a stencil. Then
  //   to_polynomial(u) turns the values at the nodes into its coefficients, and
  //   sum phi_i (x_i - x) u_i = second_moment p'(t) + excess(t) c [h], c being the last coefficient.

  /** All of them: the batched loops are compiled for each. */
  using ProductFunction = std::variant<LinearFunction, QuadraticBSpline, CubicBSpline, GimpFunction>;
} // namespace Talus

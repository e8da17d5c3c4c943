#pragma once

#include <talus/core/simd.h>

namespace Talus
{
  /**
   * The weights b(q) of moving least squares, functions of the distance q over the length s: centred B-splines, which
   * vanish from `reach` on. `slope_over_q` is b'(q)/q, finite at q = 0.
   */
  struct CubicWeight
  {
    static constexpr double reach = 2;

    template <class Number>
    static Number value(const Number &q)
    {
      const Number t = max(2. - q, Number(0.)), u = max(1. - q, Number(0.));
      return (t * t * t - 4. * u * u * u) * (1. / 6);
    }
    template <class Number>
    static Number slope_over_q(const Number &q)
    {
      const Number t = max(2. - q, Number(0.));
      return select(q < 1., 1.5 * q - 2., -0.5 * t * t / max(q, Number(1.)));
    }
  };

  struct QuadraticWeight
  {
    static constexpr double reach = 1.5;

    template <class Number>
    static Number value(const Number &q)
    {
      const Number t = max(1.5 - q, Number(0.)), u = max(0.5 - q, Number(0.));
      return 0.5 * (t * t - 3. * u * u);
    }
    template <class Number>
    static Number slope_over_q(const Number &q)
    {
      const Number t = max(1.5 - q, Number(0.));
      return select(q < 0.5, Number(-2.), -t / max(q, Number(0.5)));
    }
  };
} // namespace Talus

#pragma once

#include <talus/core/simd.h>

namespace Talus
{
  /**
   * How the yield stress sigma_Y [stress] depends on the equivalent plastic strain. Each law gives the strength at a
   * strain, and the strain x that a trial stress q >= sigma_Y adds, from
   * @f[ 3 G x = q - \sigma_Y(\bar\varepsilon + x) , @f]
   * and the work that the flow up to a strain has taken, the integral of the strength over it [energy/volume].
   * Functions of one number, double or SIMD. Test: tests/materials/von_mises.cc.
   */
  struct PerfectPlasticity
  {
    double yield_stress;

    template <typename Number>
    Number increment(const Number &q, const Number & /* strain */, const double G) const
    {
      return (q - yield_stress) / (3 * G);
    }
    template <typename Number>
    Number strength(const Number & /* strain */) const
    {
      return yield_stress;
    }
    template <typename Number>
    Number work(const Number &strain) const
    {
      return yield_stress * strain;
    }
  };

  struct LinearHardening
  {
    double yield_stress, modulus;

    template <typename Number>
    Number increment(const Number &q, const Number &strain, const double G) const
    {
      return (q - strength(strain)) / (3 * G + modulus);
    }
    template <typename Number>
    Number strength(const Number &strain) const
    {
      return yield_stress + modulus * strain;
    }
    template <typename Number>
    Number work(const Number &strain) const
    {
      return (yield_stress + 0.5 * modulus * strain) * strain;
    }
  };

  struct ExponentialSoftening
  {
    double residual, range, rate; // range: initial less residual strength

    /**
     * Newton's method on g(x) = q - 3 G x - sigma_Y(strain + x), which falls and is concave: from the right of the
     * root it comes down to it monotonically, and the first step from x = 0 leads there. The halvings of the worst
     * case, softening at nearly 3 G, need most of the iterations; a usual one takes three.
     */
    template <typename Number>
    Number increment(const Number &q, const Number &strain, const double G) const
    {
      Number x = 0.;
      for (unsigned int i = 0; i < 40; ++i)
      {
        const Number drop = range * exp(-rate * (strain + x));
        const Number g    = q - 3 * G * x - (residual + drop);
        if (!any(abs(g) > 1e-14 * q))
          break;
        x = min(Number(x + g / (3 * G - rate * drop)), Number(q / (3 * G)));
      }
      return x;
    }
    template <typename Number>
    Number strength(const Number &strain) const
    {
      return residual + range * exp(-rate * strain);
    }
    template <typename Number>
    Number work(const Number &strain) const
    {
      return residual * strain + range / rate * (1. - exp(-rate * strain));
    }
  };
} // namespace Talus

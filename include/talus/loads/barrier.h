#pragma once

#include <cmath>

namespace Talus
{
  /**
   * The barrier of Li et al. (2020), by which a wall keeps material at a distance d > 0,
   * @f[ b(d) = -(d - \hat d)^2 \ln\frac{d}{\hat d} , \quad 0 < d < \hat d ; \qquad b(d) = 0 , \quad d \ge \hat d , @f]
   * twice continuously differentiable. Times the stiffness [stress/length] it is an energy per area [length^2].
   * Theory: doc/contact.md. Test: tests/loads/barrier.cc.
   */
  struct Barrier
  {
    double reach; // d-hat [length]

    double value(const double d) const { return d < reach ? -(d - reach) * (d - reach) * std::log(d / reach) : 0; }

    /** b'(d) <= 0 [length] */
    double slope(const double d) const
    {
      return d < reach ? (reach - d) * (2 * std::log(d / reach) - (reach - d) / d) : 0;
    }

    /** b''(d) >= 0 [1] */
    double curvature(const double d) const
    {
      const double e = (reach - d) / d;
      return d < reach ? -2 * std::log(d / reach) + (4 + e) * e : 0;
    }

    /** The stiffness with which a point at half the reach bears this pressure [stress/length]. */
    double stiffness(const double pressure) const { return -pressure / slope(reach / 2); }
  };

  /** Friction over its greatest value, of slip over the slip from which on it is that: 2 y - y^2, then 1. */
  inline double friction_share(const double y) { return y < 1 ? (2 - y) * y : 1; }
} // namespace Talus

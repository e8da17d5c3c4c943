#pragma once

#include <talus/core/simd.h>

#include <cmath>

namespace Talus
{
  /**
   * Principal stresses on the surface of MohrCoulomb, from those of a trial stress. With e the vector (1, 1, 1), the
   * plastic flow n of an active face takes
   * @f[ D n = \lambda (n \cdot e)\, e + 2 G n @f]
   * from the stress for each unit of its multiplier. Faces are F of a pair of principal stresses, 13, 23 or 12, and the
   * limits of tension of the first, the first two, or all three; those that are active together give the plane, the
   * lines (edges of the pyramid, its meeting with the limits) and the points of the surface. Of all, that return stands
   * whose multipliers and distance from the other faces are least wrong: of the right one, nothing is.
   *
   * All numbers are those of a batch, `Number` being double or SIMD. Test: tests/materials/mohr_coulomb.cc.
   */
  template <typename Number>
  struct MohrCoulombReturn
  {
    double lambda, G;                 // [stress]
    Number sin_phi, sin_psi, twice_c; // twice_c: 2 c cos phi [stress]
    Number limit;                     // of tension [stress]

    /** Principal stresses from the greatest to the least. */
    struct Principal
    {
      Number value[3];
    };

    /** F of a greater and a smaller principal stress; positive: yields. */
    Number face(const Number &greater, const Number &smaller) const
    {
      return (1. + sin_phi) * greater - (1. - sin_phi) * smaller - twice_c;
    }

    /** How far an ordered stress lies beyond the surface [stress]. */
    Number excess(const Principal &s) const { return max(face(s.value[0], s.value[2]), s.value[0] - limit); }

    /** The stress on the surface to which an ordered trial stress returns; where that does not yield, itself. */
    Principal operator()(const Principal &trial) const
    {
      Best best{trial, max(excess(trial), Number(0.))};
      to_plane(trial, best);
      to_edge(trial, 0, best);
      to_edge(trial, 2, best);
      to_limits(trial, best);
      to_meeting(trial, best);
      to_corners(trial, best);
      return best.stress;
    }

  private:
    struct Best
    {
      Principal stress;
      Number    wrong; // [stress]
    };

    /** Takes what is less wrong; what is not ordered is measured by its greatest and least stress. */
    void offer(const Principal &s, const Number &least_multiplier, Best &best) const
    {
      const Number greatest = max(s.value[0], max(s.value[1], s.value[2])),
                   least    = min(s.value[0], min(s.value[1], s.value[2]));
      const Number wrong =
        max(max(face(greatest, least), Number(greatest - limit)), Number(-2. * G * least_multiplier));
      const Number clipped   = max(wrong, Number(0.));
      const auto   is_better = clipped < best.wrong;
      for (unsigned int i = 0; i < 3; ++i)
        best.stress.value[i] = select(is_better, s.value[i], best.stress.value[i]);
      best.wrong = select(is_better, clipped, best.wrong);
    }

    /** Less D n for the flow of the pair i, j: greater, smaller. */
    void flow(Principal &s, const unsigned int i, const unsigned int j, const Number &multiplier) const
    {
      for (Number &value : s.value)
        value -= 2. * lambda * sin_psi * multiplier;
      s.value[i] -= 2. * G * (1. + sin_psi) * multiplier;
      s.value[j] += 2. * G * (1. - sin_psi) * multiplier;
    }

    /** Less D n for the flow of the limit of tension of stress i. */
    void part(Principal &s, const unsigned int i, const Number &multiplier) const
    {
      for (Number &value : s.value)
        value -= lambda * multiplier;
      s.value[i] -= 2. * G * multiplier;
    }

    /** What a unit of its own flow takes from F. */
    Number own() const { return 4. * lambda * sin_phi * sin_psi + 4. * G * (1. + sin_phi * sin_psi); }

    void to_plane(const Principal &trial, Best &best) const
    {
      const Number multiplier = face(trial.value[0], trial.value[2]) / own();
      Principal    s          = trial;
      flow(s, 0, 2, multiplier);
      offer(s, multiplier, best);
    }

    /** The edge on which stress 1 equals stress `end`: 0, where the faces 13 and 23 meet, or 2, of 13 and 12. */
    void to_edge(const Principal &trial, const unsigned int end, Best &best) const
    {
      const unsigned int i = end == 0 ? 1 : 0, j = end == 0 ? 2 : 1; // the other pair
      const Number sign = end == 0 ? Number(1. - sin_phi) * (1. - sin_psi) : Number(1. + sin_phi) * (1. + sin_psi);
      const Number other =
        4. * lambda * sin_phi * sin_psi + 2. * G * sign; // what the flow of one takes from F of the other
      const Number a = own(), f = face(trial.value[0], trial.value[2]), g = face(trial.value[i], trial.value[j]);
      const Number determinant = (a - other) * (a + other);
      const Number first = (a * f - other * g) / determinant, second = (a * g - other * f) / determinant;
      Principal    s = trial;
      flow(s, 0, 2, first);
      flow(s, i, j, second);
      s.value[1] = s.value[end];
      offer(s, min(first, second), best);
    }

    /** The limit of tension of the first stress, and of the first two. */
    void to_limits(const Principal &trial, Best &best) const
    {
      const double a = lambda + 2 * G;
      const Number x = trial.value[0] - limit, y = trial.value[1] - limit;
      Principal    s = trial;
      part(s, 0, x / a);
      s.value[0] = limit;
      offer(s, x / a, best);
      const Number first  = (a * x - lambda * y) / ((a - lambda) * (a + lambda)),
                   second = (a * y - lambda * x) / ((a - lambda) * (a + lambda));
      s                   = trial;
      part(s, 0, first);
      part(s, 1, second);
      s.value[0] = s.value[1] = limit;
      offer(s, min(first, second), best);
    }

    /** The line where the plane meets the limit of the first stress. */
    void to_meeting(const Principal &trial, Best &best) const
    {
      const Number x = trial.value[0] - limit, f = face(trial.value[0], trial.value[2]);
      const Number xx = lambda + 2. * G, xf = 2. * lambda * sin_psi + 2. * G * (1. + sin_psi),
                   fx = 2. * lambda * sin_phi + 2. * G * (1. + sin_phi), ff = own();
      const Number determinant = xx * ff - xf * fx;
      const Number apart = (ff * x - xf * f) / determinant, multiplier = (xx * f - fx * x) / determinant;
      Principal    s = trial;
      part(s, 0, apart);
      flow(s, 0, 2, multiplier);
      s.value[0] = limit;
      s.value[2] = least_at_limit();
      offer(s, min(apart, multiplier), best);
    }

    /** The smallest stress that may be with one at the limit of tension. */
    Number least_at_limit() const { return ((1. + sin_phi) * limit - twice_c) / (1. - sin_phi); }

    /** The points: where the limit meets the edges, and where all three stresses have reached it. */
    void to_corners(const Principal &trial, Best &best) const
    {
      const Number least = least_at_limit(), up = 1. + sin_psi, down = 1. - sin_psi;
      Number       e[3];
      // One stress at the limit: multipliers of the faces 13 and 12, and of the limit.
      strains(trial, {{limit, least, least}}, e);
      offer({{limit, least, least}}, min(min(-e[1] / down, -e[2] / down), Number(e[0] + up / down * (e[1] + e[2]))),
            best);
      // Two: the strain of the third is the sum of the faces 13 and 23, which may share it as the limits need.
      strains(trial, {{limit, limit, least}}, e);
      offer({{limit, limit, least}}, min(min(e[0], e[1]), min(-e[2] / down, Number(e[0] + e[1] + up / down * e[2]))),
            best);
      strains(trial, {{limit, limit, limit}}, e);
      offer({{limit, limit, limit}}, min(e[0], min(e[1], e[2])), best);
    }

    /** D^-1 (trial - s). */
    void strains(const Principal &trial, const Principal &s, Number (&e)[3]) const
    {
      Number sum = 0.;
      for (unsigned int i = 0; i < 3; ++i)
      {
        e[i] = (trial.value[i] - s.value[i]) / (2. * G);
        sum += e[i];
      }
      for (Number &x : e)
        x -= lambda / (3. * lambda + 2. * G) * sum;
    }
  };
} // namespace Talus

#pragma once

#include <talus/particles/kept_positions.h>
#include <talus/steppers/model.h>

namespace Talus
{
  /**
   * Modified update stress last (Sulsky, Zhou & Schreyer 1995): the velocity gradient that deforms the particles is not
   * that of the step's own nodal velocities but of
   * @f[ v_i = \frac{\sum_p m_p \phi_{ip}(x^n) (v_p^{n+1} + C_p (x_i - x_p))}{m_i} , @f]
   * the particles' new velocities scattered once more from where they were, which the conditions then change as they
   * did before. A node of small mass has v = (small momentum) / (small mass) now, and not a large force over a small
   * mass. Costs nearly another transfer. Sums of the conditions, lost momentum and mirrored forces stay those of the
   * step. Test: tests/steppers.
   */
  template <int dim>
  class Musl
  {
  public:
    Musl();

    /** Remembers where the particles are, before they move. */
    void start(const Particles<dim> &particles) { positions.keep(particles); }

    /** Sets grad v of particles that have moved in a step from `time`. Collective. */
    void apply(Model<dim> &model, const double time, const double dt);

  private:
    BodyForce<dim>     no_force;
    KeptPositions<dim> positions;
  };
} // namespace Talus

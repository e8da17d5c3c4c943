#pragma once

#include <talus/core/reduction.h>

#include <string>

namespace Talus
{
  /** What is known of all particles after a step; the parts of the model know what they did themselves. */
  struct Report
  {
    double signal_speed     = 0; // max (c_p + |v_p|) [length/time], Eq. (35)
    double displacement     = 0; // largest of a particle in the last step [spacing]
    bool   needs_migration  = false;
    bool   needs_activation = false;

    double mass             = 0; // [mass]
    double kinetic_energy   = 0; // [energy]
    double body_force_power = 0; // sum m b . v [energy/time]

    bool        has_failed = false; // a particle broke a limit of validity
    std::string failure, remedy;    // then: which did so where, and what to do

    void add_to(Reduction &reduction)
    {
      reduction.max(signal_speed);
      reduction.max(displacement);
      reduction.any(needs_migration);
      reduction.any(needs_activation);
      reduction.any(has_failed);
      reduction.sum(mass);
      reduction.sum(kinetic_energy);
      reduction.sum(body_force_power);
    }
  };

  /** The end of a step, or the begin of the run. */
  struct Moment
  {
    unsigned int step = 0;
    double       time = 0, dt = 0; // the step has led to `time` [time]

    /** As it stands in messages: " in step 3, t = 0.1, dt = 0.01". */
    std::string text() const;
  };
} // namespace Talus

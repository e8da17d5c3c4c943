#pragma once

#include <talus/core/archive.h>
#include <talus/core/reduction.h>

#include <array>
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

    double n_particles      = 0;
    double most_particles   = 0; // that a rank has
    double mass             = 0; // [mass]
    double kinetic_energy   = 0; // [energy]
    double body_force_power = 0; // over the ways that particles have gone in the step [energy/time]

    std::array<double, 3> moment{}; // sum m (x - X), of the ways from the start [mass length]

    bool        has_failed = false; // a particle broke a limit of validity
    std::string failure, remedy;    // then: which did so where, and what to do
    std::string news;               // a sentence for the log, or nothing

    void add_to(Reduction &reduction)
    {
      reduction.max(signal_speed);
      reduction.max(displacement);
      reduction.max(most_particles);
      reduction.any(needs_migration);
      reduction.any(needs_activation);
      reduction.any(has_failed);
      reduction.sum(n_particles);
      reduction.sum(mass);
      reduction.sum(kinetic_energy);
      reduction.sum(body_force_power);
      for (double &component : moment)
        reduction.sum(component);
    }

    void serialize(Archive &archive)
    {
      const Archive::Scope scope(archive, "report");
      archive("signal speed", signal_speed);
      archive("displacement", displacement);
      archive("most particles", most_particles);
      archive("needs migration", needs_migration);
      archive("needs activation", needs_activation);
      archive("mass", mass);
      archive("kinetic energy", kinetic_energy);
      archive("body force power", body_force_power);
      archive("moment x", moment[0]);
      archive("moment y", moment[1]);
      archive("moment z", moment[2]);
    }
  };

  /** The end of a step, or the begin of the run. */
  struct Moment
  {
    unsigned int step = 0;
    double       time = 0, dt = 0; // the step has led to `time` [time]

    /** As it stands in messages: " in step 3, t = 0.1, dt = 0.01". */
    std::string text() const;

    void serialize(Archive &archive)
    {
      archive("step", step);
      archive("time", time);
      archive("step size", dt);
    }
  };
} // namespace Talus

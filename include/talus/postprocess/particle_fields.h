#pragma once

#include <talus/core/component_names.h>
#include <talus/particles/working_set.h>

#include <functional>
#include <string>
#include <vector>

namespace Talus
{
  /** A named quantity that can be written for each particle: a field of the working set, or derived from some. */
  template <int dim>
  struct ParticleField
  {
    /** Writes the components of particle `p` to the last argument. */
    using Evaluate = std::function<void(const WorkingSet<dim> &, const unsigned int p, double *)>;

    std::string              name;       // as in the parameter file
    std::string              unit;       // "stress", "1"; empty when it is not known
    std::vector<std::string> components; // "velocity_x", ...; blanks become underscores
    bool                     is_vector;  // dim components along the axes
    Evaluate                 evaluate;
  };

  /**
   * All quantities that a run can write: every field of `particles` and, derived, body, material, rank,
   * displacement, von Mises stress, pressure, density, volume ratio, deviatoric
   * strain, vorticity and kinetic energy density. The result refers to fields by number, not to `particles`.
   */
  template <int dim>
  std::vector<ParticleField<dim>> all_particle_fields(const WorkingSet<dim> &particles);

  /**
   * Those with the given names, in their order and each once. Throws an EntryError
   * for `entry` of `section` that lists the choices when there is no such field.
   */
  template <int dim>
  std::vector<ParticleField<dim>> select_particle_fields(const WorkingSet<dim>          &particles,
                                                         const std::vector<std::string> &names,
                                                         const std::string &section, const std::string &entry);

  /** Takes `names` out of `chosen`. */
  void leave_out(const std::vector<std::string> &names, std::vector<std::string> &chosen);

  /** Number of components of all fields together. */
  template <int dim>
  unsigned int n_components(const std::vector<ParticleField<dim>> &fields)
  {
    unsigned int n = 0;
    for (const auto &field : fields)
      n += field.components.size();
    return n;
  }
} // namespace Talus

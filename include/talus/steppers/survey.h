#pragma once

#include <talus/core/tensors.h>
#include <talus/steppers/model.h>

#include <functional>
#include <string>

namespace Talus
{
  /** The global numbers that a run needs after each step; one message between the ranks. */
  template <int dim>
  struct Survey
  {
    double                 signal_speed      = 0; // max (c_p + |v_p|) [length/time], Eq. (35)
    double                 displacement      = 0; // largest of a particle in the last step [spacing]
    bool                   needs_synchronise = false;
    bool                   needs_activation  = false;
    bool                   has_failed        = false; // a particle broke a limit of validity
    double                 mass              = 0;
    double                 kinetic_energy    = 0;
    double                 body_force_power  = 0; // sum m b . v [energy/time]
    dealii::Tensor<1, dim> lost_momentum;         // of empty nodes, in the last step

    std::vector<dealii::Tensor<1, dim>> reactions;    // of each condition in the last step [force]
    std::vector<dealii::Tensor<1, dim>> nodal_forces; // on what each condition set [force]
    std::vector<double>                 works;        // of each condition in the last step [energy]

    std::vector<dealii::Tensor<1, dim>> traction_forces;    // of each traction in the last step [force]
    double                              traction_work  = 0; // of all tractions in the last step [energy]
    double                              damping_energy = 0; // taken by local damping in the last step [energy]
  };

  /** Makes a survey, one block of particles after the other. */
  template <int dim>
  class Surveyor
  {
  public:
    Surveyor(Model<dim> &model, const std::vector<MaterialRange> &ranges, const double time, const double dt);

    /** Looks at the particles begin .. end - 1, after their relocate(). */
    void look_at(const unsigned int begin, const unsigned int end);

    /** What has been seen, and the conditions, of all ranks. Collective. */
    Survey<dim> finish(const double displacement);

  private:
    using Number = Simd<native_width>;

    template <class Batch>
    void look_at(const Batch &batch, const double *speeds, const double largest_volume_ratio);

    Model<dim>                       &model;
    const std::vector<MaterialRange> &ranges;
    const double                      time, dt;

    std::array<const double *, dim>                       v, place; // of the body force
    std::array<const double *, dim * dim>                 F, grad_v;
    std::array<const double *, WorkingSet<dim>::n_stress> stress;
    const double                                         *mass, *volume;

    dealii::Tensor<1, dim>         b; // body force per mass, where it is uniform
    std::vector<double>            speeds;
    Number                         signal_speed = 0., total_mass = 0., kinetic_energy = 0.;
    dealii::Tensor<1, dim, Number> momentum;
    typename Number::Mask          is_valid;
    double                         body_force_power = 0;
  };

  /** Looks at all particles and conditions; before the first step. Collective. */
  template <int dim>
  Survey<dim> survey(Model<dim> &model, const double time, const double dt);

  /**
   * Says which particle broke which limit where, as a RunError on all ranks: it
   * left the grid, a value is not finite, J <= 0 or J > 10, or |grad v| dt > 0.5.
   * Collective; called when the survey has found a failure.
   */
  template <int dim>
  [[noreturn]] void report_failure(Model<dim> &model, const unsigned int step, const double time, const double dt);

  /**
   * Watches the energy: what exceeds twice what was there or was put in can only
   * come from an instability. The kinetic energy is looked at after each step. The
   * elastic energy, which costs a pass over all particles, joins it every
   * `interval` steps and at the end: motion at a free edge that the step size does
   * not quite resolve fills the stress and leaves the velocity small. Runs that
   * are sound stay below 1.03 times what is available, those whose kernels create
   * energy (APIC with Steffen's) below 1.7.
   */
  template <int dim>
  class EnergyWatch
  {
  public:
    static constexpr unsigned int interval = 100;

    /** `strain_energy` is that of the initial stress. */
    void start(const Survey<dim> &first, const double strain_energy);

    /** Adds the work of the step. Throws RunError, which names the fastest particle. Collective. */
    void check(const Model<dim> &model, const Survey<dim> &survey, const unsigned int step, const double time,
               const double dt);

    /** The same of kinetic and elastic energy; names the particle that holds most of it. Collective. */
    void check_total(const Model<dim> &model, const Survey<dim> &survey, const double strain_energy,
                     const unsigned int step, const double time, const double dt) const;

    /** Kinetic and strain energy beyond what was there or was put in; negative is what the scheme has lost [energy]. */
    double residual(const double kinetic_energy, const double strain_energy) const
    {
      return kinetic_energy + strain_energy + damping_energy -
             (initial_energy + body_force_work + condition_work + traction_work);
    }

    double body_force_work = 0; // [energy]
    double condition_work  = 0; // [energy]
    double traction_work   = 0; // [energy]
    double damping_energy  = 0; // taken by local damping [energy]

  private:
    /** Throws when `energy`, called `name`, is too large; then asks `culprit` for the particle. */
    void compare(const std::string &name, const double energy, const unsigned int step, const double time,
                 const double dt, const std::function<std::string()> &culprit) const;

    double initial_energy = 0, floor = 0;
  };
} // namespace Talus

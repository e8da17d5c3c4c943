#pragma once

#include <talus/core/tensors.h>
#include <talus/steppers/model.h>

namespace Talus
{
  /** The global numbers that a run needs after each step; one message between the ranks. */
  template <int dim>
  struct Survey
  {
    double                 signal_speed      = 0; // max (c_p + |v_p|) [length/time], Eq. (35)
    double                 displacement      = 0; // largest of a particle in the last step [spacing]
    bool                   needs_synchronise = false;
    bool                   has_failed        = false; // a particle broke a limit of validity
    double                 mass              = 0;
    double                 kinetic_energy    = 0;
    double                 body_force_power  = 0; // sum m b . v [energy/time]
    dealii::Tensor<1, dim> lost_momentum;         // of empty nodes, in the last step

    std::vector<dealii::Tensor<1, dim>> reactions; // of each condition in the last step [force]
    std::vector<double>                 works;     // of each condition in the last step [energy]
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
    void look_at(const Batch &batch, const double *speeds);

    Model<dim>                       &model;
    const std::vector<MaterialRange> &ranges;
    const double                      time, dt;

    std::array<const double *, dim>                       x, v;
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
   * Watches the kinetic energy: what exceeds twice the energy that was there or
   * was put in can only come from an instability.
   */
  template <int dim>
  class EnergyWatch
  {
  public:
    /** `strain_energy` is that of the initial stress. */
    void start(const Survey<dim> &first, const double strain_energy);

    /** Throws RunError, which names the fastest particle. Collective. */
    void check(const Model<dim> &model, const Survey<dim> &survey, const unsigned int step, const double time,
               const double dt);

    double body_force_work = 0; // [energy]
    double condition_work  = 0; // [energy]

  private:
    double initial_energy = 0, floor = 0;
  };
} // namespace Talus

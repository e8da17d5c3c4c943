#pragma once

#include <talus/steppers/model.h>
#include <talus/steppers/report.h>

namespace Talus
{
  /**
   * Looks at the particles after each step, one block after the other: how fast signals are, which the next step size
   * hangs on, the energy of the motion, and whether a particle has broken a limit of validity: it left the grid, a
   * value is not finite, J <= 0 or J > 10, or |grad v| dt > 0.5. The particle that breaks one is noted when it is
   * found, so that nothing is looked for again to be reported. Test: tests/steppers.
   */
  template <int dim>
  class Watch
  {
  public:
    explicit Watch(Model<dim> &model) : model(model) {}

    /** Begins with the state after a step of size `dt` that began at `time`, when its body force acted; `ranges` must
     * stay until finish(). */
    void start(const std::vector<MaterialRange> &ranges, const double time, const double dt);

    /** Looks at the particles begin .. end - 1, after their relocate(). */
    void look_at(const unsigned int begin, const unsigned int end);

    /** What has been seen, of all ranks, as the parts of the model know their numbers then, after the step that began
     * with `before`. Collective. */
    Report finish(const double displacement, const Report *before = nullptr);

  private:
    using Number = Simd<native_width>;

    /** What a particle has to keep to. */
    enum class Limit
    {
      finite,
      volume_ratio,
      increment,
      grid
    };

    /** What is added up of all particles, one in each lane. */
    struct Sums
    {
      Number                         signal_speed, mass, kinetic_energy; // the greatest; sums
      dealii::Tensor<1, dim, Number> moment;
    };

    /** Which limits the particles of a batch keep to, but for the grid. */
    struct Limits
    {
      typename Number::Mask is_finite, is_open, is_slow;

      typename Number::Mask are_kept() const { return is_finite & is_open & is_slow; }
    };

    /** Particles begin .. end - 1, of one material. */
    void add_up(const unsigned int begin, const unsigned int end, const double *speeds,
                const double largest_volume_ratio);

    template <class Batch>
    [[gnu::always_inline]] inline Limits limits(const Batch &batch, const Number &square_of_velocity,
                                                const double largest_volume_ratio) const;

    /** Notes that particle p broke a limit, if no particle of lower number has broken one. */
    void note(const unsigned int p, const Limit limit);

    /** Says which particle of all ranks broke which limit where, and what to do. Collective. */
    void        describe_failure(Report &report) const;
    std::string describe(const unsigned int p, const Limit limit) const;
    std::string lone_particles() const; // what they bear

    Model<dim>                       &model;
    const std::vector<MaterialRange> *ranges = nullptr;
    double                            time = 0, dt = 0;

    std::array<const double *, dim>                       x, v, position, start_position; // x: where the body force is
    std::array<const double *, dim * dim>                 F, grad_v;
    std::array<const double *, WorkingSet<dim>::n_stress> stress;
    const double                                         *mass;

    dealii::Tensor<1, dim> b; // body force per mass, where it is uniform
    std::vector<double>    speeds;
    Sums                   sums;
    double                 body_force_power = 0;

    unsigned int failed = Particles<dim>::none; // the particle of lowest number that broke a limit
    Limit        broken = Limit::finite;
  };
} // namespace Talus

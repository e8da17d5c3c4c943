#pragma once

#include <talus/core/parameters.h>
#include <talus/steppers/model.h>

#include <iomanip>
#include <sstream>

namespace Talus
{
  namespace internal
  {
    /** The parts one after the other, numbers with four digits: the sentence of a check. */
    template <class... Parts>
    std::string sentence(const Parts &...parts)
    {
      std::ostringstream out;
      out << std::setprecision(4);
      (out << ... << parts);
      return out.str();
    }

    constexpr const char *axes = "xyz";
  } // namespace internal

  /**
   * Looks before the first step for what can be computed but is hardly meant: initial stresses that the weight does not
   * balance, bodies of few cells, conditions that never act, a body under gravity with nothing below it. What may be
   * meant becomes a warning of `parameters`, with numbers and the entry; what cannot be meant an EntryError, on all
   * ranks. The model is created, and its particles are where they begin. Test: tests/inputs.
   */
  template <int dim>
  class Checks
  {
  public:
    Checks(Parameters &parameters, Model<dim> &model, const double begin_time, const double end_time);

    /** All of them; `step_size` is that of the first step, `signal_speed` the greatest c_p + |v_p|. Collective. */
    void run(const double step_size, const double signal_speed, const unsigned int max_steps);

  private:
    /** What the particles of a body say of it. */
    struct Extent
    {
      std::uint64_t      n = 0, n_alone = 0; // particles; of them those with a cell of their own
      dealii::Point<dim> lower, upper;       // their corners [length]
    };

    void find_extents();

    // Bodies and materials
    void check_sizes();
    void check_layers();
    void check_yield();
    void check_materials();
    void check_idle_entries();
    void check_filling();
    void check_clipping();
    void check_pressures();
    void check_loads();

    // Conditions
    void check_intervals();
    void check_edges();
    void check_overridden();
    void check_floor();
    void check_obstacles();

    void check_steps(const double step_size, const double signal_speed, const unsigned int max_steps);

    /** The mean body force per mass at a body's middle in the course of the run. */
    dealii::Tensor<1, dim> mean_pull(const unsigned int body) const;

    /** Whether a condition holds nodes along an axis within or below (above) a body, or nearly so. Collective. */
    bool is_held(const unsigned int body, const unsigned int axis, const bool is_upper) const;

    void warn(const std::string &section, const std::string &entry, const std::string &message)
    {
      parameters.warn(EntryError(section, entry, message));
    }

    Parameters         &parameters;
    Model<dim>         &model;
    const double        begin_time, end_time;
    std::vector<Extent> extents;
  };

  /** Particles that lie deeper than a depth in an obstacle at a time: how many there are, and the deepest in words:
   * "particle 3 at (1, 2) by 0.1". Collective. */
  template <int dim>
  std::pair<std::uint64_t, std::string> particles_in(const Obstacle<dim> &obstacle, const Model<dim> &model,
                                                     const double time, const double depth);
} // namespace Talus

#pragma once

#include <talus/core/exceptions.h>

#include <deal.II/base/parameter_acceptor.h>
#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace Talus
{
  /**
   * The particles begin .. end - 1 as a material sees them: one array per tensor
   * component, always of 3x3 tensors. Components that plane strain does not store
   * are null; they are 0 (and 1 for F_zz).
   */
  struct MaterialRange
  {
    static constexpr unsigned int max_states = 8;

    unsigned int begin, end;
    double       dt;               // [time]
    bool         is_plain = false; // one particle at a time instead of batches: the reference

    std::array<const double *, 9> grad_v; // row by row [1/time]
    std::array<const double *, 9> F;      // row by row [1]
    std::array<double *, 6>       stress; // Cauchy: xx, yy, zz, xy, xz, yz [stress]
    const double                 *mass, *volume;

    std::array<double *, max_states> state; // the material's own fields, in the order of state_names()
  };

  /**
   * A constitutive law. It sees 3x3 tensors and neither the dimension nor the
   * grid. A law is written once, as a function of one point that is a template on
   * the number; materials/point.h runs it over a range, many particles at a time.
   */
  class Material : public dealii::ParameterAcceptor
  {
  public:
    explicit Material(const std::string &section);

    /**
     * Tells it the grid's spacing [length], before the first particle: a band of shear is as wide as some of them, by
     * which laws that soften over a slip scale their strains. Throws EntryError where it is too coarse for them.
     */
    virtual void set_spacing(const double /* spacing */) {}

    /** Names of the state fields that each particle carries for this material; at most MaterialRange::max_states. */
    virtual std::vector<std::string> state_names() const { return {}; }

    /**
     * State fields of a particle that starts with a stress (xx, yy, zz, xy, xz, yz), in the order of state_names();
     * empty: zeros.
     */
    virtual std::vector<double> initial_states(const std::array<double, 6> & /* stress */) const { return {}; }

    /** Advances stress and state by the step; F and volume are those at its end. */
    virtual void update(const MaterialRange &range) const = 0;

    /** Speed of pressure waves [length/time] at each particle of the range; the first goes to speeds[0]. */
    virtual void wave_speeds(const MaterialRange &range, double *speeds) const = 0;

    /** Elastic energy per current volume [stress] at each particle of the range; the first goes to densities[0]. */
    virtual void strain_energy_densities(const MaterialRange &range, double *densities) const = 0;

    /**
     * What plastic flow has taken since the start, per current volume [stress], as strain_energy_densities(); zeros
     * where that does not follow from the state.
     */
    virtual void plastic_work_densities(const MaterialRange &range, double *densities) const
    {
      std::fill_n(densities, range.end - range.begin, 0.);
    }

    /** Ratio of horizontal to vertical stress of a layer at rest: nu / (1 - nu). */
    virtual double rest_stress_ratio() const = 0;

    /** Density in the initial state at a pressure that is there from the start [mass/volume]. */
    virtual double initial_density(const double /* pressure */) const { return density; }

    /**
     * Why the material cannot start with a stress (xx, yy, zz, xy, xz, yz), and what to do; empty: it can.
     */
    virtual std::string refusal(const std::array<double, 6> & /* initial_stress */) const { return ""; }

    /** Whether update() with dt = 0 gives the stress of any F: a body can then start deformed. */
    virtual bool starts_deformed() const { return false; }

    /** What is possible and hardly meant among its entries: warnings before the first step. */
    virtual std::vector<EntryError> doubts() const { return {}; }

    /**
     * True for a law that asks nothing but the volume: F is then not integrated but diag(J, 1, 1) with J = density
     * V / m. det F of a particle that is stretched on and on is the difference of ever greater products.
     */
    virtual bool carries_volume_only() const { return false; }

    /** False for a law whose particles part without resistance: water and dry sand. */
    virtual bool bears_tension() const { return !carries_volume_only(); }

    /** A particle that has expanded beyond this volume ratio J has not stayed in one piece: the run has failed [1]. */
    virtual double largest_volume_ratio() const { return 10; }

    /** Viscosity over density [length^2/time], which limits the step size as well; 0: it has none. */
    virtual double kinematic_viscosity() const { return 0; }

    /**
     * How fast differences of J between neighbours are smoothed [length/time]; 0: not at all. Only for laws without
     * memory, whose update() may be called again.
     */
    virtual double smoothing_speed() const { return 0; }

    double density = 1000; // [mass/volume]

    void parse_parameters(dealii::ParameterHandler &prm) override;
  };
} // namespace Talus

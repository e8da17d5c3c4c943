#pragma once

#include <talus/materials/material.h>

namespace Talus
{
  /**
   * A nearly incompressible Newtonian fluid, Eqs. (69), (70),
   * @f[ \sigma = -p I - \tfrac{2}{3} \mu\,\mathrm{tr}(d) I + 2 \mu d , \qquad p = c^2 (\rho - \rho_{ref}) , @f]
   * where d is the rate of deformation, the trace is that of three dimensions and rho = m/V. It
   * has no memory and bears tension. `Density` is rho_ref, the density at zero pressure. Of the deformation it carries
   * the volume alone.
   * No state. Throws nothing: any rate has a stress.
   * Theory: doc/materials.md. Test: tests/materials/newtonian_fluid.cc.
   */
  class NewtonianFluid : public Material
  {
  public:
    explicit NewtonianFluid(const std::string &section);

    void update(const MaterialRange &range) const override;

    /**
     * c sqrt(max(1, rho_ref / rho)): the stiffness m c^2 of a particle's pressure against its volume ratio J moves the
     * mass of its nodes by gradients that are J times as strong, omega^2 = c^2 sum(S_d / h_d^2) J.
     */
    void wave_speeds(const MaterialRange &range, double *speeds) const override;

    /** What compression from rho_ref has taken, rho int p / rho^2 d rho; viscous work is lost. */
    void strain_energy_densities(const MaterialRange &range, double *densities) const override;

    double rest_stress_ratio() const override { return 1; }
    double initial_density(const double pressure) const override;
    double kinematic_viscosity() const override { return viscosity / density; }
    bool   carries_volume_only() const override { return true; }

    /** At rest a fluid bears pressure only. */
    std::string refusal(const std::array<double, 6> &initial_stress) const override;

    double smoothing_speed() const override { return smoothing * sound_speed; }

    void parse_parameters(dealii::ParameterHandler &prm) override;

  private:
    double viscosity   = 1e-3; // mu [stress time]
    double sound_speed = 50;   // c [length/time]
    double smoothing   = 0;    // of J [1]
  };
} // namespace Talus

#pragma once

#include <talus/core/parameters.h>
#include <talus/simulation/element_control.h>

namespace Talus
{
  /**
   * A part of the path of a single point, as its section of the parameter file says: one way of deforming, whose amount
   * goes through a list of values in equal steps. The amount e is a logarithmic strain of the axis z, a shear F_xy, or
   * the factor of a direction; with a = exp(de) - 1 of a step and f = I + dt grad v
   *
   *     oedometer             f_zz = 1 + a
   *     triaxial              f_zz = 1 + a,  stresses xx and yy are held
   *     undrained triaxial    f_zz = 1 + a,  f_xx = f_yy = (1 + a)^(-1/2)
   *     biaxial               f_zz = 1 + a,  stress xx is held
   *     isotropic             f_xx = f_yy = f_zz = 1 + a
   *     simple shear          f_xy = de
   *     strain                f = I + de D,  chosen stresses are held
   *     stress                all stresses go linearly to given values, without spin
   *
   * Held are the values at the start of the stage. Theory: doc/element.md. Test: tests/element.
   */
  class ElementStage : public dealii::ParameterAcceptor
  {
  public:
    ElementStage(Parameters &parameters, const std::string &section, const std::string &name);

    void parse_parameters(dealii::ParameterHandler &prm) override;

    unsigned int n_steps() const { return legs() * n_steps_of_leg; }

    /** Whether step k = 1 .. n_steps() goes another way than the one before. */
    bool turns_at(const unsigned int k) const { return (k - 1) % n_steps_of_leg == 0; }

    /** The amount after step k. */
    double amount(const unsigned int k) const;

    /** What step k = 1 .. n_steps() asks of a point that had `start` as its stress when the stage began. */
    ElementStep step(const unsigned int k, const std::array<double, 6> &start) const;

    /** "triaxial to -0.05, 0.02 in 2000 steps" */
    std::string summary() const;

    /** What the amount is: "strain zz", for messages. */
    std::string amount_name() const;

    const std::string name;

  private:
    void add_strain_entries(Parameters &parameters);
    void add_direction_entries();
    void add_stress_entries(Parameters &parameters);
    void check_direction();

    unsigned int legs() const { return kind == "stress" ? 1 : turning_points.size(); }

    /** Of dt grad v, of a step by `d`. */
    dealii::Tensor<2, 3> driven(const double d) const;

    std::string              kind;
    std::vector<double>      turning_points{-0.1}; // [1]
    unsigned int             n_steps_of_leg = 1000;
    double                   rate           = 1; // [1/time]
    std::vector<double>      direction;
    std::vector<std::string> held_names;
    std::vector<unsigned>    held;
    std::vector<double>      final_stress = std::vector<double>(6, 0.); // [stress]
    double                   duration     = 1;                          // [time]
  };
} // namespace Talus

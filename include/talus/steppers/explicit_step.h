#pragma once

#include <talus/steppers/deformation.h>
#include <talus/steppers/musl.h>
#include <talus/steppers/stepper.h>
#include <talus/steppers/upkeep.h>
#include <talus/steppers/watch.h>

#include <optional>

namespace Talus
{
  /**
   * Explicit time integration in the order of Fig. 1, stress last. The step is the Courant number times
   * @f[ \Delta t = \left(\frac{\max (c_p + |v_p|)}{h} + \frac{2 \dim \nu}{h^2}\right)^{-1} , @f]
   * Eqs. (35), (37), together with the explicit limit of viscous stress. With `MUSL` the deformation follows from
   * velocities that are scattered once more; nodes of a mass below a cutoff can count as empty.
   */
  template <int dim>
  class Explicit : public Stepper<dim>
  {
  public:
    explicit Explicit(const std::string &section);

    void parse_parameters(dealii::ParameterHandler &prm) override;

    Report      start(Model<dim> &model, Timing &timing) override;
    double      step_size(const Model<dim> &model, const Report &last) const override;
    Report      advance(Model<dim> &model, const Report &last, const double time, const double dt) override;
    void        serialize(Archive &archive) override { upkeep.serialize(archive); }
    std::string warning(const Model<dim> &model) const override;
    std::string summary() const override;

  private:
    /** Nodes of less than `mass_cutoff` times the lightest particle's mass count as empty. Collective. */
    void raise_mass_floor(Model<dim> &model) const;

    /** The Courant number on a mesh: what full bodies bear with any transfer. Collective. */
    double full_body_limit(const Model<dim> &model) const;

    void   move_nodes(Model<dim> &model, const double time, const double dt);
    Report move_particles(Model<dim> &model, const Report &last, const double time, const double dt);

    double courant_number = 0, fixed_step_size = 0, mass_cutoff = 0;
    bool   is_musl = false;

    Timing      *timing = nullptr;
    unsigned int particle_to_grid, grid, grid_to_particle, stress, relocate, upkeep_section, smoothing, musl_section,
      f_bar; // of `timing`

    Upkeep<dim>               upkeep;
    Musl<dim>                 musl;
    std::optional<Watch<dim>> watch;
  };
} // namespace Talus

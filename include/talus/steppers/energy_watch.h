#pragma once

#include <talus/steppers/model.h>
#include <talus/steppers/report.h>

#include <cmath>
#include <functional>

namespace Talus
{
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
    void start(const Report &first, const double strain_energy);

    /** Adds the work of the step. Throws RunError, which names the fastest particle. Collective. */
    void check(Model<dim> &model, const Report &report, const Moment &moment);

    /** The same of kinetic and elastic energy; names the particle that holds most of it. Collective. */
    void check_total(Model<dim> &model, const Report &report, const double strain_energy, const Moment &moment);

    /** Kinetic and strain energy beyond what was there or was put in; negative is what the scheme has lost [energy]. */
    double residual(const double kinetic_energy, const double strain_energy) const
    {
      return kinetic_energy + strain_energy + damping_energy -
             (initial_energy + body_force_work + condition_work + traction_work + contact_work);
    }

    /** Work of body force, conditions, tractions and contacts, each as a magnitude [energy]. */
    double put_in() const
    {
      return std::abs(body_force_work) + std::abs(condition_work) + std::abs(traction_work) + std::abs(contact_work);
    }

    /** What is left of the residual when all losses that are known are added to it [energy]. */
    double unaccounted(const double residual, const double plastic_work) const
    {
      return residual + transfer_loss + wall_loss + integration_loss + plastic_work;
    }

    void serialize(Archive &archive)
    {
      const Archive::Scope scope(archive, "energy");
      archive("body force work", body_force_work);
      archive("condition work", condition_work);
      archive("traction work", traction_work);
      archive("contact work", contact_work);
      archive("damping energy", damping_energy);
      archive("initial energy", initial_energy);
      archive("most available", most_available);
      archive("floor", floor);
      archive("kinetic energy", kinetic_energy);
      archive("transfer loss", transfer_loss);
      archive("wall loss", wall_loss);
      archive("integration loss", integration_loss);
      archive("contact friction work", friction_work);
    }

    /** What was put in and taken out. */
    void add_to(Table &table) const
    {
      table.add("body force work", "energy", body_force_work);
      table.add("condition work", "energy", condition_work);
      table.add("traction work", "energy", traction_work);
      table.add("contact work", "energy", contact_work);
      table.add("damping energy", "energy", damping_energy);
    }

    /** What the numbers of EnergyAccount say. */
    void add_losses_to(Table &table) const
    {
      table.add("transfer loss", "energy", transfer_loss);
      table.add("wall loss", "energy", wall_loss);
      table.add("integration loss", "energy", integration_loss);
      table.add("contact friction work", "energy", friction_work);
    }

  private:
    /** Throws when `energy`, called `name`, is too large; then asks `culprit` for the particle. */
    void compare(const Model<dim> &model, const std::string &name, const double energy, const Moment &moment,
                 const std::function<std::string()> &culprit);

    double body_force_work  = 0; // [energy]
    double condition_work   = 0; // [energy]
    double traction_work    = 0; // [energy]
    double contact_work     = 0; // [energy]
    double damping_energy   = 0; // taken by local damping [energy]
    double transfer_loss    = 0; // kinetic energy of particles that nodes have not, and back [energy]
    double wall_loss        = 0; // [energy]
    double integration_loss = 0; // of free nodes [energy]
    double friction_work    = 0; // share of the contact work [energy]
    double kinetic_energy   = 0; // after the last step [energy]
    double initial_energy = 0, most_available = 0, floor = 0;
  };
} // namespace Talus

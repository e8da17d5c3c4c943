#include <talus/core/exceptions.h>
#include <talus/steppers/energy_watch.h>
#include <talus/steppers/remedy.h>

#include <algorithm>
#include <sstream>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    /** The particle for which values[p] is greatest: number, place, and the value under its name. Collective. */
    template <int dim>
    std::string describe_greatest(const Model<dim> &model, const std::string &name, const std::vector<double> &values)
    {
      const Particles<dim>          &particles = model.particles;
      std::pair<double, std::string> greatest(-1., "");
      if (!values.empty())
      {
        const unsigned int p = std::max_element(values.begin(), values.end()) - values.begin();
        std::ostringstream text;
        text << "particle " << particles.id[p] << " at " << to_text(particles.vector(particles.position, p)) << " with "
             << name << " " << values[p];
        greatest = {values[p], text.str()};
      }
      for (const auto &other : Utilities::MPI::all_gather(model.grid.communicator, greatest))
        greatest = std::max(greatest, other);
      return greatest.second;
    }

    /** Elastic energy of each particle. */
    template <int dim>
    std::vector<double> strain_energies(Model<dim> &model)
    {
      std::vector<double> energies(model.particles.size());
      const double       *volume = model.particles.component(model.particles.volume, 0);
      const auto          ranges = material_ranges(model.particles, /* dt = */ 0.);
      for (unsigned int m = 0; m < ranges.size(); ++m)
        model.materials[m]->strain_energy_densities(ranges[m], energies.data() + ranges[m].begin);
      for (unsigned int p = 0; p < energies.size(); ++p)
        energies[p] *= volume[p];
      return energies;
    }
  } // namespace

  template <int dim>
  void EnergyWatch<dim>::start(const Report &first, const double strain_energy)
  {
    initial_energy = first.kinetic_energy + strain_energy;
    most_available = initial_energy;
    kinetic_energy = first.kinetic_energy;
    // Round-off of a body at rest: velocities of a millionth of the wave speed.
    floor = 1e-12 * first.mass * first.signal_speed * first.signal_speed;
  }

  template <int dim>
  void EnergyWatch<dim>::check(Model<dim> &model, const Report &report, const Moment &moment)
  {
    body_force_work += moment.dt * report.body_force_power;
    for (const auto &condition : model.boundary.conditions)
      condition_work += condition->work;
    for (const auto &obstacle : model.boundary.obstacles)
      condition_work += obstacle->work;
    double work = 0;
    for (const auto &load : model.tractions.loads)
      work += load->work;
    traction_work += work;
    for (const auto &contact : model.contacts.all)
    {
      contact_work += contact->work;
      friction_work += contact->friction_work;
    }
    transfer_loss += kinetic_energy - report.kinetic_energy + model.account.change + model.account.second_loss;
    wall_loss += model.account.wall_loss;
    integration_loss += model.account.integration_loss;
    kinetic_energy = report.kinetic_energy;
    damping_energy -= model.boundary.damping.work;
    compare(model, "kinetic energy", report.kinetic_energy, moment, [&] {
      std::vector<double> speeds(model.particles.size());
      for (unsigned int p = 0; p < speeds.size(); ++p)
        speeds[p] = model.particles.vector(model.particles.velocity, p).norm();
      return "Fastest is " + describe_greatest(model, "speed", speeds);
    });
  }

  template <int dim>
  void EnergyWatch<dim>::check_total(Model<dim> &model, const Report &report, const double strain_energy,
                                     const Moment &moment)
  {
    compare(model, "kinetic and elastic energy", report.kinetic_energy + strain_energy, moment, [&] {
      auto energies = strain_energies(model);
      for (unsigned int p = 0; p < energies.size(); ++p)
        energies[p] += 0.5 * model.particles.component(model.particles.mass, 0)[p] *
                       model.particles.vector(model.particles.velocity, p).norm_square();
      return "Most of it has " + describe_greatest(model, "energy", energies);
    });
  }

  template <int dim>
  void EnergyWatch<dim>::compare(const Model<dim> &model, const std::string &name, const double energy,
                                 const Moment &moment, const std::function<std::string()> &culprit)
  {
    // Not less what damping took: where little is left, the errors of what was put in would count.
    const double available = initial_energy + body_force_work + condition_work + traction_work + contact_work;
    most_available         = std::max(most_available, available);
    // Where nearly all was taken out again (a wall has stopped the body), what is left is the error of large sums, and
    // no bound.
    constexpr double share_that_bounds = 0.05;
    const double     bound             = std::max(available, share_that_bounds * most_available);
    if (energy <= 2 * bound + floor)
      return;
    std::ostringstream message;
    message << "The " << name << " " << energy << moment.text() << " is more than twice the " << bound
            << " that initial state, body force, tractions, contacts and conditions account for: the run is unstable. "
            << culprit() << ". " << remedy_of_instability(model);
    throw RunError(message.str());
  }

  template class EnergyWatch<2>;
  template class EnergyWatch<3>;
} // namespace Talus

#include <talus/core/exceptions.h>
#include <talus/core/registry.h>
#include <talus/loads/contact.h>
#include <talus/particles/material_range.h>

#include <cmath>
#include <sstream>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    /** The part of the surface that a particle stands for. */
    template <int dim>
    double area_of(const double volume)
    {
      return dim == 2 ? std::sqrt(volume) : std::cbrt(volume * volume);
    }
  } // namespace

  template <int dim>
  Contact<dim>::Contact(Parameters &parameters, const std::string &name) :
    ParameterAcceptor("/Contacts/" + name), name(name),
    surface(parameters.make<ContactSurface<dim>>("/Contacts/" + name, "Surface", "box",
                                                 "What particles do not run through, from either side."))
  {
    add_parameter("Distance", distance, "Where the barrier begins [length]; 0: a quarter of the smallest spacing.", prm,
                  Patterns::Double(0));
    add_parameter(
      "Pressure", pressure,
      "What a particle at half of the distance bears [stress]: a tenth of Young's modulus is a good choice.", prm,
      Patterns::Double());
    add_parameter("Friction coefficient", friction, "Greatest tangential over normal force, mu [1].", prm,
                  Patterns::Double());
    add_parameter("Sticking speed", sticking_speed,
                  "Below it friction falls with the speed of slip [length/time]; 0: 1/1000 of the wave speed.", prm,
                  Patterns::Double(0));
    add_parameter("Step fraction", step_fraction,
                  "Of the largest steps that the barrier allows [1]: less keeps the energy of a rebound better.", prm,
                  Patterns::Double());
  }

  template <int dim>
  void Contact<dim>::parse_parameters(ParameterHandler &)
  {
    const auto check = [&](const bool holds, const std::string &entry, const std::string &message) {
      if (!holds)
        throw EntryError(get_section_name(), entry, message);
    };
    check(pressure > 0, "Pressure", "it must be positive. Give a tenth of the body's Young's modulus.");
    check(friction >= 0, "Friction coefficient", "it must not be negative; 0 is a wall without friction.");
    check(step_fraction > 0 && step_fraction <= 1, "Step fraction", "it must lie between 0 and 1, 0 excluded.");
  }

  template <int dim>
  void Contact<dim>::attach(const Grid<dim> &grid, const double wave_speed, const Particles<dim> &particles)
  {
    const double h = grid.smallest_spacing;
    barrier.reach  = distance > 0 ? distance : h / 4;
    stiffness      = barrier.stiffness(pressure);
    slip_speed     = sticking_speed > 0 ? sticking_speed : 1e-3 * wave_speed;
    // A particle moves less than a spacing in a step: who is farther than two is not there within half of its distance.
    surface->attach(grid);
    surface->create(std::max(barrier.reach, 2 * h));
    look_around(particles);
  }

  template <int dim>
  void Contact<dim>::look_around(const Particles<dim> &particles)
  {
    near.clear();
    surface->find(particles.template components<dim>(particles.position), 0, particles.size(), near);
    arrangement  = particles.arrangement;
    inverse_step = nearness = 0;
    const double *mass = particles.component(particles.mass, 0), *volume = particles.component(particles.volume, 0);
    for (const auto &[p, d, n] : near)
    {
      inverse_step = std::max(inverse_step, -2 * (particles.vector(particles.velocity, p) * n) / d);
      if (!(d < barrier.reach))
        continue;
      // omega^2 of the nodes is at most the greatest k/m of a particle.
      const double k = stiffness * barrier.curvature(d) * area_of<dim>(volume[p]);
      inverse_step   = std::max(inverse_step, std::sqrt(k / mass[p]) / step_fraction);
      nearness       = std::max(nearness, 1 - d / barrier.reach);
    }
  }

  template <int dim>
  std::array<Tensor<1, dim>, 2> Contact<dim>::forces_on(const Near<dim> &near, const Particles<dim> &particles,
                                                        const double dt) const
  {
    const auto &[p, d, n] = near;
    const double   normal = -stiffness * barrier.slope(d) * area_of<dim>(particles.component(particles.volume, 0)[p]);
    Tensor<1, dim> slip   = particles.vector(particles.velocity, p);
    slip -= (slip * n) * n;
    const double speed = slip.norm();
    if (!(friction > 0 && speed > 0))
      return {{normal * n, Tensor<1, dim>()}};
    // Friction stops a particle, and does not turn it back.
    const double stop = particles.component(particles.mass, 0)[p] * speed / dt;
    return {{normal * n, -std::min(friction * normal * friction_share(speed / slip_speed), stop) / speed * slip}};
  }

  template <int dim>
  void Contact<dim>::apply(const Particles<dim> &particles, const Kernel<dim> &kernel, const double dt, Grid<dim> &grid)
  {
    using Fields = NodalFields<dim>;
    if (arrangement != particles.arrangement)
      look_around(particles);
    force = 0;
    x.clear();
    forces.clear();
    Stencil<dim> stencil;
    for (const Near<dim> &one : near)
    {
      x.push_back(particles.vector(particles.position, one.p));
      forces.emplace_back();
      if (!(one.distance < barrier.reach))
        continue;
      forces.back()          = forces_on(one, particles, dt);
      const Tensor<1, dim> f = forces.back()[0] + forces.back()[1];
      force += f;
      kernel.evaluate(particles, one.p, one.p + 1, &stencil);
      for (unsigned int k = 0; k < stencil.size; ++k)
      {
        double numbers[Fields::stride] = {};
        for (unsigned int d = 0; d < dim; ++d)
          numbers[Fields::force + d] = stencil.weight[k] * f[d];
        const unsigned int beyond = stencil.has_images ? stencil.beyond[k] : 0;
        grid.fields.count_mirrored(numbers, beyond);
        for (unsigned int lane = Fields::force; lane < Fields::force + dim; ++lane)
          grid.fields.at_place(stencil.place[k])[lane] += Fields::mirror(beyond)[lane] * numbers[lane];
      }
    }
  }

  template <int dim>
  void Contact<dim>::finish(const Particles<dim> &particles)
  {
    work = friction_work = 0;
    for (unsigned int k = 0; k < near.size(); ++k)
    {
      const Tensor<1, dim> now = particles.vector(particles.position, near[k].p);
      work += (forces[k][0] + forces[k][1]) * (now - x[k]);
      friction_work += forces[k][1] * (now - x[k]);
      // Within the ball of its old distance there is no surface.
      if ((now - x[k]).norm() < near[k].distance ||
          surface->contains(Point<dim>(now)) == surface->contains(Point<dim>(x[k])))
        continue;
      std::ostringstream text;
      text << "Particle " << particles.id[near[k].p] << " has run through the surface of the contact '" << name
           << "', from " << to_text<dim>(x[k]) << " to " << to_text<dim>(now)
           << ". Raise its pressure, or lower 'Step size' or the Courant number.";
      is_broken = true;
      failure   = text.str();
    }
    look_around(particles);
  }

  template <int dim>
  void Contact<dim>::check(const Communicator &communicator) const
  {
    if (!is_broken)
      return;
    for (const auto &text : Utilities::MPI::all_gather(communicator, failure))
      if (!text.empty())
        throw RunError(text);
  }

  template <int dim>
  void Contact<dim>::add_to(Table &table) const
  {
    table.add("contact " + name, "force", force);
    table.add("contact work " + name, "energy", work);
    table.add("contact nearness " + name, "1", nearness);
  }

  template <int dim>
  void Contacts<dim>::build(Parameters &parameters)
  {
    for (const auto &name : parameters.names("/Contacts", "Names of the contacts; each has a subsection of its name."))
      all.push_back(std::make_unique<Contact<dim>>(parameters, name));
  }

  template <int dim>
  void Contacts<dim>::attach(const Grid<dim> &grid, const std::vector<std::unique_ptr<Material>> &materials,
                             Particles<dim> &particles)
  {
    if (all.empty())
      return;
    std::vector<double> speeds(particles.size());
    const auto          ranges = material_ranges(particles, /* dt = */ 0.);
    for (unsigned int m = 0; m < ranges.size(); ++m)
      if (ranges[m].begin < ranges[m].end)
        materials[m]->wave_speeds(ranges[m], speeds.data() + ranges[m].begin);
    double greatest = 0;
    for (const double speed : speeds)
      greatest = std::max(greatest, speed);
    greatest = Utilities::MPI::max(greatest, grid.communicator);
    for (auto &contact : all)
      contact->attach(grid, greatest, particles);
  }

  template class Contact<2>;
  template class Contact<3>;
  template class Contacts<2>;
  template class Contacts<3>;
} // namespace Talus

#include <talus/core/exceptions.h>
#include <talus/core/registry.h>
#include <talus/steppers/deformation.h>
#include <talus/steppers/explicit_step.h>
#include <talus/steppers/fastest_vibration.h>
#include <talus/steppers/sweep.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    /** Particles that one sweep after the other looks at, so that what one has written the next finds in the cache. */
    template <int dim>
    constexpr unsigned int block = dim == 2 ? 1024 : 512;
  } // namespace

  template <int dim>
  Explicit<dim>::Explicit(const std::string &section) : Stepper<dim>(section)
  {
    this->add_parameter(
      "Courant number", courant_number,
      "Step size over its critical value, Eq. (37) [1]; 0: what lone particles of a fluid bear with this "
      "kernel and any transfer, 0.4 in 2D and 0.33 in 3D with quadratic B-splines; on a mesh what full bodies bear.",
      this->prm, Patterns::Double());
    this->add_parameter("Step size", fixed_step_size, "Fixed step size [time]; 0: by the Courant number each step.",
                        this->prm, Patterns::Double(0));
    this->add_parameter("Largest imbalance", upkeep.largest_imbalance,
                        "Particles of the rank that has most over the mean, beyond which the ranks share the cells out "
                        "anew [1]; 0: never.",
                        this->prm, Patterns::Double(0));
    this->add_parameter("MUSL", is_musl,
                        "The velocity gradient is that of the particles' new velocities, scattered once more.");
    this->add_parameter("Mass cutoff", mass_cutoff,
                        "Nodes of less than this share of the lightest particle's mass count as empty [1].", this->prm,
                        Patterns::Double(0, 1));
  }

  template <int dim>
  void Explicit<dim>::parse_parameters(ParameterHandler &)
  {
    if (!(courant_number >= 0))
      throw EntryError(this->get_section_name(), "Courant number",
                       "it must not be negative; 0 takes what lone particles bear with the kernel.");
    if (upkeep.largest_imbalance > 0 && !(upkeep.largest_imbalance > 1))
      throw EntryError(this->get_section_name(), "Largest imbalance",
                       "no rank can have fewer than the mean if none has more: it must be above 1, for instance 1.2, "
                       "or 0 for never.");
  }

  template <int dim>
  Report Explicit<dim>::start(Model<dim> &model, Timing &timing)
  {
    this->timing     = &timing;
    particle_to_grid = timing.add("particle to grid");
    grid             = timing.add("grid and conditions");
    grid_to_particle = timing.add("grid to particle");
    stress           = timing.add("stress");
    relocate         = timing.add("relocate and survey");
    upkeep_section   = timing.add("upkeep");
    smoothing        = timing.add("smoothing of J");
    musl_section     = timing.add("velocities once more");
    f_bar            = timing.add("F-bar");

    raise_mass_floor(model);
    upkeep.run(model, Report());
    if (courant_number == 0)
    {
      // FLIP and PIC bear least.
      const auto limit = model.lone_particle_limit({{0.5, 0.}});
      courant_number   = limit ? std::floor(100 * *limit) / 100 : dim == 2 ? 0.4 : 0.33;
      if (model.grid.keeps_places())
        courant_number = full_body_limit(model);
    }
    watch.emplace(model);
    const auto ranges = material_ranges(model.particles, /* dt = */ 0.);
    watch->start(ranges, /* time = */ 0., /* dt = */ 0.);
    for (unsigned int p = 0; p < model.particles.size(); p += block<dim>)
      watch->look_at(p, std::min(p + block<dim>, model.particles.size()));
    return watch->finish(/* displacement = */ 0.);
  }

  template <int dim>
  double Explicit<dim>::full_body_limit(const Model<dim> &model) const
  {
    // Full bodies on a mesh bear 2 / omega, with FLIP and PIC sqrt(2) / omega; a third is left for their edges.
    const double dt = 1 / fastest_vibration(*model.kernel, model.grid);
    return std::floor(100 * dt / model.grid.smallest_spacing) / 100;
  }

  template <int dim>
  void Explicit<dim>::raise_mass_floor(Model<dim> &model) const
  {
    const double *mass     = model.particles.component(model.particles.mass, 0);
    double        lightest = std::numeric_limits<double>::max();
    for (unsigned int p = 0; p < model.particles.size(); ++p)
      lightest = std::min(lightest, mass[p]);
    lightest = Utilities::MPI::min(lightest, model.grid.communicator);
    if (model.particles.n_global > 0)
      model.grid.mass_floor = std::max(model.grid.mass_floor, mass_cutoff * lightest);
  }

  template <int dim>
  double Explicit<dim>::step_size(const Model<dim> &model, const Report &last) const
  {
    if (fixed_step_size > 0)
      return fixed_step_size;
    double nu = 0;
    for (const auto &material : model.materials)
      nu = std::max(nu, material->kinematic_viscosity());
    const double h       = model.grid.smallest_spacing;
    const double dt      = courant_number / (last.signal_speed / h + 2 * dim * nu / (h * h)),
                 inverse = model.contacts.inverse_step();
    return inverse * dt > 1 ? 1 / inverse : dt;
  }

  template <int dim>
  std::string Explicit<dim>::warning(const Model<dim> &model) const
  {
    const auto of_fluid = model.lone_particle_limit(model.transfer->stiffness_factors());
    if (fixed_step_size > 0 || !of_fluid || courant_number <= *of_fluid * model.material_factor())
      return "";
    std::ostringstream text;
    text << "warning: the Courant number " << courant_number << " is above " << std::setprecision(3)
         << *of_fluid * model.material_factor()
         << ", what single particles bear with this kernel, transfer and material. Full bodies bear more.\n";
    return text.str();
  }

  template <int dim>
  Report Explicit<dim>::advance(Model<dim> &model, const Report &last, const double time, const double dt)
  {
    {
      const Timing::Scope scope(*timing, upkeep_section);
      upkeep.run(model, last);
    }
    {
      const Timing::Scope scope(*timing, smoothing);
      model.smoothing.apply(model.materials, *model.kernel, dt, model.particles, model.grid);
    }
    move_nodes(model, time, dt);
    Report report = move_particles(model, last, time, dt);
    report.news   = upkeep.news;
    return report;
  }

  template <int dim>
  void Explicit<dim>::move_nodes(Model<dim> &model, const double time, const double dt)
  {
    AssertThrow(!model.particles.needs_synchronise && model.particles.outside == Particles<dim>::none,
                ExcMessage("Particles have strayed from their rank, or left the grid: the nodes would miss what they "
                           "carry. Upkeep comes before the next step."));
    {
      const Timing::Scope scope(*timing, f_bar);
      model.f_bar.start(model.materials.size(), *model.kernel, model.particles, model.grid);
      model.f_bar.average_stress(model.particles, model.grid);
    }
    {
      const Timing::Scope scope(*timing, particle_to_grid);
      model.boundary.mark_slip_walls(time + dt, model.particles.n_stencil_nodes, model.grid);
      model.grid.clear();
      model.walls.clear();
      model.transfer->particle_to_grid(model.particles, *model.kernel, model.acceleration, time, model.grid);
      model.tractions.apply(model.particles, *model.kernel, time, model.grid);
      model.contacts.apply(model.particles, *model.kernel, dt, model.grid);
    }
    const Timing::Scope scope(*timing, grid);
    model.move_nodes(time, dt);
  }

  template <int dim>
  Report Explicit<dim>::move_particles(Model<dim> &model, const Report &last, const double time, const double dt)
  {
    Particles<dim> &particles = model.particles;
    const auto      ranges    = material_ranges(particles, dt, model.transfer->is_plain);
    watch->start(ranges, time, dt);
    particles.start_relocation();

    double displacement = 0;
    Sweep  sweep(*timing);
    sweep.add(grid_to_particle, [&](const unsigned int begin, const unsigned int end) {
      displacement =
        std::max(displacement, model.transfer->grid_to_particle(model.grid, *model.kernel, dt, particles, begin, end));
    });
    if (is_musl)
    {
      musl.start(particles);
      sweep.run(particles.size(), block<dim>);
      const Timing::Scope scope(*timing, musl_section);
      musl.apply(model, time, dt);
    }
    if (model.f_bar.is_on)
    {
      sweep.run(particles.size(), block<dim>);
      const Timing::Scope scope(*timing, f_bar);
      model.f_bar.average_rate(dt, particles, model.grid);
    }
    sweep.add(stress, [&](const unsigned int begin, const unsigned int end) {
      deform(particles, model.materials, ranges, begin, end);
      if (model.f_bar.is_on)
        model.f_bar.remove_added(particles, begin, end);
    });
    const auto count = [&](const bool is_end) {
      if (model.account.is_on)
        sweep.add(stress, [&, is_end](const unsigned int begin, const unsigned int end) {
          for (const auto &range : ranges)
            model.account.count_stress(intersection(range, begin, end), is_end);
        });
    };
    count(/* is_end = */ false);
    sweep.add(stress, [&](const unsigned int begin, const unsigned int end) {
      for (unsigned int m = 0; m < ranges.size(); ++m)
        model.materials[m]->update(intersection(ranges[m], begin, end)); // Eqs. (28)-(30)
    });
    count(/* is_end = */ true);
    if (model.f_bar.is_on)
      sweep.add(stress, [&](const unsigned int begin, const unsigned int end) {
        model.f_bar.add_added(particles, begin, end);
      });
    sweep.add(relocate, [&](const unsigned int begin, const unsigned int end) {
      particles.relocate(begin, end);
      watch->look_at(begin, end);
    });
    sweep.run(particles.size(), block<dim>);

    const Timing::Scope scope(*timing, relocate);
    model.tractions.finish(particles);
    model.contacts.finish(particles);
    const Report report = watch->finish(displacement, &last);
    model.contacts.check(model.grid.communicator);
    return report;
  }

  template <int dim>
  std::string Explicit<dim>::summary() const
  {
    return "  " + std::to_string(upkeep.n_migrations) + " migrations between ranks, " + std::to_string(upkeep.n_sorts) +
           " sorts" +
           (upkeep.n_balances > 0 ? ", cells shared out anew " + std::to_string(upkeep.n_balances) + " time(s)" : "") +
           '\n';
  }

  template class Explicit<2>;
  template class Explicit<3>;

  namespace
  {
    const RegisterDimensions<Stepper, Explicit> explicit_steps("explicit", "one step after the other, as Fig. 1 says");
  }
} // namespace Talus

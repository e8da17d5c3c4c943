#include "../run.h"
#include "../surfaces.h"

using namespace Test;
using namespace dealii;

namespace
{
  /** A body in a unit box of 16 (3D: 12) cells per direction, which a contact named "wall" bounds. */
  template <int dim>
  std::string contact_text(const std::string &body, const std::string &contact, const std::string &run = "",
                           const std::string &poissons_ratio = "0.3")
  {
    const double n = dim == 2 ? 16 : 12;
    return section("Grid", set("Cells", coordinates<dim>({{n, n, n}}))) + section("Transfer", set("Type", "FLIP")) +
           section("Run", set("Courant number", "0.3") + run) +
           section("Materials",
                   set("Names", "rubber") +
                     section("rubber", set("Type", "neo-Hookean") + set("Density", "2") +
                                         set("Young's modulus", "1000") + set("Poisson's ratio", poissons_ratio))) +
           section("Bodies", set("Names", "body") + section("body", body)) +
           section("Contacts", set("Names", "wall") + section("wall", contact));
  }

  const std::string firm = set("Pressure", "100");

  /** A floor below y = 0.2, much wider than the grid. */
  template <int dim>
  std::string floor_text()
  {
    return set("Lower corner", coordinates<dim>({{-5, -5, -5}})) + set("Upper corner", coordinates<dim>({{6, 0.2, 6}}));
  }

  template <int dim>
  std::string ball_text(const std::string &velocity, const double height = 0.5)
  {
    return set("Shape", "ball") + set("Centre", coordinates<dim>({{0.5, height, 0.5}})) + set("Radius", "0.25") +
           set("Velocity", velocity);
  }

  template <int dim>
  double strain_energy(Run<dim> &run)
  {
    auto               &particles = run.model.particles;
    std::vector<double> densities(particles.size());
    const auto          ranges = material_ranges(particles, 0.);
    run.model.materials[0]->strain_energy_densities(ranges[0], densities.data());
    double result = 0;
    for (unsigned int p = 0; p < particles.size(); ++p)
      result += densities[p] * particles.component(particles.volume, 0)[p];
    return sum(result);
  }

  template <int dim>
  Tensor<1, dim> centre(const Run<dim> &run)
  {
    const auto    &particles = run.model.particles;
    Tensor<1, dim> moment;
    double         mass = 0;
    for (unsigned int p = 0; p < particles.size(); ++p)
    {
      mass += particles.component(particles.mass, 0)[p];
      moment += particles.component(particles.mass, 0)[p] * particles.vector(particles.position, p);
    }
    return Utilities::MPI::sum(moment, MPI_COMM_WORLD) / sum(mass);
  }
} // namespace

/**
 * A ball falls on a floor and rebounds: its momentum changes by the impulse of the contact, in every step; what work
 * the contact has done when it is over is next to nothing, since a barrier gives back what it takes; the energy of the
 * body follows that work; and no particle ever touches the floor.
 */
template <int dim>
void contact_bounce()
{
  // A soft barrier, which the ball does not reach yet, so that it is stopped slowly and does not ring.
  Run<dim>     run(contact_text<dim>(ball_text<dim>(dim == 2 ? "0.1; -0.5" : "0.1; -0.5; 0.05", 0.6),
                                 floor_text<dim>() + set("Pressure", "10") + set("Distance", "0.1") +
                                   set("Step fraction", "0.02")));
  auto        &contact = *run.model.contacts.all[0];
  const double start   = run.report.kinetic_energy;
  double       work = 0, impulse_error = 0, nearest = 0, most_taken = 0, tangential = 0, strongest = 0;
  const double size = run.momentum().norm();
  unsigned int n    = 0;
  for (; n < 3000 && (contact.nearness > 0 || run.momentum()[1] < 0); ++n)
  {
    const auto   before = run.momentum();
    const double dt     = run.stepper->step_size(run.model, run.report);
    run.step(dt);
    raise(impulse_error, (run.momentum() + run.model.grid.lost_momentum - before - dt * contact.force).norm() / size);
    strongest = std::max(strongest, contact.force.norm());
    work += contact.work;
    nearest    = std::max(nearest, contact.nearness);
    most_taken = std::max(most_taken, -work);
    for (unsigned int d = 0; d < dim; ++d)
      if (d != 1)
        raise(tangential, contact.force[d]);
  }
  const double kinetic = run.report.kinetic_energy, strain = strain_energy(run);
  check_true("it rebounds", n < 3000 && run.momentum()[1] > 0.5 * size);
  check("impulse", impulse_error, 1e-12);
  check("without friction nothing along the floor", tangential, 1e-12 * strongest);
  check("work of the contact over the energy", work / start, 1e-2);
  check_range("the most it has taken", most_taken / start, 1e-3, 1);
  check("energy less its work", (kinetic + strain - start - work) / start, 2e-2);
  check_range("least distance, of the reach", 1 - nearest, 1e-3, 0.9);
}

/**
 * A block on a slope. While it slides, the contact's tangential force is mu times its normal one, and it gains
 * g (sin - mu cos) but for what its bouncing has of the normal impulse; below the angle of friction it sticks: its
 * speed stays below that of sticking.
 */
template <int dim>
void contact_slope()
{
  const double g    = 2;
  const auto   text = [&](const double degrees, const double speed) {
    const double       a = degrees * numbers::PI / 180;
    std::ostringstream force, velocity;
    force << std::setprecision(17) << g * std::sin(a) << "; " << -g * std::cos(a) << (dim == 3 ? "; 0" : "");
    velocity << speed << "; 0" << (dim == 3 ? "; 0" : "");
    // The lowest particles lie where the barrier bears the weight, nearly.
    return contact_text<dim>(
      set("Lower corner", coordinates<dim>({{0.2, 0.199, 0.3}})) +
        set("Upper corner", coordinates<dim>({{0.45, 0.449, 0.55}})) + set("Velocity", velocity.str()),
      floor_text<dim>() + firm + set("Friction coefficient", "0.5"), set("Body force", force.str()), "0");
  };
  const double angle = 40 * numbers::PI / 180;
  {
    Run<dim>       sliding(text(40, 0.5));
    auto          &contact = *sliding.model.contacts.all[0];
    double         mass = sliding.report.mass, ratio_error = 0;
    Tensor<1, dim> impulse;
    const double   start = sliding.momentum()[0];
    for (unsigned int n = 0; n < 400; ++n)
    {
      const double dt = sliding.stepper->step_size(sliding.model, sliding.report);
      sliding.step(dt);
      impulse += dt * contact.force;
      raise(ratio_error, (contact.force[0] + 0.5 * contact.force[1]) / (mass * g));
    }
    const double wanted =
      mass * g * (std::sin(angle) - 0.5 * std::cos(angle)) * sliding.time - 0.5 * sliding.momentum()[1];
    check("sliding: friction over normal force", ratio_error, 1e-12);
    check("sliding: momentum gained", (sliding.momentum()[0] - start) / wanted - 1, 1e-10);
    check_range("sliding: normal impulse over the weight's", impulse[1] / (mass * g * std::cos(angle) * sliding.time),
                0.9, 1.1);
  }
  {
    Run<dim>     sticking(text(20, 0));
    const double c       = std::sqrt(1000 * 0.7 / (1.3 * 0.4) / 2); // sqrt(E (1 - nu) / ((1 + nu) (1 - 2 nu) rho))
    double       fastest = 0;
    for (unsigned int n = 0; n < 600; ++n)
    {
      sticking.step(sticking.stepper->step_size(sticking.model, sticking.report));
      if (n > 300)
        fastest = std::max(fastest, std::abs(sticking.momentum()[0] / sticking.report.mass));
    }
    check_range("sticking: time, in that of sliding to the speed", sticking.time * g * 0.3 / (1e-3 * c), 3, 1000);
    check("sticking: speed over that of sticking", fastest / (1e-3 * c), 1.);
  }
}

/** A ball that expands in a ball, and one in facets of it, stays in the middle and inside. */
template <int dim>
void contact_container()
{
  const std::string   expands = dim == 2 ? "24*(x-0.5); 24*(y-0.5)" : "24*(x-0.5); 24*(y-0.5); 24*(z-0.5)";
  const TemporaryFile file(".stl", stl_text(sphere_surface(Point<3>(0.5, 0.5, 0.5), 0.27, 8)));
  const std::string   ball =
    set("Surface", "ball") + set("Centre", coordinates<dim>({{0.5, 0.5, 0.5}})) + set("Radius", "0.27");
  std::vector<std::string> containers{ball};
  if (dim == 3)
    containers.push_back(set("Surface", "surface") + set("File", file.name));
  for (const auto &container : containers)
  {
    Run<dim> run(contact_text<dim>(ball_text<dim>(expands), container + firm + set("Friction coefficient", "0.3")));
    double   largest = 0, nearest = 0, force = 0;
    Tensor<1, dim> middle;
    for (unsigned int d = 0; d < dim; ++d)
      middle[d] = 0.5;
    for (unsigned int n = 0; n < 300; ++n)
    {
      run.step(run.stepper->step_size(run.model, run.report));
      raise(largest, (centre(run) - middle).norm());
      nearest = std::max(nearest, run.model.contacts.all[0]->nearness);
      raise(force, run.model.contacts.all[0]->force.norm());
    }
    const auto &particles = run.model.particles;
    double      farthest  = 0;
    for (unsigned int p = 0; p < particles.size(); ++p)
      farthest = std::max(farthest, (particles.vector(particles.position, p) - middle).norm());
    const std::string name = container == ball ? "ball" : "facets";
    check(name + ": centre", largest / 0.25, 1e-3);
    check_range(name + ": least distance, of the reach", 1 - nearest, 1e-6, 0.95);
    check_true(name + ": inside", max(farthest) < 0.27);
  }
}

/** Who runs through the wall in a step that is much too long is named; and wrong entries. */
template <int dim>
void contact_errors()
{
  check_error<RunError>(
    "through the wall", {"has run through the surface of the contact 'wall', from", "Raise its pressure"}, [] {
      Run<dim> run(contact_text<dim>(ball_text<dim>(dim == 2 ? "0; -2" : "0; -2; 0"), floor_text<dim>() + firm));
      run.step(0.05);
    });
  const auto refuse = [](const std::string &name, const std::vector<std::string> &parts, const std::string &entries) {
    check_error<EntryError>(
      name, parts, [&] { Run<dim> run(contact_text<dim>(ball_text<dim>(dim == 2 ? "0; 0" : "0; 0; 0"), entries)); });
  };
  refuse("no pressure", {"/Contacts/wall: Pressure", "must be positive"}, floor_text<dim>() + set("Pressure", "0"));
  refuse("friction", {"Friction coefficient", "not be negative"},
         floor_text<dim>() + firm + set("Friction coefficient", "-1"));
  refuse("empty box", {"/Contacts/wall: Upper corner", "is empty"},
         firm + set("Upper corner", coordinates<dim>({{0, 1, 1}})));
  refuse("small ball", {"/Contacts/wall: Radius", "finer grid"}, firm + set("Surface", "ball") + set("Radius", "0.05"));
}

template void contact_bounce<2>();
template void contact_bounce<3>();
template void contact_slope<2>();
template void contact_slope<3>();
template void contact_container<2>();
template void contact_container<3>();
template void contact_errors<2>();
template void contact_errors<3>();

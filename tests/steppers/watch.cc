#include <talus/steppers/watch.h>

#include "../setup.h"

using namespace Test;
using namespace dealii;

namespace
{
  template <int dim>
  std::string text()
  {
    return skewed_grid<dim>({{6, 5, 4}}) + body_text(set("Lower corner", coordinates<dim>({{-0.2, 0.78, 0.325}})) +
                                                     set("Upper corner", coordinates<dim>({{0.2, 1.02, 0.575}})));
  }

  /** Looks at all particles in blocks, as after a step of size dt. */
  template <int dim>
  Report look(Setup<dim> &setup, const double dt, const Report *before = nullptr)
  {
    auto                  &particles = setup.particles;
    const auto             ranges    = material_ranges(particles, dt);
    Watch<dim>             watch(setup);
    constexpr unsigned int block = 21;
    watch.start(ranges, /* time = */ 0.5, dt);
    particles.start_relocation();
    for (unsigned int begin = 0; begin < particles.size(); begin += block)
    {
      const unsigned int end = std::min(begin + block, particles.size());
      particles.relocate(begin, end);
      watch.look_at(begin, end);
    }
    return watch.finish(0.25, before);
  }

  /** The number of the particle with this id; of none on the ranks that do not have it. */
  template <int dim>
  unsigned int find(const Setup<dim> &setup, const unsigned int id)
  {
    const auto &ids = setup.particles.id;
    return std::find(ids.begin(), ids.end(), id) - ids.begin();
  }

  template <int dim>
  void put(Setup<dim> &setup, const unsigned int id, const unsigned int field, const unsigned int c, const double value)
  {
    const unsigned int p = find(setup, id);
    if (p < setup.particles.size())
      setup.particles.component(field, c)[p] = value;
  }
} // namespace

/** Sums and maxima against loops over the particles. */
template <int dim>
void sound_state()
{
  Setup<dim> setup(text<dim>());
  auto      &particles = setup.particles;
  setup.randomize(particles.velocity, 1);
  setup.randomize(particles.grad_v, 2);
  for (const bool is_uniform : {true, false})
  {
    setup.accelerate(std::string(is_uniform ? "2*t; -3" : "x; -y*t") + (dim == 3 ? "; 1" : ""));
    Report before; // particles have come along their velocities
    for (unsigned int p = 0; p < particles.size(); ++p)
      for (unsigned int d = 0; d < dim; ++d)
        before.moment[d] += particles.component(particles.mass, 0)[p] *
                            (setup.position(p)[d] - particles.component(particles.initial_position, d)[p] -
                             1e-3 * particles.component(particles.velocity, d)[p]);
    for (double &component : before.moment)
      component = sum(component);
    const Report report = look(setup, /* dt = */ 1e-3, &before);

    // c = sqrt(M / rho), M = E (1 - nu) / ((1 + nu) (1 - 2 nu)).
    const double c     = std::sqrt(7 * 0.8 / (1.2 * 0.6) / 3);
    double       speed = 0, mass = 0, energy = 0, power = 0;
    for (unsigned int p = 0; p < particles.size(); ++p)
    {
      const auto     v = particles.vector(particles.velocity, p);
      const auto     x = setup.position(p) - 0.5e-3 * v; // the middle of the step's way
      const double   m = particles.component(particles.mass, 0)[p];
      Tensor<1, dim> b;
      b[0] = is_uniform ? 1 : x[0];
      b[1] = is_uniform ? -3 : -0.5 * x[1];
      if (dim == 3)
        b[dim - 1] = 1;
      speed = std::max(speed, c + v.norm());
      mass += m;
      energy += 0.5 * m * v.norm_square();
      power += m * (b * v);
    }
    check("signal speed", report.signal_speed - Test::max(speed), 1e-14);
    check("mass", report.mass - sum(mass), 1e-14);
    check("kinetic energy", report.kinetic_energy - sum(energy), 1e-14);
    // Of uniform forces by the difference of two sums, which is divided by the step.
    check("power of the body force", report.body_force_power - sum(power), is_uniform ? 1e-10 : 1e-13);
    check("displacement", report.displacement - 0.25, 1e-16);
    check_true("sound", !report.has_failed && !report.needs_migration && report.failure.empty());
  }
}

/** Each limit is found, and what is reported is the particle of lowest number, wherever it lies. */
template <int dim>
void broken_limits()
{
  const double infinity      = std::numeric_limits<double>::infinity();
  const auto   check_failure = [](const std::string &name, const std::string &what, const auto &spoil) {
    Setup<dim> setup(text<dim>());
    spoil(setup);
    const Report report = look(setup, /* dt = */ 0.1);
    if (report.failure.find(what) != 0)
      std::cout << "    got: " << report.failure << std::endl;
    check_true(name, report.has_failed && report.failure.find(what) == 0 && !report.remedy.empty());
  };
  check_failure("velocity", "Particle 7 has a velocity or stress that is not a finite number, at (", [&](auto &setup) {
    put(setup, 7, setup.particles.velocity, 1, std::nan(""));
    put(setup, 60, setup.particles.velocity, 1, std::nan(""));
  });
  check_failure("stress", "Particle 8 has a velocity or stress",
                [&](auto &setup) { put(setup, 8, setup.particles.stress, 2, infinity); });
  check_failure("volume ratio", "Particle 9 has the volume ratio J = 11, outside (0, 10], at (", [&](auto &setup) {
    put(setup, 70, setup.particles.F, 0, -1.);
    put(setup, 9, setup.particles.F, 0, 11.);
  });
  check_failure("inverted", "Particle 10 has the volume ratio J = -1,",
                [&](auto &setup) { put(setup, 10, setup.particles.F, 0, -1.); });
  check_failure("increment", "Particle 11 deforms by |grad v| dt = 0.6 in one step, more than 0.5, at (",
                [&](auto &setup) { put(setup, 11, setup.particles.grad_v, 1, 6.); });
  check_failure("outside", "Particle 12 left the grid, at (", [&](auto &setup) {
    put(setup, 50, setup.particles.position, 0, -9.);
    put(setup, 12, setup.particles.position, 1, 9.);
  });
  check_failure("one outside before one that is broken", "Particle 13 left the grid", [&](auto &setup) {
    put(setup, 50, setup.particles.F, 0, 0.);
    put(setup, 13, setup.particles.position, 0, -9.);
  });
  check_failure("what is broken before what has left", "Particle 14 has the volume ratio J = 0", [&](auto &setup) {
    put(setup, 14, setup.particles.F, 0, 0.);
    put(setup, 14, setup.particles.position, 0, -9.);
  });
}

/** What is found is what is reported, also where round-off decides: |grad v| dt within some 1e-16 of 0.5. */
template <int dim>
void edge()
{
  Setup<dim>         setup(text<dim>());
  const double       dt      = 0.1;
  const unsigned int id      = 3;
  unsigned int       n_found = 0, n_wrong = 0;
  for (unsigned int trial = 0; trial < 400; ++trial)
  {
    Tensor<2, dim> g;
    for (unsigned int c = 0; c < dim * dim; ++c)
      g[c / dim][c % dim] = hashed_jitter(5, trial, c);
    g *= 0.5 / dt / g.norm() * (1 + (trial % 5 - 2.) * 1e-16);
    for (unsigned int c = 0; c < dim * dim; ++c)
      put(setup, id, setup.particles.grad_v, c, g[c / dim][c % dim]);
    const Report report = look(setup, dt);
    n_found += report.has_failed;
    n_wrong += report.has_failed != (report.failure.find("Particle 3 deforms by |grad v| dt = 0.5 in one step") == 0);
  }
  check("what is found is reported", n_wrong, 0.5);
  check_range("found of 400", n_found, 40, 360);
}

template void sound_state<2>();
template void sound_state<3>();
template void broken_limits<2>();
template void broken_limits<3>();
template void edge<2>();
template void edge<3>();

#include <talus/steppers/stepper.h>
#include <talus/steppers/sweep.h>

#include "../setup.h"

using namespace Test;
using namespace dealii;

/** Stages run block by block in their order, and once. */
void sweep()
{
  Timing      timing;
  Sweep       sweep(timing);
  std::string calls;
  const auto  stage = [&calls](const std::string &name) {
    return [&calls, name](const unsigned int begin, const unsigned int end) {
      calls += name + " " + std::to_string(begin) + "-" + std::to_string(end) + ", ";
    };
  };
  const unsigned int first = timing.add("first"), second = timing.add("second");
  sweep.add(first, stage("a"));
  sweep.add(second, stage("b"));
  sweep.run(5, 2);
  check_true("blocks", calls == "a 0-2, b 0-2, a 2-4, b 2-4, a 4-5, b 4-5, ");
  sweep.run(5, 2);
  check_true("are forgotten", calls.size() == 42);
  sweep.add(first, stage("c"));
  sweep.run(2, 2);
  check_true("a sweep that was cut goes on", calls.substr(42) == "c 0-2, ");
  sweep.add(first, stage("d"));
  sweep.run(0, 2);
  check_true("no particles", calls.size() == 49);
}

/** A body in free flight: step size by Eqs. (35), (37), positions after some steps. */
template <int dim>
void explicit_steps()
{
  const std::string velocity = dim == 2 ? "0.3; -0.2" : "0.3; -0.2; 0.1";
  for (const double fixed : {0., 1e-3})
  {
    auto parameters = Parameters::from_text(
      section("Grid", set("Cells", dim == 2 ? "8, 8" : "8, 8, 8")) +
      body_text(set("Lower corner", coordinates<dim>({{0.375, 0.375, 0.375}})) +
                set("Upper corner", coordinates<dim>({{0.625, 0.625, 0.625}})) + set("Velocity", velocity)) +
      section("Run", set("Courant number", "0.4") + set("Step size", std::to_string(fixed))));
    Model<dim> model(parameters, MPI_COMM_WORLD);
    auto       stepper = parameters.make<Stepper<dim>>("/Run", "Stepper", "explicit", "");
    parameters.parse();
    model.create();
    Timing timing;
    Report report = stepper->start(model, timing);

    Tensor<1, dim> v;
    for (unsigned int d = 0; d < dim; ++d)
      v[d] = std::array<double, 3>{{0.3, -0.2, 0.1}}[d];
    const double c = std::sqrt(7 * 0.8 / (1.2 * 0.6) / 3), critical = 0.125 / (c + v.norm());
    double       time = 0;
    for (unsigned int step = 0; step < 40; ++step)
    {
      const double dt = stepper->step_size(model, report);
      check("step size over its critical value", dt / (fixed > 0 ? fixed : 0.4 * critical) - 1, 1e-10);
      report = stepper->advance(model, report, time, dt);
      time += dt;
    }
    const auto &particles = model.particles;
    double      error     = 0;
    for (unsigned int p = 0; p < particles.size(); ++p)
      raise(
        error,
        (particles.vector(particles.position, p) - particles.vector(particles.initial_position, p) - time * v).norm());
    check("free flight", max(error), 1e-13);
    check_true("says what it did", stepper->summary().find(" migrations between ranks, ") != std::string::npos);
  }
}

template void explicit_steps<2>();
template void explicit_steps<3>();

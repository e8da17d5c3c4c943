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

/** What the Courant number is if nobody says it, and when a warning says what single particles bear. */
template <int dim>
void courant_numbers()
{
  const auto look = [](const std::string &kernel, const std::string &transfer, const std::string &given,
                       const double wanted, const bool warns) {
    Parameters parameters = Parameters::from_text(section("Grid", set("Spacing", "0.125")) + body_text("") +
                                                  section("Kernel", set("Type", kernel)) + transfer_text(transfer) +
                                                  (given.empty() ? "" : section("Run", set("Courant number", given))));
    Model<dim> model(parameters, MPI_COMM_WORLD);
    auto       stepper = parameters.make<Stepper<dim>>("/Run", "Stepper", "explicit", "");
    parameters.parse();
    model.create();
    Timing            timing;
    const Report      report = stepper->start(model, timing);
    const std::string name   = kernel + ", " + transfer + ", " + given;
    check(name + ": number", stepper->step_size(model, report) * report.signal_speed / 0.125 - wanted, 1e-12);
    check_true(name + ": warning", stepper->warning(model).empty() != warns);
  };
  look("quadratic B-spline", "TPIC", "", dim == 2 ? 0.4 : 0.33, false);
  look("cubic B-spline", "FLIP", "", dim == 2 ? 0.56 : 0.46, false);
  look("uGIMP", "PIC", "", dim == 2 ? 0.32 : 0.26, false);
  look("linear", "FLIP", "", dim == 2 ? 0.4 : 0.33, false);
  // A Poisson's ratio of .2 bears sqrt(2/1.25) and sqrt(3/1.5) times more than a fluid: FLIP .516, .471, APIC .632,
  // .577.
  look("quadratic B-spline", "FLIP", dim == 2 ? "0.51" : "0.46", dim == 2 ? 0.51 : 0.46, false);
  look("quadratic B-spline", "FLIP", dim == 2 ? "0.53" : "0.48", dim == 2 ? 0.53 : 0.48, true);
  look("quadratic B-spline", "TPIC", "0.55", 0.55, false);
  look("quadratic B-spline", "APIC", dim == 2 ? "0.62" : "0.57", dim == 2 ? 0.62 : 0.57, false);
  look("quadratic B-spline", "APIC", dim == 2 ? "0.64" : "0.59", dim == 2 ? 0.64 : 0.59, true);
}

/** A body in free flight: step size by Eqs. (35), (37), positions after some steps. */
template <int dim>
void explicit_steps()
{
  const std::string velocity = dim == 2 ? "0.3; -0.2" : "0.3; -0.2; 0.1";
  for (const double fixed : {0., 1e-3})
  {
    Parameters parameters = Parameters::from_text(
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

/** A particle beyond the nodes of its rank would lose what it carries there: the next step refuses it. */
template <int dim>
void strays()
{
  Parameters parameters = Parameters::from_text(section("Grid", set("Cells", coordinates<dim>({{8, 4, 4}}))) +
                                                body_text(set("Upper corner", coordinates<dim>({{1, 1, 1}}))));
  Model<dim> model(parameters, MPI_COMM_WORLD);
  auto       stepper = parameters.make<Stepper<dim>>("/Run", "Stepper", "explicit", "");
  parameters.parse();
  model.create();
  Timing     timing;
  Report     report   = stepper->start(model, timing);
  auto      &set      = model.particles;
  double    *x        = set.component(set.position, 0);
  const bool is_alone = Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) == 1;
  const auto refusal  = [&]() -> std::string {
    try
    {
      stepper->advance(model, report, 0., 1e-6);
    }
    catch (const ExceptionBase &error)
    {
      return error.what();
    }
    return "";
  };
  check_true("a sound step", refusal().empty());
  // Two ranks meet at x = 1/2.
  x[0] = x[0] < 0.5 ? 0.9 : 0.1;
  set.relocate();
  check_true("across the ranks' border", is_alone || refusal().find("have strayed") != std::string::npos);
  set.migrate();
  check_true("after migration", refusal().empty());
  x    = set.component(set.position, 0);
  x[0] = 1.5;
  set.relocate();
  check_true("out of the grid", refusal().find("left the grid") != std::string::npos);
}

template void courant_numbers<2>();
template void courant_numbers<3>();
template void explicit_steps<2>();
template void explicit_steps<3>();
template void strays<2>();
template void strays<3>();

#include <talus/steppers/explicit_step.h>

#include "transfer.h"

using namespace Test;
using namespace dealii;

namespace
{
  template <int dim>
  Model<dim> model_of(Setup<dim> &s)
  {
    return {s.grid, s.particles, *s.kernel, *s.transfer, s.boundary, s.materials, s.acceleration, s.tractions};
  }

  /** 8 cells along x and 4 across: two ranks share it at x = 1/2. */
  template <int dim>
  std::string two_halves()
  {
    return section("Grid", set("Cells", coordinates<dim>({{8, 4, 4}}))) + kernel_text("quadratic B-spline", "WLS") +
           box_body<dim>({{0, 0, 0}}, {{1, 1, 1}}, 0);
  }

  /** What is thrown, and nothing if nothing is. */
  template <class Action>
  std::string message_of(const Action &action)
  {
    try
    {
      action();
    }
    catch (const RunError &error)
    {
      return error.message;
    }
    catch (const ExceptionBase &error)
    {
      return error.what();
    }
    return "";
  }
} // namespace

/**
 * What a step finds is what is told, at the very edge too: |grad v| dt as the root of a sum and as a sum of squares are
 * not the same number. Values that round to 1/2 in one way and not in the other are among those tried.
 */
template <int dim>
void limits()
{
  Setup<dim>   setup(two_halves<dim>());
  auto         model   = model_of(setup);
  auto        &set     = setup.particles;
  const double id      = Utilities::MPI::min(static_cast<double>(set.id[7]), MPI_COMM_WORLD);
  double       wrong   = 0;
  unsigned int n_found = 0, n_edge = 0;
  for (unsigned int k = 0; k < 200; ++k)
  {
    const double dt = 0.01 + 1e-4 * k, g = 0.5 / (dim * dt) * (1 + 1e-16 * (static_cast<int>(k % 9) - 4));
    setup.fill(set.grad_v, [&](const unsigned int p, unsigned int) { return p == 7 ? g : 0.; });
    const auto now = survey(model, 0., dt);
    if (!now.has_failed)
      continue;
    ++n_found;
    n_edge += dt * set.matrix(set.grad_v, 7).norm() <= 0.5;
    const std::string told = message_of([&] { report_failure(model, now.failures, 1, 0., dt); });
    wrong += told.find("Particle " + std::to_string(static_cast<int>(id)) + " deforms by") != 0;
  }
  check("particles found and not told", wrong, 0.5);
  check_true("found", n_found > 20);
  check_true("at the edge", n_edge > 0);

  // One limit after the other, and that of the lowest id first.
  setup.fill(set.grad_v, [](unsigned int, unsigned int) { return 0.; });
  const auto told = [&](const double dt) {
    const auto now = survey(model, 0., dt);
    return now.has_failed ? message_of([&] { report_failure(model, now.failures, 1, 0., dt); }) : "";
  };
  check_true("nothing wrong", told(1e-3).empty());
  set.component(set.F, 0)[9] = -1;
  check_true("J", told(1e-3).find("has the volume ratio J = -1, outside (0, 10]") != std::string::npos);
  set.component(set.stress, 0)[9] = std::nan("");
  check_true("NaN before J", told(1e-3).find("not a finite number") != std::string::npos);
  set.component(set.stress, 0)[9]   = 0;
  set.component(set.F, 0)[9]        = 1;
  const double before               = set.component(set.position, 1)[7];
  set.component(set.position, 1)[7] = 2;
  set.relocate();
  check_true("outside", told(1e-3).find("Particle " + std::to_string(static_cast<int>(id)) + " left the grid") == 0);
  set.component(set.position, 1)[7] = before;
  set.relocate();
  check_true("back inside", told(1e-3).empty());
}

/** A particle beyond the nodes of its rank would lose what it carries there: the next step refuses it. */
template <int dim>
void strays()
{
  Setup<dim> setup(two_halves<dim>());
  auto       model = model_of(setup);
  auto      &set   = setup.particles;
  Timing     timing;
  StepTiming step_timing(timing);
  const bool is_alone = Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) == 1;
  const auto advance  = [&] { explicit_step(model, 0., 1e-6, step_timing); };
  advance();
  const bool is_left                = setup.position(0)[0] < 0.5;
  set.component(set.position, 0)[0] = is_left ? 0.9 : 0.1;
  set.relocate();
  check_true("across the ranks' border", message_of(advance).find("have strayed") != std::string::npos || is_alone);
  set.migrate();
  const double mass = 3;
  setup.scatter();
  setup.grid.fields.add_copies_to_owners();
  double on_nodes = 0;
  for (unsigned int i = 0; i < setup.grid.fields.n_owned(); ++i)
    on_nodes += setup.grid.fields[i][NodalFields<dim>::mass];
  check("mass after migration", sum(on_nodes) / mass - 1, 1e-12);
  check_true("after migration", message_of(advance).empty());
  set.component(set.position, 0)[0] = 1.5;
  set.relocate();
  check_true("out of the grid", message_of(advance).find("left the grid") != std::string::npos);
}

template void limits<2>();
template void limits<3>();
template void strays<2>();
template void strays<3>();

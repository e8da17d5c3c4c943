#include <talus/fem/plastic_reference.h>

#include <deal.II/base/patterns.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    // Round-off leaves about 1e-12; a looser bound would be seen where runs on several numbers of ranks are compared.
    const double tolerance      = 1e-10;
    const double line_accuracy  = 0.3;
    const double greatest_force = 1e140; // sums of squares are numbers
  }                                      // namespace

  template <int dim>
  PlasticReference<dim>::PlasticReference(Parameters &parameters, const std::string &section,
                                          const MPI_Comm communicator) :
    ParameterAcceptor(section),
    communicator(communicator), box(section), law(section + "/J2"), conditions(parameters, section + "/Conditions"),
    triangulation(communicator), mapping(2), fe(FE_Q<dim>(2), dim), dof_handler(triangulation)
  {
    add_parameter("Integration", integration,
                  "'B-bar': the volume change is projected onto linear functions in each cell; 'full': it is not, and "
                  "plastic flow locks.",
                  this->prm, Patterns::Selection("B-bar|full"));
    add_parameter("Steps", n_steps, "Number of equal load steps from rest to the end time.", this->prm,
                  Patterns::Integer(1));
  }

  template <int dim>
  void PlasticReference<dim>::set_mesh(const std::function<void(Mesh &)> &create)
  {
    Assert(triangulation.n_levels() == 0, ExcMessage("Call set_mesh() once, before solve()."));
    create(triangulation);
  }

  template <int dim>
  void PlasticReference<dim>::solve(const double end_time, const std::function<void(double)> &report)
  {
    set_up();
    const double step = end_time / n_steps;
    AssertThrow(find_equilibrium(0.),
                RunError("The plastic reference finds no equilibrium with the displacements at the start, t = 0. "
                         "Let them start from zero."));
    commit(0.);
    if (report)
      report(0.);
    for (unsigned int n = 1; n <= n_steps; ++n)
    {
      advance(n == n_steps ? end_time : n * step, step);
      if (report)
        report(solved_time);
    }
  }

  template <int dim>
  void PlasticReference<dim>::advance(const double time, const double full_step)
  {
    double             step              = time - solved_time;
    const unsigned int iterations_before = iterations, halvings_before = halvings;
    while (solved_time < time)
    {
      const bool   is_last = solved_time + step >= time - 1e-9 * full_step;
      const double next    = is_last ? time : solved_time + step;
      if (find_equilibrium(next))
      {
        commit(next);
        step *= 2.;
        continue;
      }
      // A fresh start from the elastic response: the extrapolation may be what failed.
      older_time = solved_time;
      step /= 2.;
      ++halvings;
      const unsigned int n_iterations = iterations - iterations_before, n_halvings = halvings - halvings_before;
      const bool         is_shortest = step < full_step / (1 << limits.halvings);
      if (is_shortest || n_iterations > limits.all_iterations || n_halvings > limits.all_halvings)
      {
        std::ostringstream text;
        text << "The plastic reference finds no equilibrium after t = " << solved_time
             << (is_shortest ? ", not even" : "") << " for a step of " << 2. * step << ": " << imbalance_history.back()
             << " of the forces are out of balance after " << imbalance_history.size() << " iterations (" << tolerance
             << " is wanted). The load step to t = " << time << " took " << n_iterations << " iterations and "
             << n_halvings
             << " halvings until here. Soften the material less, take more 'Steps' or finer cells in section '"
             << get_section_name().substr(1) << "', or end earlier.";
        throw RunError(text.str());
      }
    }
  }

  template <int dim>
  bool PlasticReference<dim>::find_equilibrium(const double time)
  {
    conditions.prescribe(mapping, dof_handler, time);
    // Plastic flow goes on as it did: extrapolation leaves little to do at a limit load.
    solution = old_solution;
    if (solved_time > older_time)
    {
      const double factor = (time - solved_time) / (solved_time - older_time);
      solution.add(factor, old_solution, -factor, older_solution);
    }
    solution.update_ghost_values();
    compute_residual();

    imbalance_history.clear();
    double load = 0.;
    for (unsigned int n = 0; n < limits.iterations; ++n)
    {
      assemble(conditions.constraints(&solution));
      if (!(right_hand_side.linfty_norm() < greatest_force))
      {
        imbalance_history.push_back(std::numeric_limits<double>::infinity());
        return false;
      }
      if (n == 0)
        load = right_hand_side.l2_norm();
      const Vector increment = solve_system(conditions.constraints(&solution));
      ++iterations;
      if (n == 0)
        move(increment, 1.);
      else
        search_line(increment);

      const double force = free_force();
      imbalance_history.push_back(cell_forces > 0. ? force / cell_forces : 0.);
      if (!std::isfinite(force))
        return false;
      // The second term is the round-off of a body that moves as a whole.
      if (force <= tolerance * cell_forces + 1e-13 * load)
        return true;
    }
    return false;
  }

  template <int dim>
  void PlasticReference<dim>::search_line(const Vector &increment)
  {
    // Equilibrium is where the work of deformation, convex without softening, is least. On the way its slope is the
    // work of the residual. Where the slope at the end exceeds that at the start, the step went too far.
    const double start = residual * increment;
    double       low = 0., low_slope = start, high = 1.;
    move(increment, 1.);
    double high_slope = residual * increment;
    double slope = high_slope, at = 1.;
    for (unsigned int n = 0; n < 5 && start < 0. && slope > -line_accuracy * start; ++n)
    {
      const double next = low + (high - low) * std::clamp(low_slope / (low_slope - high_slope), .1, .9);
      move(increment, next - at);
      at                                    = next;
      slope                                 = residual * increment;
      (slope < 0. ? low : high)             = at;
      (slope < 0. ? low_slope : high_slope) = slope;
    }
  }

  template <int dim>
  void PlasticReference<dim>::move(const Vector &increment, const double factor)
  {
    solution.add(factor, increment);
    solution.update_ghost_values();
    compute_residual();
  }

  template <int dim>
  double PlasticReference<dim>::free_force() const
  {
    return std::sqrt(conditions.free_norm_square(residual));
  }

  template <int dim>
  void PlasticReference<dim>::commit(const double time)
  {
    older_solution = old_solution;
    older_time     = solved_time;
    old_solution   = solution;
    solved_time    = time;
    old_states     = states;
  }

  template class PlasticReference<2>;
  template class PlasticReference<3>;
} // namespace Talus

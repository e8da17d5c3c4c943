#include "moved_nodes.h"

using namespace Test;

/**
 * Damping against f_i - alpha |f_i| sign(v_i^n), with the force of move(), dt f = 0.25 m. The nodes of a slip face
 * are damped along the face alone, and the reaction is that of the undamped force.
 */
template <int dim>
void damping()
{
  const double alpha = 0.7, dt = 0.1;
  Setup<dim>   setup(section("Grid", set("Spacing", "0.25")) +
                     conditions("one", section("one", set("Type", "slip") + set("Boundary ids", "2"))));
  setup.boundary.damping.factor = alpha;
  move(setup, 0, dt);
  double error = 0, work = 0, reaction = 0;
  bool   has_both_signs[2] = {false, false};
  for (unsigned int i = 0; i < setup.grid.fields.n_owned(); ++i)
    for (unsigned int d = 0; d < dim; ++d)
    {
      const double *node   = setup.grid.fields[i];
      const double  before = trial(setup, i, d) - 0.25, force = mass(setup, i) * 0.25 / dt;
      const double  damped = force - alpha * std::abs(force) * (before > 0 ? 1. : before < 0 ? -1. : 0.);
      double        v      = before + dt * damped / mass(setup, i);
      if (d == 1 && is(setup.grid.node_position(i)[1], 0))
      {
        v = 0;
        reaction += mass(setup, i) * trial(setup, i, d) / dt;
      }
      else
      {
        work += dt * (damped - force) * v;
        has_both_signs[before > 0] = true;
      }
      raise(error, node[NodalFields<dim>::velocity + d] - v);
      raise(error, node[NodalFields<dim>::increment + d] - (v - before));
    }
  check("velocity and increment", error, 1e-14);
  check("work", setup.boundary.damping.work - work, 1e-12);
  check("reaction", setup.boundary.conditions[0]->reaction[1] - reaction, 1e-11);
  check_true("velocities of both signs", has_both_signs[0] && has_both_signs[1]);
}

template void damping<2>();
template void damping<3>();

#include "moved_nodes.h"

using namespace Test;
using namespace dealii;

namespace
{
  /** Velocities, increments, reaction and work where `prescribed(x, d, v)` changes v and tells so. */
  template <int dim, class Prescribed>
  void compare(const std::string &name, const std::string &text, const Prescribed &prescribed)
  {
    const double time = 0.7, dt = 0.1;
    Setup<dim>   setup(section("Grid", set("Spacing", "0.25")) + conditions("one", section("one", text)));
    move(setup, time, dt);
    Tensor<1, dim> reaction, nodal_force;
    double         error = 0, work = 0;
    for (unsigned int i = 0; i < setup.grid.fields.n_owned(); ++i)
      for (unsigned int d = 0; d < dim; ++d)
      {
        double v = trial(setup, i, d);
        if (prescribed(setup.grid.node_position(i), d, v))
        {
          const double impulse = mass(setup, i) * (trial(setup, i, d) - v);
          reaction[d] += impulse / dt;
          nodal_force[d] += mass(setup, i) * 0.25 / dt;
          work -= impulse * v;
        }
        raise(error, setup.grid.fields[i][NodalFields<dim>::velocity + d] - v);
        raise(error, setup.grid.fields[i][NodalFields<dim>::increment + d] - 0.25 - (v - trial(setup, i, d)));
      }
    const auto &condition = *setup.boundary.conditions[0];
    check(name + ": velocity", error, 1e-14);
    check(name + ": reaction", (condition.reaction - reaction).norm(), 1e-11);
    check(name + ": nodal force", (condition.nodal_force - nodal_force).norm(), 1e-11);
    check(name + ": work", condition.work - work, 1e-12);
  }
} // namespace

/** Each kind of condition on faces and in a box of nodes. */
template <int dim>
void kinds()
{
  compare<dim>("no-slip on two faces", set("Type", "no-slip") + set("Boundary ids", "0, 3"),
               [](const Point<dim> &x, unsigned int, double &v) {
                 const bool acts = is(x[0], 0) || is(x[1], 1);
                 v               = acts ? 0 : v;
                 return acts;
               });
  compare<dim>("slip on two faces", set("Type", "slip") + set("Boundary ids", "0, 3"),
               [](const Point<dim> &x, const unsigned int d, double &v) {
                 const bool acts = (d == 0 && is(x[0], 0)) || (d == 1 && is(x[1], 1));
                 v               = acts ? 0 : v;
                 return acts;
               });
  // Nodes lie at multiples of a quarter; 0.25 is a node, 0.6 is not.
  compare<dim>("slip at and beyond two planes", set("Type", "slip") + set("Half spaces", "x <= 0.25, y >= 0.6"),
               [](const Point<dim> &x, const unsigned int d, double &v) {
                 const bool acts = (d == 0 && x[0] < 0.3) || (d == 1 && x[1] > 0.6);
                 v               = acts ? 0 : v;
                 return acts;
               });
  compare<dim>("no-slip on a face and beyond a plane",
               set("Type", "no-slip") + set("Boundary ids", "0") + set("Half spaces", "y>=.75"),
               [](const Point<dim> &x, const unsigned int, double &v) {
                 const bool acts = is(x[0], 0) || x[1] > 0.7;
                 v               = acts ? 0 : v;
                 return acts;
               });
  compare<dim>("velocity of one component in a box",
               set("Type", "velocity") + set("Velocity", dim == 2 ? "9; x + 2*t" : "9; x + 2*t; 9") +
                 set("Components", "y") + set("Lower corner", coordinates<dim>({{0.2, 0.2, 0.2}})) +
                 set("Upper corner", coordinates<dim>({{0.5, 0.8, 0.8}})),
               [](const Point<dim> &x, const unsigned int d, double &v) {
                 bool acts = d == 1 && x[0] < 0.6;
                 for (unsigned int e = 0; e < dim; ++e)
                   acts = acts && x[e] > 0.2 && x[e] < 0.8;
                 v = acts ? x[0] + 1.4 : v;
                 return acts;
               });
}

/** At a plane of symmetry velocity and increment are zero, and the reaction is the nodal force alone. */
template <int dim>
void symmetry()
{
  Setup<dim> setup(section("Grid", set("Spacing", "0.25")) +
                   conditions("one", section("one", set("Type", "symmetry") + set("Half spaces", "y <= 0.25") +
                                                      set("Boundary ids", "1"))));
  move(setup, 0, 0.1);
  double error = 0, force[dim] = {};
  for (unsigned int i = 0; i < setup.grid.fields.n_owned(); ++i)
    for (unsigned int d = 0; d < dim; ++d)
    {
      const auto x    = setup.grid.node_position(i);
      const bool acts = (d == 0 && is(x[0], 1)) || (d == 1 && x[1] < 0.3);
      raise(error, setup.grid.fields[i][NodalFields<dim>::velocity + d] - (acts ? 0 : trial(setup, i, d)));
      raise(error, setup.grid.fields[i][NodalFields<dim>::increment + d] - (acts ? 0 : 0.25));
      force[d] += acts ? mass(setup, i) * 0.25 / 0.1 : 0;
    }
  check("velocity and increment", error, 1e-15);
  const auto &condition = *setup.boundary.conditions[0];
  for (unsigned int d = 0; d < dim; ++d)
  {
    check("reaction", condition.reaction[d] - force[d], 1e-11);
    check("nodal force", condition.nodal_force[d] - force[d], 1e-11);
  }
  check("work", condition.work, 0.);
}

/** The last condition of the list has the last word, and pays for it alone. */
template <int dim>
void order()
{
  const auto velocity = [](const std::string &name, const std::string &value) {
    return section(name, set("Type", "velocity") + set("Boundary ids", "2") + set("Components", "x") +
                           set("Velocity", value + (dim == 2 ? "; 0" : "; 0; 0")));
  };
  Setup<dim> setup(section("Grid", set("Spacing", "0.25")) +
                   conditions("b, a", velocity("a", "3") + velocity("b", "2")));
  move(setup, 0, 0.1);
  double error = 0, reaction_of_last = 0;
  for (const unsigned int i : setup.grid.nodes_on_boundary(2))
  {
    raise(error, setup.grid.fields[i][NodalFields<dim>::velocity] - 3);
    reaction_of_last += mass(setup, i) * (2. - 3.) / 0.1;
  }
  check("velocity", error, 1e-15);
  check("reaction", setup.boundary.conditions[1]->reaction[0] - reaction_of_last, 1e-11);
}

/**
 * Coulomb friction on two opposite faces and on one, with walls that move. The reference keeps of the relative
 * velocity what the cone of half angle atan(mu) about the normal allows: |t| over the normal change is at most mu.
 */
template <int dim>
void friction()
{
  for (const double mu : {0., 0.4, 9.})
    compare<dim>("mu = " + std::to_string(mu),
                 set("Type", "friction") + set("Boundary ids", "0, 1") +
                   set("Friction coefficient", std::to_string(mu)) +
                   set("Wall velocity", dim == 2 ? "0.1*t - 0.2*x; 0.3" : "0.1*t - 0.2*x; 0.3; 1"),
                 [mu](const Point<dim> &x, const unsigned int d, double &v) {
                   if (!is(x[0], 0) && !is(x[0], 1))
                     return false;
                   const double   wall[] = {0.07 - 0.2 * x[0], 0.3, 1};
                   Tensor<1, dim> slip;
                   for (unsigned int e = 0; e < dim; ++e)
                     slip[e] = 0.5 + e - x[(e + 1) % dim] - wall[e];
                   const double normal = slip[0];
                   slip[0]             = 0;
                   if (is(x[0], 0) ? normal >= 0 : normal <= 0)
                     return false;
                   const double reach = mu * std::abs(normal);
                   if (d == 0 || slip.norm() <= reach)
                     v = wall[d];
                   else
                     v -= reach * slip[d] / slip.norm();
                   return true;
                 });
}

/** A condition acts in the steps that end after its start and by its end. */
template <int dim>
void interval()
{
  const std::string where = set("Type", "no-slip") + set("Boundary ids", "2");
  Setup<dim>        setup(section("Grid", set("Spacing", "0.25")) +
                          conditions("one", section("one", where + set("Start time", "1") + set("End time", "2"))));
  for (const double time : {0.9, 1., 1.1, 2., 2.1})
  {
    move(setup, time, 0.1);
    const bool acts  = time > 1 && time <= 2;
    double     error = 0, impulse = 0;
    for (const unsigned int i : setup.grid.nodes_on_boundary(2))
      for (unsigned int d = 0; d < dim; ++d)
      {
        raise(error, setup.grid.fields[i][NodalFields<dim>::velocity + d] - (acts ? 0 : trial(setup, i, d)));
        impulse += acts && d == 0 ? mass(setup, i) * trial(setup, i, d) : 0;
      }
    check("t = " + std::to_string(time) + ": velocity", error, 1e-15);
    check("t = " + std::to_string(time) + ": reaction", setup.boundary.conditions[0]->reaction[0] - impulse / 0.1,
          1e-11);
  }
}

#define INSTANTIATE(name)                                                                                              \
  template void name<2>();                                                                                             \
  template void name<3>();
INSTANTIATE(kinds)
INSTANTIATE(symmetry)
INSTANTIATE(order)
INSTANTIATE(friction)
INSTANTIATE(interval)

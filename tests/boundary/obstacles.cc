#include "moved_nodes.h"

using namespace Test;
using namespace dealii;

namespace
{
  std::string obstacle(const std::string &content)
  {
    return section("Obstacles", set("Names", "bed") + section("bed", content));
  }

  /** What rule (4) of doc/ground.md makes of the velocity v against a body of velocity w; components may be held. */
  template <int dim>
  Tensor<1, dim> after(const Tensor<1, dim> &v, const Tensor<1, dim> &w, const Tensor<1, dim> &n, const double mu)
  {
    const double into = -(v - w) * n;
    if (into <= 0)
      return v;
    Tensor<1, dim> along = v - w + into * n;
    const double   speed = along.norm();
    along *= speed > mu * into ? 1 - mu * into / speed : 0;
    return w + along;
  }

  template <int dim>
  Tensor<1, dim> vector(const std::array<double, 3> &numbers)
  {
    Tensor<1, dim> result;
    for (unsigned int d = 0; d < dim; ++d)
      result[d] = numbers[d];
    return result;
  }

  /** A body at rest, or turning and moving, against the rule, and what it bears. */
  template <int dim>
  void compare(const std::string &name, const std::string &motion, const double mu, const double angle_now,
               const double angle_before, const std::array<double, 3> &now, const std::array<double, 3> &before)
  {
    const double time = 0.7, dt = 0.1;
    Setup<dim>   setup(section("Grid", set("Spacing", "0.25")) +
                       obstacle(set("Formula", "3 * (0.96 * x + 0.28 * y - 0.8)") + motion +
                                set("Friction coefficient", std::to_string(mu)) +
                                set("Centre of rotation", coordinates<dim>({{0.5, 0.25, 0.1}}))));
    move(setup, time, dt);

    // It turns about z, through the centre.
    const auto turned = [](const Tensor<1, dim> &r, const double angle) {
      Tensor<1, dim> result = r;
      result[0]             = std::cos(angle) * r[0] - std::sin(angle) * r[1];
      result[1]             = std::sin(angle) * r[0] + std::cos(angle) * r[1];
      return result;
    };
    const Tensor<1, dim>           centre = vector<dim>({{0.5, 0.25, 0.1}});
    const Tensor<1, dim>           n      = turned(vector<dim>({{0.96, 0.28, 0}}), angle_now);
    Tensor<1, dim>                 reaction;
    typename Obstacle<dim>::Moment moment;
    double                         error = 0, work = 0;
    unsigned int                   n_inside = 0, n_free = 0;
    for (unsigned int i = 0; i < setup.grid.fields.n_owned(); ++i)
    {
      const Tensor<1, dim> x      = setup.grid.node_position(i);
      const Tensor<1, dim> arm    = x - centre - vector<dim>(now);
      const Tensor<1, dim> X      = turned(arm, -angle_now); // about the centre
      const double         value  = 0.96 * (X[0] + centre[0]) + 0.28 * (X[1] + centre[1]) - 0.8;
      const bool           inside = value <= 1e-9 && value > -2.5 * 0.25; // no material comes deeper
      const Tensor<1, dim> w      = (x - centre - vector<dim>(before) - turned(X, angle_before)) / dt;
      Tensor<1, dim>       v;
      for (unsigned int d = 0; d < dim; ++d)
        v[d] = trial(setup, i, d);
      const Tensor<1, dim> wanted = inside ? after(v, w, n, mu) : v, impulse = mass(setup, i) * (v - wanted);
      n_inside += inside;
      n_free += inside && (wanted - v).norm() < 1e-14;
      reaction += impulse / dt;
      work -= impulse * wanted;
      if constexpr (dim == 2)
        moment[0] += (arm[0] * impulse[1] - arm[1] * impulse[0]) / dt;
      else
        moment += cross_product_3d(arm, impulse) / dt;
      for (unsigned int d = 0; d < dim; ++d)
      {
        raise(error, setup.grid.fields[i][NodalFields<dim>::velocity + d] - wanted[d]);
        raise(error, setup.grid.fields[i][NodalFields<dim>::increment + d] - 0.25 - (wanted - v)[d]);
      }
    }
    const auto &bed = *setup.boundary.obstacles[0];
    check(name + ": velocity", error, 1e-10);
    check(name + ": reaction", (bed.reaction - reaction).norm(), 1e-8);
    check(name + ": moment", (bed.moment - moment).norm(), 1e-8);
    check(name + ": work", bed.work - work, 1e-9);
    check_true(name + ": nodes lie in it", sum(n_inside) > 5);
    check_true(name + ": some are held", sum(n_free) < sum(n_inside));
    check_true(name + ": some are free", sum(n_free) > 0);
  }
} // namespace

/** Nodes in a body at rest or moved, whose formula is three times a distance. */
template <int dim>
void obstacles()
{
  compare<dim>("smooth", "", 0., 0., 0., {}, {});
  compare<dim>("rough", "", 0.3, 0., 0., {}, {});
  compare<dim>("moved", set("Displacement", dim == 2 ? "0.3 * t; t^2" : "0.3 * t; t^2; 2 * t"), 0.3, 0., 0.,
               {{0.21, 0.49, 1.4}}, {{0.18, 0.36, 1.2}});
  compare<dim>("turned", set("Rotation", "-2 * t") + set("Displacement", dim == 2 ? "0.3 * t; 0" : "0.3 * t; 0; 0"),
               0.3, -1.4, -1.2, {{0.21, 0, 0}}, {{0.18, 0, 0}});
}

/** What a condition holds stays; the other components make room for the body. */
template <int dim>
void obstacle_at_wall()
{
  Setup<dim> setup(
    section("Grid", set("Spacing", "0.25")) +
    conditions("wall", section("wall", set("Type", "velocity") + set("Boundary ids", "0") + set("Components", "x") +
                                         set("Velocity", dim == 2 ? "0.25; 0" : "0.25; 0; 0"))) +
    obstacle(set("Formula", "0.6 * x + 0.8 * y - 0.45")));
  move(setup, 0., 0.1);
  double       error = 0;
  unsigned int n     = 0;
  for (unsigned int i = 0; i < setup.grid.fields.n_owned(); ++i)
    if (const auto x = setup.grid.node_position(i); is(x[0], 0) && x[1] < 0.55)
    {
      const double *v = setup.grid.fields[i] + NodalFields<dim>::velocity;
      raise(error, v[0] - 0.25);
      raise(error, v[1] - std::max(trial(setup, i, 1), -0.6 * 0.25 / 0.8));
      ++n;
    }
  check("velocities at the wall", error, 1e-12);
  check_true("there are some", sum(n) > 0);
}

/** Friction of a bed of which a component is held: by the force along the normal, of which the wall bears a part. */
void obstacle_held_and_rough()
{
  Setup<3> setup(section("Grid", set("Spacing", "0.25")) +
                 conditions("wall", section("wall", set("Type", "slip") + set("Boundary ids", "0"))) +
                 obstacle(set("Formula", "0.6 * x + 0.8 * y - 0.45") + set("Friction coefficient", "0.1")));
  for (unsigned int i = 0; i < setup.grid.fields.n_owned(); ++i)
  {
    double *node               = setup.grid.fields[i];
    node[NodalFields<3>::mass] = 2;
    for (unsigned int d = 0; d < 3; ++d)
      node[NodalFields<3>::velocity + d] = d == 1 ? -1 : d == 2 ? 3 : 0;
  }
  setup.boundary.apply(0., 0.1, setup.grid);
  double error = 0;
  for (unsigned int i = 0; i < setup.grid.fields.n_owned(); ++i)
    if (const auto x = setup.grid.node_position(i); is(x[0], 0) && x[1] < 0.55)
    {
      // Along y it stops: m = N .8, and mu N is what it loses along z, in which alone it can slide.
      const double *v = setup.grid.fields[i] + NodalFields<3>::velocity;
      raise(error, v[1]);
      raise(error, v[2] - (3 - 0.1 / 0.8));
    }
  check("velocities", error, 1e-12);
}

/** Impulse that friction has not used makes a node stick in a step in which it does not press. */
template <int dim>
void obstacle_account()
{
  Setup<dim> setup(
    section("Grid", set("Spacing", "0.25")) +
    obstacle(set("Formula", "y - 0.3") + set("Friction coefficient", "0.5") + set("Account time", "10")));
  const double dt   = 0.1;
  const auto   step = [&](const double along, const double down) {
    double first = 0;
    for (unsigned int i = 0; i < setup.grid.fields.n_owned(); ++i)
    {
      double *node                         = setup.grid.fields[i];
      node[NodalFields<dim>::mass]         = 2;
      node[NodalFields<dim>::velocity]     = along;
      node[NodalFields<dim>::velocity + 1] = -down;
    }
    setup.boundary.apply(0., dt, setup.grid);
    for (unsigned int i = 0; i < setup.grid.fields.n_owned(); ++i)
      if (setup.grid.node_position(i)[1] < 0.3)
        first = setup.grid.fields[i][NodalFields<dim>::velocity];
    return max(first);
  };
  check("sticks with a part of what presses", step(0.2, 1), 1e-15); // account 2 - .8 = 1.2 over mass 2
  check("sticks without pressing", step(0.01, 0), 1e-15);
  check("slides where more is wanted", step(9, 0) - (9 - 0.5 * 10 * 0.0099 * 0.99), 1e-12);
  check("and has nothing left", step(0.5, 0) - 0.5, 1e-15);
}

template void obstacles<2>();
template void obstacles<3>();
template void obstacle_at_wall<2>();
template void obstacle_at_wall<3>();
template void obstacle_account<2>();
template void obstacle_account<3>();

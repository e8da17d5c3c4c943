#include "../setup.h"

using namespace Test;
using namespace dealii;

namespace
{
  std::string conditions(const std::string &names, const std::string &content)
  {
    return section("Conditions", set("Names", names) + content);
  }

  // A unit box of 4 cells per direction whose nodes have masses and velocities of their own.

  template <int dim>
  double mass(const Setup<dim> &setup, const unsigned int i)
  {
    return 1 + setup.grid.node_position(i)[0];
  }

  template <int dim>
  double trial(const Setup<dim> &setup, const unsigned int i, const unsigned int d)
  {
    return 0.5 + d - setup.grid.node_position(i)[(d + 1) % dim];
  }

  template <int dim>
  void move(Setup<dim> &setup, const double time, const double dt)
  {
    for (unsigned int i = 0; i < setup.grid.fields.n_owned(); ++i)
    {
      double *node                 = setup.grid.fields[i];
      node[NodalFields<dim>::mass] = mass(setup, i);
      for (unsigned int d = 0; d < dim; ++d)
      {
        node[NodalFields<dim>::velocity + d]  = trial(setup, i, d);
        node[NodalFields<dim>::increment + d] = 0.25;
      }
    }
    setup.boundary.apply(time, dt, setup.grid);
  }

  /** Velocities, increments, reaction and work where `prescribed(x, d, v)` changes v and tells so. */
  template <int dim, class Prescribed>
  void compare(const std::string &name, const std::string &text, const Prescribed &prescribed)
  {
    const double time = 0.7, dt = 0.1;
    Setup<dim>   setup(section("Grid", set("Spacing", "0.25")) + conditions("one", section("one", text)));
    move(setup, time, dt);
    Tensor<1, dim> reaction;
    double         error = 0, work = 0;
    for (unsigned int i = 0; i < setup.grid.fields.n_owned(); ++i)
      for (unsigned int d = 0; d < dim; ++d)
      {
        double v = trial(setup, i, d);
        if (prescribed(setup.grid.node_position(i), d, v))
        {
          const double impulse = mass(setup, i) * (trial(setup, i, d) - v);
          reaction[d] += impulse / dt;
          work -= impulse * v;
        }
        raise(error, setup.grid.fields[i][NodalFields<dim>::velocity + d] - v);
        raise(error, setup.grid.fields[i][NodalFields<dim>::increment + d] - 0.25 - (v - trial(setup, i, d)));
      }
    const auto &condition = *setup.boundary.conditions[0];
    check(name + ": velocity", error, 1e-14);
    check(name + ": reaction", (condition.reaction - reaction).norm(), 1e-11);
    check(name + ": work", condition.work - work, 1e-12);
  }

  bool is(const double a, const double b) { return std::abs(a - b) < 1e-10; }
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

template <int dim>
void boundary_errors()
{
  const auto error = [](const std::string &name, const std::string &text, const std::string &entry,
                        const std::string &message) {
    check_error<EntryError>(name, {"/Conditions/one: " + entry, message}, [&] {
      Setup<dim> s(section("Grid", set("Spacing", "0.25")) + conditions("one", section("one", text)));
    });
  };
  error("nowhere", set("Type", "no-slip"), "Boundary ids", "acts nowhere");
  error("slip in a box",
        set("Type", "slip") + set("Lower corner", coordinates<dim>({{0, 0, 0}})) +
          set("Upper corner", coordinates<dim>({{1, 1, 1}})),
        "Boundary ids", "slip needs the faces");
  error("one corner", set("Type", "no-slip") + set("Lower corner", coordinates<dim>({{0, 0, 0}})), "Lower corner",
        "both corners");
  error("box between the nodes",
        set("Type", "no-slip") + set("Lower corner", coordinates<dim>({{0.1, 0.1, 0.1}})) +
          set("Upper corner", coordinates<dim>({{0.2, 0.2, 0.2}})),
        "Lower corner", "no node of the grid");
  error("bad expression", set("Type", "velocity") + set("Boundary ids", "0") + set("Velocity", "1"), "Velocity",
        "expressions");
}

int main(int argc, char **argv)
{
  return run(argc, argv,
             {{"kinds 2D", kinds<2>},
              {"kinds 3D", kinds<3>},
              {"order 2D", order<2>},
              {"order 3D", order<3>},
              {"errors 2D", boundary_errors<2>},
              {"errors 3D", boundary_errors<3>}});
}

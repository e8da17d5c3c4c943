#pragma once

#include "../setup.h"

namespace Test
{
  inline std::string conditions(const std::string &names, const std::string &content)
  {
    return section("Conditions", set("Names", names) + content);
  }

  inline bool is(const double a, const double b) { return std::abs(a - b) < 1e-10; }

  /** Mass, and velocity before the conditions, of the nodes of a unit box of 4 cells per direction. */
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

  /** Gives them to the nodes, with an increment of 0.25, and lets the conditions act. */
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
} // namespace Test

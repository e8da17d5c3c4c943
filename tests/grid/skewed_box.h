#pragma once

#include "../setup.h"

/** A box whose spacing differs along the axes, with its lower corner off the origin. */
namespace Test
{
  inline constexpr std::array<int, 3>    cells = {{6, 5, 4}};
  inline constexpr std::array<double, 3> lower = {{-0.3, 0.7, 0.2}}, h = {{0.1, 0.08, 0.125}};

  template <int dim>
  Setup<dim> setup()
  {
    return Setup<dim>(skewed_grid<dim>(cells));
  }

  template <int dim>
  unsigned int total_nodes()
  {
    unsigned int n = 1;
    for (unsigned int d = 0; d < dim; ++d)
      n *= cells[d] + 1;
    return n;
  }
} // namespace Test

#pragma once

#include "transfer.h"

/** What the tests of averages share. */
namespace Test
{
  inline const std::vector<std::string> all_kernels = {"linear", "quadratic B-spline", "cubic B-spline", "uGIMP",
                                                       "CPDI"};

  /** A box full of particles but for one layer of cells at its upper x face, which CPDI's domains need at all faces. */
  template <int dim>
  std::string some_box(const std::string &kernel, const std::string &more = "")
  {
    const std::array<int, 3>    cells = {{dim == 2 ? 6 : 4, dim == 2 ? 5 : 4, 4}};
    const double                gap   = kernel == "CPDI" ? 0.3 : 0;
    std::array<double, 3>       lower = {{-0.3, 0.7, 0.2}}, upper;
    const std::array<double, 3> h     = {{0.1, 0.08, 0.125}};
    for (unsigned int d = 0; d < 3; ++d)
    {
      upper[d] = lower[d] + (cells[d] - gap) * h[d];
      lower[d] += gap * h[d];
    }
    return skewed_grid<dim>(cells) + section("Kernel", set("Type", kernel)) + more +
           box_body<dim>(lower, upper, kernel == "CPDI" ? 0.2 : 0.5);
  }

  template <int dim>
  double mass_of(const Setup<dim> &setup, const unsigned int p)
  {
    return setup.particles.component(setup.particles.mass, 0)[p];
  }
} // namespace Test

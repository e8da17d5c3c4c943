#include "points.h"
#include "reference.h"

#include <map>

using namespace Test;

namespace
{
  template <int dim>
  using Nodes = std::map<unsigned int, std::array<double, dim + 1>>; // weight, gradient

  template <int dim>
  Nodes<dim> by_node(const Stencil<dim> &stencil)
  {
    Nodes<dim> nodes;
    for (unsigned int k = 0; k < stencil.size; ++k)
    {
      auto &values = nodes[stencil.place[k]];
      values[0]    = stencil.weight[k];
      for (unsigned int d = 0; d < dim; ++d)
        values[d + 1] = stencil.gradient[d][k];
    }
    return nodes;
  }

  /** Greatest h |grad phi - (phi(x + e) - phi(x - e)) / 2e| over generic points, near the boundary or away from it. */
  template <int dim>
  double gradient_error(const std::string &kernel, const std::string &treatment, const bool is_near)
  {
    KernelSetup<dim> setup(kernel, treatment);
    const double     support = Reference::Function(kernel).support;
    double           error   = 0;
    setup.for_generic_points(10, [&](const auto &x) {
      if (setup.is_near_boundary(x, support) != is_near)
        return;
      const auto nodes = by_node(setup.at(x));
      for (unsigned int d = 0; d < dim; ++d)
      {
        const double           step = 1e-5 * setup.grid.lattice.h[d];
        dealii::Tensor<1, dim> shift;
        shift[d]   = step;
        auto above = by_node(setup.at(x + shift)), below = by_node(setup.at(x - shift));
        for (const auto &[node, values] : nodes)
          raise(error, setup.grid.lattice.h[d] * (values[d + 1] - (above[node][0] - below[node][0]) / (2 * step)));
      }
    });
    return error;
  }

  /** Greatest jump of phi, and of h grad phi, over all knots of an axis (multiples of h/4). */
  template <int dim>
  std::pair<double, double> jump(const std::string &kernel, const std::string &treatment, const bool only_interior)
  {
    KernelSetup<dim>          setup(kernel, treatment);
    const double              support = Reference::Function(kernel).support, step = 1e-9;
    std::pair<double, double> greatest(0, 0);
    setup.for_generic_points(5, [&](dealii::Point<dim> x) {
      if (only_interior && setup.is_near_boundary(x, support + 0.5))
        return;
      for (unsigned int d = 0; d < dim; ++d)
      {
        const double h    = setup.grid.lattice.h[d];
        const double c    = setup.grid.lattice.coordinate(x[d], d);
        const double knot = setup.grid.lattice.origin[d] + h * std::round(4 * c) / 4;
        const auto   cell = std::floor(c);
        // Stay in the cell of x, of which this rank knows all nodes; faces are tested below.
        if (std::round(4 * c) / 4 == cell || std::round(4 * c) / 4 == cell + 1)
          continue;
        dealii::Point<dim> a = x, b = x;
        a[d]        = knot - step * h;
        b[d]        = knot + step * h;
        auto before = by_node(setup.at(a)), after = by_node(setup.at(b));
        for (const auto &node : after)
          before[node.first];
        for (const auto &[node, values] : before)
        {
          raise(greatest.first, values[0] - after[node][0]);
          for (unsigned int e = 0; e < dim; ++e)
            raise(greatest.second, setup.grid.lattice.h[e] * (values[e + 1] - after[node][e + 1]));
        }
      }
    });
    return greatest;
  }

  /** The same for weights alone over the faces between two cells of this rank. */
  template <int dim>
  double jump_over_faces(const std::string &kernel, const std::string &treatment)
  {
    KernelSetup<dim> setup(kernel, treatment);
    double           greatest = 0;
    setup.for_cells([&](const auto &cell) {
      for (unsigned int d = 0; d < dim; ++d)
        if (!cell->at_boundary(2 * d + 1) && cell->neighbor(2 * d + 1)->is_locally_owned())
        {
          std::array<double, dim> low, high;
          for (unsigned int e = 0; e < dim; ++e)
            low[e] = high[e] = 0.1 + 0.31 * e;
          low[d]      = 1 - 1e-9;
          high[d]     = 1e-9;
          auto before = by_node(setup.at(setup.in_cell(cell, low)));
          auto after  = by_node(setup.at(setup.in_cell(cell->neighbor(2 * d + 1), high)));
          for (const auto &node : after)
            before[node.first];
          for (const auto &[node, values] : before)
            raise(greatest, values[0] - after[node][0]);
        }
    });
    return greatest;
  }
} // namespace

/**
 * Central differences of step e = 1e-5 h err by e^2/6 phi''' + 1e-16/e: 1e-10 for the kernels, whose third derivative
 * is at most 3/h^3. Those of MLS near a wall are larger by powers of phi'/M, hence the wider bound. The gradient of
 * WLS is by design not the derivative of its weight.
 */
template <int dim>
void gradient_of_weight()
{
  for (const auto &kernel : Reference::kernels)
  {
    check(kernel + ", interior", gradient_error<dim>(kernel, "none", false), 1e-9);
    check(kernel + ", none, boundary", gradient_error<dim>(kernel, "none", true), 1e-9);
    check(kernel + ", MLS, boundary", gradient_error<dim>(kernel, "MLS", true), 1e-7);
    if (kernel != "uGIMP")
      check(kernel + ", Steffen, boundary", gradient_error<dim>(kernel, "Steffen", true), 1e-9);
  }
}

/**
 * Over a step of 2e-9 h a weight changes by 2e-9 h |d phi/dx| <= 1e-8 when it is continuous: |d phi/dx| <= 5/h even
 * with a correction. Knots at h/4 and h/2 from a wall are the inner boundary of the corrected zone.
 */
template <int dim>
void continuity()
{
  for (const auto &kernel : Reference::kernels)
  {
    for (const std::string treatment : {"none", "WLS", "WLS separable", "WLS everywhere", "MLS", "Steffen"})
      if (treatment != "Steffen" || kernel != "uGIMP")
      {
        check(kernel + ", " + treatment + ": weight inside cells", jump<dim>(kernel, treatment, false).first, 1e-8);
        check(kernel + ", " + treatment + ": weight over faces", jump_over_faces<dim>(kernel, treatment), 1e-8);
      }
    // The second derivative of uGIMP is at most 1/(lp h) = 4/h^2.
    check(kernel + ": gradient inside cells, interior", jump<dim>(kernel, "none", true).second, 1e-8);
  }
}

template void gradient_of_weight<2>();
template void gradient_of_weight<3>();
template void continuity<2>();
template void continuity<3>();

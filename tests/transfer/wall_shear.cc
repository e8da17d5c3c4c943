#include "slip.h"

#include <deal.II/lac/full_matrix.h>

using namespace Test;
using namespace dealii;

namespace
{
  /**
   * The same growth in one dimension, from dense matrices alone: particles at h/4, 3h/4, ... with quadratic B-splines,
   * of which the last half cell at either wall has two nodes, so that reproduction of linear functions leaves one
   * choice. In units of h; the gradient of the first row after n_steps transfers with the projection at the lower wall.
   */
  double projected_growth(const bool is_apic, const unsigned int n_cells, const unsigned int n_steps)
  {
    const unsigned int  n_rows = 2 * n_cells, n_nodes = n_cells + 1;
    FullMatrix<double>  weight(n_rows, n_nodes), gradient(n_rows, n_nodes), offset(n_rows, n_nodes);
    std::vector<double> v(n_rows), slope(n_rows), D(n_rows, 0.), mass(n_nodes, 0.), v_node(n_nodes);
    for (unsigned int p = 0; p < n_rows; ++p)
    {
      const double       y = 0.5 * p + 0.25;
      const unsigned int c = static_cast<unsigned int>(y + 0.5);
      const double       d = y - c;
      if (c == 0 || c == n_cells)
      {
        const unsigned int first = c == 0 ? 0 : c - 1;
        weight(p, first) = 1 - (y - first), weight(p, first + 1) = y - first;
        gradient(p, first) = -1, gradient(p, first + 1) = 1;
      }
      else
      {
        weight(p, c - 1) = (0.5 - d) * (0.5 - d) / 2, weight(p, c) = 0.75 - d * d;
        weight(p, c + 1)   = (0.5 + d) * (0.5 + d) / 2;
        gradient(p, c - 1) = d - 0.5, gradient(p, c) = -2 * d, gradient(p, c + 1) = d + 0.5;
      }
      v[p] = y * y, slope[p] = 2 * y;
      for (unsigned int i = 0; i < n_nodes; ++i)
      {
        offset(p, i) = i - y;
        D[p] += weight(p, i) * offset(p, i) * offset(p, i);
        mass[i] += weight(p, i);
      }
    }
    for (unsigned int n = 0; n < n_steps; ++n)
    {
      std::fill(v_node.begin(), v_node.end(), 0.);
      for (unsigned int p = 0; p < n_rows; ++p)
        for (unsigned int i = 0; i < n_nodes; ++i)
          v_node[i] += weight(p, i) * (v[p] + (p == 0 ? 0. : slope[p] * offset(p, i))) / mass[i];
      for (unsigned int p = 0; p < n_rows; ++p)
      {
        v[p] = slope[p] = 0;
        for (unsigned int i = 0; i < n_nodes; ++i)
        {
          v[p] += weight(p, i) * v_node[i];
          slope[p] += (is_apic ? weight(p, i) * offset(p, i) / D[p] : gradient(p, i)) * v_node[i];
        }
      }
    }
    return v_node[1] - v_node[0];
  }
} // namespace

/**
 * Frozen particles below a slip wall carry v_x = y^2. Next to the wall d v_x / d y is h / 2 on the first row, and stays
 * so when it is transferred with a cure; without one the difference of the last two nodes feeds itself.
 */
template <int dim>
void wall_shear()
{
  const double h = 0.1;
  // The other faces are far away, or uniform in x and z.
  const auto grow = [&](const std::string &treatment, const std::string &transfer, const std::string &more,
                        const unsigned int n_steps) {
    Setup<dim> setup(section("Grid", set("Spacing", "0.1") + set("Upper corner", dim == 2 ? "0.3, 4" : "0.2, 4, 0.2")) +
                     kernel_text("quadratic B-spline", treatment) + transfer_text(transfer, more) +
                     walls({{"slip", faces("2")}}) +
                     body_text(set("Upper corner", dim == 2 ? "0.3, 4" : "0.2, 4, 0.2")));
    setup.fill(setup.particles.velocity, [&](const unsigned int p, const unsigned int c) {
      return c == 0 ? std::pow(setup.position(p)[1], 2) : 0.;
    });
    setup.fill(setup.particles.grad_v,
               [&](const unsigned int p, const unsigned int c) { return c == 1 ? 2 * setup.position(p)[1] : 0.; });
    setup.boundary.mark_slip_walls(0., setup.particles.n_stencil_nodes, setup.grid);
    setup.transfer->initialize(*setup.kernel, setup.particles);
    for (unsigned int n = 0; n < n_steps; ++n)
      setup.step(0.);
    double sum_of_row = 0, count = 0;
    for (unsigned int p = 0; p < setup.particles.size(); ++p)
      if (setup.position(p)[1] < h / 2)
      {
        sum_of_row += setup.particles.component(setup.particles.grad_v, 1)[p];
        ++count;
      }
    return sum(sum_of_row) / sum(count) / h;
  };
  const auto steps = dim == 2 ? std::vector<unsigned int>{10, 100, 1000} : std::vector<unsigned int>{10, 100};
  for (const std::string transfer : {"TPIC", "APIC"})
  {
    if (dim == 2 && transfer == "TPIC")
    {
      check_range("WLS, 1 step", grow("WLS", transfer, "", 1), 0.9, 1.1);
      check_range("WLS, 10 steps", grow("WLS", transfer, "", 10), 1.9, 2.1);
      check_range("WLS, 100 steps", grow("WLS", transfer, "", 100), 3.7, 4.1);
      check_range("WLS, 1000 steps", grow("WLS", transfer, "", 1000), 6.5, 7.5);
    }
    for (const std::string treatment : {"WLS", "WLS separable"})
    {
      const std::string name   = transfer + ", " + treatment + ", projection, steps: ";
      double            before = grow(treatment, transfer, project, 1);
      // By hand: v_0 = -.15074 h^2, v_1 = .72782 h^2.
      check(name + "1", before - 0.87856, 1e-4);
      for (const unsigned int n : steps)
      {
        const double now = grow(treatment, transfer, project, n);
        check_range(name + std::to_string(n), now, 0.5, before);
        if (treatment == "WLS separable") // whose corners are products, so that nothing depends on x
          check(name + std::to_string(n) + ", 1D", now - projected_growth(transfer == "APIC", 40, n), 1e-9);
        before = now;
      }
    }
    for (const unsigned int n : steps)
      check_range(transfer + ", mirror, steps: " + std::to_string(n), grow("mirror", transfer, "", n), 0.4999, 0.5001);
  }
}

template void wall_shear<2>();
template void wall_shear<3>();

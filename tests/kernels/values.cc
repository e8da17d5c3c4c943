#include "points.h"
#include "reference.h"

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/householder.h>
#include <deal.II/lac/vector.h>

#include <map>

using namespace Test;

namespace
{
  template <int dim>
  struct Node
  {
    double                 weight;
    dealii::Tensor<1, dim> gradient;
  };
  template <int dim>
  using Nodes = std::map<std::array<int, dim>, Node<dim>>;

  /** All nodes of the domain where the kernel is not zero, by its definition. */
  template <int dim>
  Nodes<dim> kernel_nodes(const Lattice<dim> &lattice, const dealii::Point<dim> &x, const Reference::Function &function)
  {
    Nodes<dim>   nodes;
    unsigned int n = 1;
    for (unsigned int d = 0; d < dim; ++d)
      n *= lattice.n_cells[d] + 1;
    for (unsigned int i = 0; i < n; ++i)
    {
      std::array<int, dim> index;
      Node<dim>            node{1., {}};
      for (unsigned int d = 0, rest = i; d < dim; ++d)
      {
        index[d] = rest % (lattice.n_cells[d] + 1);
        rest /= lattice.n_cells[d] + 1;
        node.gradient[d] = 1 / lattice.h[d];
      }
      for (unsigned int d = 0; d < dim; ++d)
      {
        const double r = lattice.coordinate(x[d], d) - index[d];
        node.weight *= function.weight(r);
        for (unsigned int e = 0; e < dim; ++e)
          node.gradient[e] *= e == d ? function.derivative(r) : function.weight(r);
      }
      if (node.weight > 0 || node.gradient.norm() > 0)
        nodes[index] = node;
    }
    return nodes;
  }

  /** Fits a linear function by weighted least squares: row j is its value and slope when f_i = delta_ij. */
  template <int dim>
  void fit(const Lattice<dim> &lattice, const dealii::Point<dim> &x, Nodes<dim> &nodes)
  {
    dealii::FullMatrix<double> A(nodes.size(), dim + 1);
    unsigned int               row = 0;
    for (const auto &[index, node] : nodes)
    {
      A(row, 0) = std::sqrt(node.weight);
      for (unsigned int d = 0; d < dim; ++d)
        A(row, d + 1) = A(row, 0) * (lattice.node_position(index[d], d) - x[d]) / lattice.h[d];
      ++row;
    }
    const dealii::Householder<double> QR(A);
    row = 0;
    for (auto &[index, node] : nodes)
    {
      dealii::Vector<double> f(nodes.size()), a(dim + 1);
      f(row++) = std::sqrt(node.weight);
      QR.least_squares(a, f);
      node.weight = a(0);
      for (unsigned int d = 0; d < dim; ++d)
        node.gradient[d] = a(d + 1) / lattice.h[d];
    }
  }

  /** Least squares on one axis: nodes 0 .. n_cells at distance r = c - i. */
  void fit_axis(const Reference::Function &function, const double c, const int n_cells, std::vector<double> &weight,
                std::vector<double> &slope)
  {
    Lattice<1> lattice;
    lattice.origin = {{0.}};
    lattice.h = lattice.inverse_h = {{1.}};
    lattice.n_cells               = {{n_cells}};
    auto nodes                    = kernel_nodes<1>(lattice, dealii::Point<1>(c), function);
    if (c + 1 < function.support || n_cells + 1 - c < function.support)
      fit<1>(lattice, dealii::Point<1>(c), nodes);
    weight.assign(n_cells + 1, 0.);
    slope.assign(n_cells + 1, 0.);
    for (const auto &[index, node] : nodes)
    {
      weight[index[0]] = node.weight;
      slope[index[0]]  = node.gradient[0];
    }
  }

  template <int dim>
  void fit_separately(const Lattice<dim> &lattice, const dealii::Point<dim> &x, const Reference::Function &function,
                      Nodes<dim> &nodes)
  {
    std::array<std::vector<double>, dim> weight, slope;
    for (unsigned int d = 0; d < dim; ++d)
      fit_axis(function, lattice.coordinate(x[d], d), lattice.n_cells[d], weight[d], slope[d]);
    for (auto &[index, node] : nodes)
    {
      node.weight = 1;
      for (unsigned int e = 0; e < dim; ++e)
      {
        node.weight *= weight[e][index[e]];
        node.gradient[e] = 1 / lattice.h[e];
        for (unsigned int d = 0; d < dim; ++d)
          node.gradient[e] *= (d == e ? slope : weight)[d][index[d]];
      }
    }
  }

  template <int dim>
  Nodes<dim> reference(const Lattice<dim> &lattice, const dealii::Point<dim> &x, const Reference::Function &function,
                       const std::string &treatment)
  {
    auto nodes        = kernel_nodes<dim>(lattice, x, function);
    bool is_truncated = false;
    for (unsigned int d = 0; d < dim; ++d)
    {
      const double c = lattice.coordinate(x[d], d);
      is_truncated   = is_truncated || c + 1 < function.support || lattice.n_cells[d] + 1 - c < function.support;
    }
    if (treatment == "WLS everywhere" || (treatment == "WLS" && is_truncated))
      fit<dim>(lattice, x, nodes);
    else if (treatment == "WLS separable")
      fit_separately<dim>(lattice, x, function, nodes);
    return nodes;
  }

  template <int dim>
  void compare(const std::string &kernel, const std::string &treatment)
  {
    KernelSetup<dim>          setup(kernel, treatment);
    const auto               &lattice = setup.grid.lattice;
    const Reference::Function function(kernel);
    double                    weight_error = 0, gradient_error = 0;
    const auto                visit = [&](const dealii::Point<dim> &x) {
      auto       nodes   = reference<dim>(lattice, x, function, treatment);
      const auto stencil = setup.at(x);
      for (unsigned int k = 0; k < stencil.size; ++k)
      {
        auto &node = nodes[setup.grid.node_index[setup.node(stencil, k)]];
        raise(weight_error, stencil.weight[k] - node.weight);
        for (unsigned int d = 0; d < dim; ++d)
          raise(gradient_error, lattice.h[d] * (stencil.gradient[d][k] - node.gradient[d]));
        node = {0., {}};
      }
      for (const auto &node : nodes) // what the stencil lacks
        raise(weight_error, node.second.weight);
    };
    setup.for_generic_points(5, visit);
    setup.for_cells([&](const auto &cell) {
      // Corners, edges and faces themselves; hats everywhere are 0/0 there.
      if (cell->at_boundary() && (kernel != "linear" || treatment != "WLS everywhere"))
        for (const unsigned int v : cell->vertex_indices())
        {
          std::array<double, dim> local;
          for (unsigned int d = 0; d < dim; ++d)
            local[d] = cell->at_boundary(2 * d + (v >> d) % 2) ? (v >> d) % 2 : 0.3;
          if (const auto x = setup.in_cell(cell, local); setup.is_local(x))
            visit(x);
        }
    });
    check(kernel + ", " + treatment + ": weights", weight_error, 1e-12);
    check(kernel + ", " + treatment + ": gradients", gradient_error, 1e-12);
  }
} // namespace

/** Against the definitions: recursion of B-splines, averaged hats, and QR least squares of all nodes. */
template <int dim>
void definition()
{
  for (const auto &kernel : Reference::kernels)
    for (const std::string treatment : {"none", "WLS", "WLS separable", "WLS everywhere"})
      compare<dim>(kernel, treatment);
}

/** Numbers worked out by hand, of a particle at (3 - r) h next to node 3 with r = 0 along the other axes. */
template <int dim>
void closed_form()
{
  struct Value
  {
    std::string kernel;
    double      r, weight, derivative;
    double      at_centre;
  };
  const std::vector<Value> values = {
    {"linear", 0.25, 3. / 4, -1., 1.},
    {"quadratic B-spline", 0., 3. / 4, 0., 3. / 4},
    {"quadratic B-spline", 0.25, 11. / 16, -1. / 2, 3. / 4},
    {"quadratic B-spline", 0.75, 9. / 32, -3. / 4, 3. / 4},
    {"quadratic B-spline", 1.25, 1. / 32, -1. / 4, 3. / 4},
    {"cubic B-spline", 0., 2. / 3, 0., 2. / 3},
    {"cubic B-spline", 0.5, 23. / 48, -5. / 8, 2. / 3},
    {"cubic B-spline", 1., 1. / 6, -1. / 2, 2. / 3},
    {"cubic B-spline", 1.5, 1. / 48, -1. / 8, 2. / 3},
    // The three pieces of uGIMP with lp = h/4: near the top, on the flank, at the foot.
    {"uGIMP", 0., 7. / 8, 0., 7. / 8},
    {"uGIMP", 0.125, 27. / 32, -1. / 2, 7. / 8},
    {"uGIMP", 0.5, 1. / 2, -1., 7. / 8},
    {"uGIMP", 1., 1. / 16, -1. / 2, 7. / 8},
    {"uGIMP", 1.125, 1. / 64, -1. / 4, 7. / 8},
  };
  for (const auto &value : values)
  {
    KernelSetup<dim> setup(value.kernel, "WLS");
    // Interior points, well away from all faces: the middle node is (3, 2, 2).
    dealii::Point<dim> x, node;
    for (unsigned int d = 0; d < dim; ++d)
      x[d] = node[d] = setup.grid.lattice.node_position(d == 0 ? 3 : 2, d);
    x[0] += value.r * setup.grid.lattice.h[0];
    double weight_error = 0, gradient_error = 0;
    bool   is_found = false;
    double others   = 1;
    for (unsigned int d = 1; d < dim; ++d)
      others *= value.at_centre;
    if (setup.is_local(x))
    {
      const auto stencil = setup.at(x);
      for (unsigned int k = 0; k < stencil.size; ++k)
        if (setup.grid.node_position(setup.node(stencil, k)).distance(node) < 1e-10)
        {
          is_found       = true;
          weight_error   = stencil.weight[k] - value.weight * others;
          gradient_error = setup.grid.lattice.h[0] * stencil.gradient[0][k] - value.derivative * others;
        }
    }
    const std::string name = value.kernel + " at r = " + std::to_string(value.r);
    check_true(name + ": node is in the stencil", max(is_found) == 1);
    check(name + ": weight", weight_error, 1e-14);
    check(name + ": derivative", gradient_error, 1e-13);
  }
}

/**
 * The smallest weight in a 2D corner. With weights (a, b) of the two nodes of an axis at the corner itself, the coupled
 * correction gives the node across -b^2/(a + b)^2: -1/49, -1/25, -1/225; the separable one gives it 0.
 */
void negative_weights()
{
  const auto smallest = [](const std::string &kernel, const std::string &treatment) {
    KernelSetup<2> setup(kernel, treatment);
    double         least = 0;
    setup.for_cells([&](const auto &cell) {
      if (cell->at_boundary())
        for (unsigned int i = 0; i <= 100; ++i)
          for (unsigned int j = 0; j <= 100; ++j)
          {
            const auto x = setup.in_cell(cell, {{0.01 * i, 0.01 * j}});
            if (!setup.is_local(x))
              continue;
            const auto stencil = setup.at(x);
            for (unsigned int k = 0; k < stencil.size; ++k)
              least = std::min(least, stencil.weight[k]);
          }
    });
    return -max(-least);
  };
  check("quadratic, WLS", smallest("quadratic B-spline", "WLS") + 1. / 49, 1e-13);
  check("cubic, WLS", smallest("cubic B-spline", "WLS") + 1. / 25, 1e-13);
  check("uGIMP, WLS", smallest("uGIMP", "WLS") + 1. / 225, 1e-13);
  check("quadratic, WLS separable", smallest("quadratic B-spline", "WLS separable"), 1e-15);
  check_range("cubic, WLS separable (1e-5)", 1e5 * smallest("cubic B-spline", "WLS separable"), -9.5, -8.5);
  check("uGIMP, WLS separable", smallest("uGIMP", "WLS separable"), 1e-15);
}

template void definition<2>();
template void definition<3>();
template void closed_form<2>();
template void closed_form<3>();

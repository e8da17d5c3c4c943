#include <talus/transfer/lattice/imls_domains.h>

#include "../setup.h"

#include <cmath>
#include <random>

using namespace Test;
using namespace dealii;

namespace
{
  double spline(const double z)
  {
    const double r = std::abs(z);
    return r < 1 ? 2. / 3. - r * r + r * r * r / 2 : (r < 2 ? std::pow(2 - r, 3) / 6 : 0.);
  }

  /** The value at a node by Gram-Schmidt on the values of the functions at the data, as one would on paper. */
  template <unsigned int order>
  double fit(const std::vector<double> &z, const std::vector<double> &v)
  {
    constexpr unsigned int           n = order + 1;
    std::vector<std::vector<double>> q(n, std::vector<double>(z.size() + 1)); // at the data, and at the node
    std::vector<double>              D(n);
    const auto                       product = [&](const auto &a, const auto &b) {
      double sum = 0;
      for (unsigned int k = 0; k < z.size(); ++k)
        sum += spline(z[k]) * a[k] * b[k];
      return sum;
    };
    double result = 0;
    for (unsigned int j = 0; j < n; ++j)
    {
      for (unsigned int k = 0; k < z.size(); ++k)
        q[j][k] = std::pow(z[k], j);
      q[j].back()         = j == 0 ? 1 : 0;
      const double before = product(q[j], q[j]);
      for (unsigned int k = 0; k < j; ++k)
        if (D[k] > 0)
        {
          const double L = product(q[j], q[k]) / D[k];
          for (unsigned int i = 0; i < q[j].size(); ++i)
            q[j][i] -= L * q[k][i];
        }
      D[j] = product(q[j], q[j]);
      if (D[j] <= 1e-8 * before)
        D[j] = 0;
      else
        result += q[j].back() * product(q[j], v) / D[j];
    }
    return result;
  }

  /** The same by moments. */
  template <unsigned int order>
  double moments(const std::vector<double> &z, const std::vector<double> &v)
  {
    using Basis                = ImlsBasis<1, order>;
    double M[Basis::n_moments] = {}, R[Basis::n] = {};
    for (unsigned int k = 0; k < z.size(); ++k)
    {
      for (unsigned int m = 0; m < Basis::n_moments; ++m)
        M[m] += spline(z[k]) * std::pow(z[k], Basis::monomials[m][0]);
      for (unsigned int j = 0; j < Basis::n; ++j)
        R[j] += spline(z[k]) * std::pow(z[k], j) * v[k];
    }
    const auto c      = Basis::value_weights(M);
    double     result = 0;
    for (unsigned int j = 0; j < Basis::n; ++j)
      result += c[j] * R[j];
    return result;
  }

  /** RMS error at the nodes for sin x on [1, 4] in n cells of two points. */
  template <unsigned int order>
  double error_of_sine(const unsigned int n)
  {
    const double h   = 3. / n;
    double       sum = 0;
    for (unsigned int i = 0; i <= n; ++i)
    {
      std::vector<double> z, v;
      for (unsigned int q = 0; q < 2 * n; ++q)
      {
        const double x = 1 + (q + 0.5) * h / 2;
        z.push_back((x - (1 + i * h)) / h);
        v.push_back(std::sin(x));
      }
      sum += std::pow(moments<order>(z, v) - std::sin(1 + i * h), 2) / (n + 1);
    }
    return std::sqrt(sum);
  }
} // namespace

/** One node: Gram-Schmidt as on paper, data that determine less than the basis, and orders for sin x. */
void imls_at_a_node()
{
  std::mt19937                           random(5);
  std::uniform_real_distribution<double> uniform(-1.9, 1.9);
  double                                 linear = 0, quadratic = 0;
  for (unsigned int repetition = 0; repetition < 200; ++repetition)
  {
    std::vector<double> z, v;
    for (unsigned int k = 0; k < 1 + repetition % 8; ++k)
    {
      z.push_back(uniform(random));
      v.push_back(uniform(random));
    }
    raise(linear, (moments<1>(z, v) - fit<1>(z, v)) / (1 + std::abs(fit<1>(z, v))));
    raise(quadratic, (moments<2>(z, v) - fit<2>(z, v)) / (1 + std::abs(fit<2>(z, v))));
  }
  // Where functions are about to be left out, round-off of 1e-16 is seen 1e8 times.
  check("linear basis by moments", linear, 1e-7);
  check("quadratic basis by moments", quadratic, 1e-7);

  const std::vector<double> z = {-0.7, 0.4}, v = {2., 5.};
  check("two points, linear: on their line", moments<1>(z, v) - (2. + 3. * 0.7 / 1.1), 1e-12);
  check("two points, quadratic: the same", moments<2>(z, v) - moments<1>(z, v), 1e-12);
  check("one point: its value", moments<2>({0.3}, {4.}) - 4., 1e-14);
  check("no point: zero", moments<1>({}, {}), 1e-300);

  check_range("order of the linear basis", std::log2(error_of_sine<1>(20) / error_of_sine<1>(160)) / 3, 1.9, 2.1);
  check_range("order of the quadratic basis", std::log2(error_of_sine<2>(20) / error_of_sine<2>(160)) / 3, 3.3, 3.7);
}

/** On a lattice, with data anywhere: polynomials of the basis are exact at all nodes that have enough data, at faces
 * too. */
template <int dim>
void imls_on_a_lattice()
{
  Setup<dim>   setup(skewed_grid<dim>({{5, 4, 3}}) + section("Kernel", set("Type", "cubic B-spline")));
  const auto  &lattice = setup.grid.lattice;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(0, 1);
  Imls<dim, 1>                           linear;
  Imls<dim, 2>                           quadratic;
  linear.clear(setup.grid);
  quadratic.clear(setup.grid);
  const auto field = [&](const double *x, const bool is_quadratic) {
    Tensor<1, dim> v;
    for (unsigned int d = 0; d < dim; ++d)
    {
      v[d] = 1. + d;
      for (unsigned int e = 0; e < dim; ++e)
        v[d] += (0.3 + d - 0.7 * e) * x[e] + (is_quadratic ? 0.2 * (1. + d) * x[e] * x[(e + d) % dim] : 0.);
    }
    return v;
  };
  // All ranks draw the same data, and each adds those in its cells.
  for (unsigned int q = 0; q < 2000; ++q)
  {
    double x[dim];
    for (unsigned int d = 0; d < dim; ++d)
      x[d] = uniform(random) * lattice.n_cells[d];
    typename Lattice<dim>::Index index;
    for (unsigned int d = 0; d < dim; ++d)
      index[d] = static_cast<int>(x[d]);
    const bool is_mine = lattice.is_in_table(index) && setup.grid.owns_cell(lattice.table_index(index));
    if (!is_mine)
      continue;
    linear.add(lattice, x, field(x, false));
    quadratic.add(lattice, x, field(x, true));
  }
  linear.collect();
  quadratic.collect();
  double of_linear = 0, of_quadratic = 0;
  for (unsigned int i = 0; i < setup.grid.fields.n_owned(); ++i)
  {
    double x[dim];
    for (unsigned int d = 0; d < dim; ++d)
      x[d] = setup.grid.node_index[i][d];
    raise(of_linear, (linear.value(i) - field(x, false)).norm());
    raise(of_quadratic, (quadratic.value(i) - field(x, true)).norm());
  }
  check("linear field", of_linear, 1e-12);
  check("quadratic field", of_quadratic, 1e-10);
}

/** Domains in lanes, at faces and in corners too: the sums of their points one by one. */
template <int dim>
void imls_domains()
{
  Setup<dim>   setup(skewed_grid<dim>({{5, 4, 3}}) + section("Kernel", set("Type", "cubic B-spline")));
  const auto  &lattice = setup.grid.lattice;
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(0, 1);
  constexpr unsigned int                 n_points = 1 + (1u << dim);
  ImlsDomains<dim, n_points>             domains;
  Imls<dim, 1>                           together, apart;
  together.clear(setup.grid);
  apart.clear(setup.grid);
  bool is_short = true;
  for (unsigned int repetition = 0; repetition < 50; ++repetition)
  {
    for (unsigned int d = 0; d < dim; ++d)
      for (unsigned int l = 0; l < native_width; ++l)
      {
        // In half of the repetitions they lie together.
        const double centre = (l > 0 && repetition % 4 < 2 ? domains.point[0][d][0] + 0.2 * uniform(random) :
                                                             uniform(random) * lattice.n_cells[d]);
        for (unsigned int q = 0; q < n_points; ++q)
          domains.point[q][d].set(l, std::min(std::max(centre + uniform(random) - 0.5, 0.), 1. * lattice.n_cells[d]));
        domains.value[d].set(l, uniform(random));
        for (unsigned int e = 0; e < dim; ++e)
          domains.gradient[d][e].set(l, uniform(random));
      }
    // Only what lies in this rank's cells, of which it knows all nodes around.
    const unsigned int size     = 1 + repetition % native_width;
    bool               is_local = true;
    for (unsigned int l = 0; l < native_width; ++l)
      for (unsigned int q = 0; q < n_points; ++q)
      {
        typename Lattice<dim>::Index index;
        for (unsigned int d = 0; d < dim; ++d)
          index[d] = std::min(static_cast<int>(domains.point[q][d][l]), lattice.n_cells[d] - 1);
        is_local = is_local && lattice.is_in_table(index) && setup.grid.owns_cell(lattice.table_index(index));
      }
    if (!is_local)
      continue;
    is_short = is_short && domains.find(lattice, size);
    domains.add(lattice, together.numbers());
    for (unsigned int l = 0; l < size; ++l)
      for (const auto &point : domains.point)
      {
        double         at[dim];
        Tensor<1, dim> v;
        for (unsigned int d = 0; d < dim; ++d)
        {
          at[d] = point[d][l];
          v[d]  = domains.value[d][l];
          for (unsigned int e = 0; e < dim; ++e)
            v[d] += domains.gradient[d][e][l] * (point[e][l] - domains.point[0][e][l]);
        }
        apart.add(lattice, at, v);
      }
  }
  check_true("short domains", is_short);
  double difference = 0;
  for (unsigned int i = 0; i < setup.grid.fields.n_local(); ++i)
    for (unsigned int c = 0; c < Imls<dim, 1>::n_numbers; ++c)
      raise(difference, together.numbers()[i][c] - apart.numbers()[i][c]);
  check("domains and points", difference, 1e-11);
}

template void imls_on_a_lattice<2>();
template void imls_on_a_lattice<3>();
template void imls_domains<2>();
template void imls_domains<3>();

#include <talus/steppers/deformation.h>
#include <talus/transfer/averaging.h>

#include <map>

#include "transfer.h"

using namespace Test;
using namespace dealii;

/** Averages over the grid and F-bar, in all cells of a box with walls, edges and corners. */
namespace
{
  const std::vector<std::string> all_kernels = {"linear", "quadratic B-spline", "cubic B-spline", "uGIMP", "CPDI"};

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
  double mass(const Setup<dim> &setup, const unsigned int p)
  {
    return setup.particles.component(setup.particles.mass, 0)[p];
  }

  /** Sums of all ranks at nodes, which their places tell apart: mass, and mass times a number. */
  template <int dim>
  class NodeMeans
  {
  public:
    void add(const Setup<dim> &setup, const unsigned int p, const double value)
    {
      const auto stencil = setup.stencil(p);
      for (unsigned int k = 0; k < stencil.size; ++k)
      {
        auto &[m, sum] = sums[key(setup.position(p), stencil, k)];
        m += stencil.weight[k] * mass(setup, p);
        sum += stencil.weight[k] * mass(setup, p) * value;
      }
    }
    void collect()
    {
      const auto all = Utilities::MPI::all_gather(MPI_COMM_WORLD, sums);
      sums.clear();
      for (const auto &part : all)
        for (const auto &[k, value] : part)
        {
          sums[k].first += value.first;
          sums[k].second += value.second;
        }
    }
    double at(const Setup<dim> &setup, const unsigned int p) const
    {
      const auto stencil = setup.stencil(p);
      double     value = 0, weight = 0;
      for (unsigned int k = 0; k < stencil.size; ++k)
      {
        const auto &[m, sum] = sums.at(key(setup.position(p), stencil, k));
        value += m > 0 ? stencil.weight[k] * sum / m : 0;
        weight += stencil.weight[k];
      }
      return value / weight;
    }

  private:
    using Key = std::array<long, dim>;
    static Key key(const Point<dim> &x, const Stencil<dim> &stencil, const unsigned int k)
    {
      Key result;
      for (unsigned int d = 0; d < dim; ++d)
        result[d] = std::lround(1e4 * (x[d] + stencil.offset[d][k]));
      return result;
    }
    std::map<Key, std::pair<double, double>> sums;
  };
} // namespace

/**
 * Linear functions with their gradients stay, at corners of the box too; two quantities at once do not mix; constants
 * divided by the sum of weights stay without correction. Whatever their values, sum m a stays. Fields of the grid and
 * particles outside the range are left alone.
 */
template <int dim>
void averaging()
{
  for (const auto &kernel : all_kernels)
  {
    Setup<dim>                       setup(some_box<dim>(kernel));
    auto                            &particles = setup.particles;
    Averaging<dim>                   averaging(setup.parameters, "WLS separable");
    const unsigned int               n = particles.size();
    std::vector<double>              a(n), b(n);
    std::vector<std::vector<double>> g(dim, std::vector<double>(n));
    Tensor<1, dim>                   slope;
    for (unsigned int d = 0; d < dim; ++d)
      slope[d] = 0.7 - 0.4 * d;
    std::array<typename Averaging<dim>::Quantity, dim> quantities;
    quantities[0].value = a.data();
    quantities[1].value = b.data();
    for (unsigned int d = 0; d < dim; ++d)
      quantities[0].gradient[d] = g[d].data();
    const auto field = [&](const unsigned int p) { return 2 + slope * setup.position(p); };
    for (unsigned int p = 0; p < n; ++p)
    {
      a[p] = field(p);
      b[p] = 3;
      for (unsigned int d = 0; d < dim; ++d)
        g[d][p] = slope[d];
    }
    const auto before = particles.vector(particles.position, n - 1);
    averaging.apply(quantities, {}, particles, 0, n, *setup.kernel, setup.grid);
    double error = 0, slope_error = 0, constant_error = 0;
    for (unsigned int p = 0; p < n; ++p)
    {
      raise(error, a[p] - field(p));
      raise(constant_error, b[p] - 3);
      for (unsigned int d = 0; d < dim; ++d)
        raise(slope_error, 0.1 * (g[d][p] - slope[d]));
    }
    check(kernel + ": linear", error, 1e-12);
    check(kernel + ": gradient", slope_error, 1e-12);
    check(kernel + ": constant", constant_error, 1e-12);
    check(kernel + ": positions", (particles.vector(particles.position, n - 1) - before).norm(), 0.);

    double sum_before = 0, sum_after = 0;
    for (unsigned int p = 0; p < n; ++p)
    {
      a[p] = 1 + 0.3 * hashed_jitter(8, particles.id[p], 0);
      sum_before += mass(setup, p) * a[p];
      for (unsigned int d = 0; d < dim; ++d)
        g[d][p] = hashed_jitter(9, particles.id[p], d);
    }
    averaging.apply(quantities, {}, particles, 0, n, *setup.kernel, setup.grid);
    for (unsigned int p = 0; p < n; ++p)
      sum_after += mass(setup, p) * a[p];
    check(kernel + ": sum m a", sum(sum_after) / sum(sum_before) - 1, 1e-13);

    const auto first = a;
    averaging.apply(quantities, {}, particles, n / 4, n / 2, *setup.kernel, setup.grid);
    double touched = 0;
    for (unsigned int p = 0; p < n; ++p)
      if (p < n / 4 || p >= n / 2)
        raise(touched, a[p] - first[p]);
    check(kernel + ": beyond the range", touched, 0.);
    for (unsigned int i = 0; i < setup.grid.fields.n_local(); ++i)
      for (unsigned int lane = 0; lane < 8; ++lane)
        raise(touched, setup.grid.fields[i][lane]);
    check(kernel + ": fields of the grid", touched, 0.);
  }
}

/**
 * F-bar against its definition, with averages summed here over lists: particles deform by f-bar, f but for its volume,
 * which is that of ln j averaged twice; the mean stress that the nodes get is the adjoint of that; a step of the law
 * sees its own stress. Weights are those of the start of the step.
 */
template <int dim>
void f_bar()
{
  for (const auto &kernel : all_kernels)
  {
    const bool is_list = kernel == "CPDI";
    // The run's own kernel is the uncorrected one, so that the lists are those of the definition.
    Setup<dim>    setup(some_box<dim>(kernel, section("Run", set("F-bar", "true")) +
                                             (is_list ? "" : section("Kernel", set("Boundary treatment", "none")))));
    auto         &particles = setup.particles;
    auto         &f_bar     = setup.f_bar;
    const auto    seen      = seen_gradient(particles);
    const double  dt        = 1e-2;
    const double *V         = particles.component(particles.volume, 0);
    const auto    average   = [&](std::vector<double> a) {
      for (unsigned int n = 0; n < 2; ++n)
      {
        NodeMeans<dim> means;
        for (unsigned int p = 0; p < a.size(); ++p)
          means.add(setup, p, a[p]);
        means.collect();
        for (unsigned int p = 0; p < a.size(); ++p)
          a[p] = means.at(setup, p);
      }
      return a;
    };
    const auto deformation = [&](const unsigned int field, const unsigned int p) {
      Tensor<2, dim> f = dt * particles.matrix(field, p);
      for (unsigned int d = 0; d < dim; ++d)
        f[d][d] += 1;
      return f;
    };
    check_true(kernel + ": materials see another gradient",
               material_range(particles, 0, dt).grad_v[0] == particles.component(seen, 0) && seen != particles.grad_v);

    double error = 0;
    setup.fill(particles.grad_v, [&](const unsigned int, const unsigned int c) { return 1. + c; });
    f_bar.start(1, *setup.kernel, particles, setup.grid);
    f_bar.average_rate(dt, particles, setup.grid);
    for (unsigned int p = 0; p < particles.size(); ++p)
      raise(error, dt * (particles.matrix(seen, p) - particles.matrix(particles.grad_v, p)).norm());
    check(kernel + ": a uniform change stays", error, 1e-13);

    setup.randomize(particles.grad_v, 11);
    std::vector<double> change(particles.size());
    for (unsigned int p = 0; p < particles.size(); ++p)
      change[p] = std::log(determinant(deformation(particles.grad_v, p)));
    const auto mean = average(change);
    f_bar.start(1, *setup.kernel, particles, setup.grid);
    const auto x = particles.vector(particles.position, 0);
    for (unsigned int d = 0; d < dim; ++d) // particles have moved; the weights are those from before
      for (unsigned int p = 0; p < particles.size(); ++p)
        particles.component(particles.position, d)[p] += 1e-3;
    f_bar.average_rate(dt, particles, setup.grid);
    double moved = 0;
    for (unsigned int d = 0; d < dim; ++d)
      for (unsigned int p = 0; p < particles.size(); ++p)
        particles.component(particles.position, d)[p] -= 1e-3;
    raise(moved, (particles.vector(particles.position, 0) - x).norm());
    check(kernel + ": positions", moved, 1e-15);
    for (unsigned int p = 0; p < particles.size(); ++p)
      raise(error,
            (deformation(seen, p) - std::exp((mean[p] - change[p]) / dim) * deformation(particles.grad_v, p)).norm());
    check(kernel + ": f-bar", error, 1e-13);

    setup.randomize(particles.stress, 12);
    const auto          columns = particles.template components<WorkingSet<dim>::n_stress>(particles.stress);
    std::vector<double> own(particles.size()), other(particles.size());
    for (unsigned int p = 0; p < particles.size(); ++p)
    {
      for (unsigned int d = 0; d < dim; ++d)
        own[p] += columns[d][p] / dim;
      other[p] = hashed_jitter(5, particles.id[p], 0);
    }
    std::vector<std::vector<double>> before;
    for (const double *column : columns)
      before.emplace_back(column, column + particles.size());
    f_bar.average_stress(particles, setup.grid);
    // The adjoint: whatever the numbers a, sum V p-of-the-nodes a = sum V p (A A a).
    const auto averaged = average(other);
    double     left = 0, right = 0, size = 0, shear = 0, back = 0;
    for (unsigned int p = 0; p < particles.size(); ++p)
    {
      const double added = columns[0][p] - before[0][p];
      left += V[p] * (own[p] + added) * other[p];
      right += V[p] * own[p] * averaged[p];
      size += std::abs(V[p] * own[p]);
      for (unsigned int c = 0; c < columns.size(); ++c)
        raise(shear, columns[c][p] - before[c][p] - (c < 3 ? added : 0.));
    }
    check(kernel + ": stress is the adjoint", sum(left - right) / sum(size), 1e-13);
    check(kernel + ": only the mean changes", max(shear), 1e-14);
    f_bar.remove_added(particles, 0, particles.size());
    for (unsigned int c = 0; c < columns.size(); ++c)
      for (unsigned int p = 0; p < particles.size(); ++p)
        raise(back, columns[c][p] - before[c][p]);
    check(kernel + ": the law's own stress", max(back), 1e-14);
  }
  check_error<EntryError>("with smoothing", {"/Run: F-bar", "'J smoothing' of 'rubber'"}, [] {
    Setup<dim> bad(skewed_grid<dim>({{4, 4, 4}}) + section("Run", set("F-bar", "true")) +
                   section("Materials", section("rubber", set("Type", "Newtonian fluid") + set("J smoothing", ".1"))) +
                   section("Materials", set("Names", "rubber")));
  });
}

template void averaging<2>();
template void averaging<3>();
template void f_bar<2>();
template void f_bar<3>();

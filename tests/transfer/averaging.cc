#include <talus/transfer/averaging.h>

#include "some_box.h"

using namespace Test;
using namespace dealii;

/** Averages over the grid, in all cells of a box with walls, edges and corners. */
namespace
{
  /** Two quantities of the particles of a box, the first of which has a gradient. */
  template <int dim>
  class Averaged
  {
  public:
    explicit Averaged(const std::string &kernel) :
      setup(some_box<dim>(kernel)), averaging(setup.parameters, "WLS separable"), kernel(kernel),
      n(setup.particles.size()), a(n), b(n), g(dim, std::vector<double>(n))
    {
      quantities[0].value = a.data();
      quantities[1].value = b.data();
      for (unsigned int d = 0; d < dim; ++d)
        quantities[0].gradient[d] = g[d].data();
    }

    void check_linear()
    {
      Tensor<1, dim> slope;
      for (unsigned int d = 0; d < dim; ++d)
        slope[d] = 0.7 - 0.4 * d;
      const auto field = [&](const unsigned int p) { return 2 + slope * setup.position(p); };
      for (unsigned int p = 0; p < n; ++p)
      {
        a[p] = field(p);
        b[p] = 3;
        for (unsigned int d = 0; d < dim; ++d)
          g[d][p] = slope[d];
      }
      const auto last   = [&] { return setup.particles.vector(setup.particles.position, n - 1); };
      const auto before = last();
      apply(0, n);
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
      check(kernel + ": positions", (last() - before).norm(), 0.);
    }

    void check_sum()
    {
      double sum_before = 0, sum_after = 0;
      for (unsigned int p = 0; p < n; ++p)
      {
        a[p] = 1 + 0.3 * hashed_jitter(8, setup.particles.id[p], 0);
        sum_before += mass_of(setup, p) * a[p];
        for (unsigned int d = 0; d < dim; ++d)
          g[d][p] = hashed_jitter(9, setup.particles.id[p], d);
      }
      apply(0, n);
      for (unsigned int p = 0; p < n; ++p)
        sum_after += mass_of(setup, p) * a[p];
      check(kernel + ": sum m a", sum(sum_after) / sum(sum_before) - 1, 1e-13);
    }

    void check_part()
    {
      const auto first = a;
      apply(n / 4, n / 2);
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

  private:
    void apply(const unsigned int begin, const unsigned int end)
    {
      averaging.apply(quantities, {}, setup.particles, begin, end, *setup.kernel, setup.grid);
    }

    Setup<dim>                                         setup;
    Averaging<dim>                                     averaging;
    const std::string                                  kernel;
    const unsigned int                                 n;
    std::vector<double>                                a, b;
    std::vector<std::vector<double>>                   g;
    std::array<typename Averaging<dim>::Quantity, dim> quantities;
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
    Averaged<dim> averaged(kernel);
    averaged.check_linear();
    averaged.check_sum();
    averaged.check_part();
  }
}

template void averaging<2>();
template void averaging<3>();

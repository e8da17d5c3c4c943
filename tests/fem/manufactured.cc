#include <talus/verification/manufactured_elastic.h>

#include "check.h"
#include "reference.h"

#include <deal.II/base/function_parser.h>
#include <deal.II/base/utilities.h>

using namespace dealii;
using namespace Talus;

namespace
{
  const double K = 3., G = 1.;

  // The amplitude is 1 and wave numbers are at most 2.2, three directions multiply: |d^n u| <= 2.2^n. The four-point
  // formula is wrong by h^4 |f'''''| / 30: with h = 1e-2 by 2e-8 for f = u; for f = stress of differences, with moduli
  // of at most 5 K and 2.2^6 = 113, by 1e-8/30 * 113 * 5 K * 3 directions = 2e-6. Round-off is 1e-16 * 5 K / h^2 =
  // 2e-11.
  const double h = 1e-2;

  template <typename Value, int dim>
  Value difference(const std::function<Value(const Point<dim> &)> &f, const Point<dim> &x, const unsigned int j)
  {
    const auto at = [&](const double steps) {
      Point<dim> y = x;
      y[j] += steps * h;
      return f(y);
    };
    return (8. * (at(1) - at(-1)) - (at(2) - at(-2))) / (12. * h);
  }

  /** Stress from the values of u alone, written with E and nu so that nothing is shared with the class. */
  template <int dim>
  Tensor<2, 3> stress_by_differences(const Function<dim> &u, const Point<dim> &x)
  {
    const double nu = (3 * K - 2 * G) / (2 * (3 * K + G)), E = 9 * K * G / (3 * K + G);
    Tensor<2, 3> grad_u, stress;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        grad_u[i][j] = difference<double, dim>([&](const Point<dim> &y) { return u.value(y, i); }, x, j);
    for (unsigned int i = 0; i < 3; ++i)
    {
      stress[i][i] = E / (1 + nu) * nu / (1 - 2 * nu) * trace(grad_u);
      for (unsigned int j = 0; j < 3; ++j)
        stress[i][j] += E / (1 + nu) * (grad_u[i][j] + grad_u[j][i]) / 2;
    }
    return stress;
  }

  template <int dim>
  void check_manufactured()
  {
    const std::string                d = std::to_string(dim) + "D ";
    const ManufacturedElastic<dim>   u(K, G);
    const ManufacturedBodyForce<dim> body_force(u);
    FunctionParser<dim>              parsed(dim);
    parsed.initialize(dim == 2 ? "x,y" : "x,y,z", Utilities::split_string_list(u.formulas(), ';'), {}, false);

    Point<dim> upper;
    for (unsigned int i = 0; i < dim; ++i)
      upper[i] = 1.;
    double stress_error = 0., gradient_error = 0., balance_error = 0., formula_error = 0.;
    for (const auto &x : Test::random_points<dim>({}, upper, 50))
    {
      stress_error = std::max(stress_error, (Tensor<2, 3>(u.stress(x)) - stress_by_differences<dim>(u, x)).norm());
      Tensor<2, 3> balance;
      for (unsigned int j = 0; j < dim; ++j)
      {
        const auto slope =
          difference<Tensor<2, 3>, dim>([&](const Point<dim> &y) { return stress_by_differences<dim>(u, y); }, x, j);
        for (unsigned int i = 0; i < dim; ++i)
          balance[0][i] += slope[i][j];
      }
      for (unsigned int i = 0; i < dim; ++i)
      {
        balance[0][i] += body_force.value(x, i);
        formula_error = std::max(formula_error, std::abs(parsed.value(x, i) - u.value(x, i)));
        for (unsigned int j = 0; j < dim; ++j)
          gradient_error =
            std::max(gradient_error,
                     std::abs(u.gradient(x, i)[j] -
                              difference<double, dim>([&](const Point<dim> &y) { return u.value(y, i); }, x, j)));
      }
      balance_error = std::max(balance_error, balance.norm());
    }
    Test::check(d + "gradient against differences", gradient_error, 2e-8);
    Test::check(d + "stress against differences", stress_error, 5 * K * 3 * 2e-8);
    Test::check(d + "div stress + body force", balance_error, 2e-6 * 3);
    Test::check(d + "formulas", formula_error, 1e-14);
  }
} // namespace

void manufactured()
{
  check_manufactured<2>();
  check_manufactured<3>();
}

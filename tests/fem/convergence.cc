#include <talus/verification/manufactured_elastic.h>

#include "check.h"
#include "reference.h"

#include <deal.II/base/quadrature_lib.h>

using namespace dealii;
using namespace Talus;

namespace
{
  const double K = 2., G = 1.;

  // Neither a unit box nor at the origin, so that mistakes of scale and position show.
  template <int dim>
  Point<dim> corner(const bool is_upper)
  {
    const double lower[] = {0., .1, -.2}, upper[] = {1., .9, .6};
    Point<dim>   point;
    for (unsigned int i = 0; i < dim; ++i)
      point[i] = is_upper ? upper[i] : lower[i];
    return point;
  }

  /** The Gauss points of this rank's share of n^dim cells, and their weights. */
  template <int dim>
  Quadrature<dim> gauss_points(const unsigned int n, const unsigned int n_points)
  {
    const QIterated<dim>    all(QGauss<1>(n_points), n);
    const unsigned int      rank    = Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
    const unsigned int      n_ranks = Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
    const auto              lower   = corner<dim>(false);
    const auto              edges   = corner<dim>(true) - lower;
    std::vector<Point<dim>> points;
    std::vector<double>     weights;
    for (unsigned int q = rank; q < all.size(); q += n_ranks)
    {
      Point<dim> point  = lower;
      double     weight = all.weight(q);
      for (unsigned int i = 0; i < dim; ++i)
      {
        point[i] += edges[i] * all.point(q)[i];
        weight *= edges[i];
      }
      points.push_back(point);
      weights.push_back(weight);
    }
    return Quadrature<dim>(points, weights);
  }

  /** Errors of displacement and stress in L2. */
  template <int dim>
  std::pair<double, double> errors_of(const unsigned int degree, const unsigned int n)
  {
    const ManufacturedElastic<dim> exact(K, G);
    const auto                     list      = [](const Point<dim> &p) { return Patterns::Tools::to_string(p); };
    auto                           reference = Test::make_reference<dim>(
      Test::set("Degree", std::to_string(degree)) + Test::set("Cells", Test::repeat<dim>(std::to_string(n))) +
      Test::set("Lower corner", list(corner<dim>(false))) + Test::set("Upper corner", list(corner<dim>(true))) +
      Test::conditions("all", Test::condition("all", dim == 2 ? "0,1,2,3" : "0,1,2,3,4,5", exact.formulas())));
    reference->set_moduli(K, G);
    reference->set_body_force(std::make_shared<ManufacturedBodyForce<dim>>(exact));
    reference->solve(0.);

    const auto quadrature = gauss_points<dim>(n, degree + 2);
    const auto u          = reference->displacement(quadrature.get_points());
    const auto sigma      = reference->stress(quadrature.get_points());
    double     u_error = 0., sigma_error = 0.;
    for (unsigned int q = 0; q < quadrature.size(); ++q)
    {
      Vector<double> exact_u(dim);
      exact.vector_value(quadrature.point(q), exact_u);
      for (unsigned int i = 0; i < dim; ++i)
        u_error += quadrature.weight(q) * std::pow(u[q][i] - exact_u(i), 2);
      sigma_error += quadrature.weight(q) * std::pow((sigma[q] - exact.stress(quadrature.point(q))).norm(), 2);
    }
    return {std::sqrt(Utilities::MPI::sum(u_error, MPI_COMM_WORLD)),
            std::sqrt(Utilities::MPI::sum(sigma_error, MPI_COMM_WORLD))};
  }

  /** Orders p + 1 of the displacement and p of the stress (Cea, Aubin and Nitsche). */
  template <int dim>
  void check_orders(const unsigned int degree, const unsigned int n)
  {
    const std::string name   = std::to_string(dim) + "D Q" + std::to_string(degree);
    const auto        coarse = errors_of<dim>(degree, n), fine = errors_of<dim>(degree, 2 * n);
    if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      std::cout << "  " << name << ": L2 errors with " << n << ", " << 2 * n << " cells: displacement " << coarse.first
                << ", " << fine.first << "; stress " << coarse.second << ", " << fine.second << std::endl;
    Test::check_range(name + " order of displacement", std::log2(coarse.first / fine.first), degree + .9, degree + 1.1);
    Test::check_range(name + " order of stress", std::log2(coarse.second / fine.second), degree - .1, degree + .1);
  }
} // namespace

void convergence()
{
  check_orders<2>(1, 16);
  check_orders<2>(2, 8);
  check_orders<3>(1, 4);
  check_orders<3>(2, 4);
}

#include <talus/fem/dynamic_reference.h>

#include "check.h"
#include "reference.h"

#include <deal.II/base/quadrature_lib.h>

using namespace dealii;
using namespace Talus;

namespace
{
  const double E = 10., nu = .3, rho = 2., lambda = E * nu / ((1 + nu) * (1 - 2 * nu)), mu = E / (2 * (1 + nu));

  /** Neither a unit box nor at the origin, so that mistakes of scale and position show. */
  template <int dim>
  struct Box
  {
    static constexpr double lower[] = {0., .1, -.2}, edge[] = {1., .8, .9};
    static std::string      corner(const bool is_upper)
    {
      Point<dim> x;
      for (unsigned int d = 0; d < dim; ++d)
        x[d] = lower[d] + (is_upper ? edge[d] : 0.);
      return Patterns::Tools::to_string(x);
    }
  };

  /** The section of a reference on that box. */
  template <int dim>
  std::string box(const unsigned int degree, const std::string &cells, const std::string &others)
  {
    return Test::set("Degree", std::to_string(degree)) + Test::set("Cells", cells) +
           Test::set("Lower corner", Box<dim>::corner(false)) + Test::set("Upper corner", Box<dim>::corner(true)) +
           "  subsection Solid\n" + Test::set("Young's modulus", std::to_string(E)) +
           Test::set("Poisson's ratio", std::to_string(nu)) + Test::set("Density", std::to_string(rho)) + "  end\n" +
           others;
  }

  /**
   * u_i = a_i (1 - cos w t) prod_j sin(k_ij s_j), s from 0 to pi across the box: at rest at first, and always 0 on its
   * faces; strains of a third. All derivatives in closed form.
   */
  template <int dim>
  struct Motion
  {
    static constexpr double w   = 3.;
    static constexpr double a[] = {.04, -.05, .03};

    /** Half waves across the box; in 3D few, so that few cells resolve them. */
    static double wave(const unsigned int i, const unsigned int j) { return dim == 2 && i != j ? 2 : 1; }

    static double product(const unsigned int i, const Point<dim> &x, const std::array<unsigned int, dim> &order)
    {
      double value = a[i];
      for (unsigned int j = 0; j < dim; ++j)
      {
        const double scale = wave(i, j) * numbers::PI / Box<dim>::edge[j], s = scale * (x[j] - Box<dim>::lower[j]);
        value *= std::pow(scale, order[j]) * std::sin(s + order[j] * numbers::PI / 2);
      }
      return value;
    }
    static Tensor<1, dim> value(const Point<dim> &x, const double t)
    {
      Tensor<1, dim> u;
      for (unsigned int i = 0; i < dim; ++i)
        u[i] = (1 - std::cos(w * t)) * product(i, x, {});
      return u;
    }

    /** u_tt - Div P/rho; Div P_i = A_ijkl u_k,lj with A = dP/dF = mu (I + T) + lambda inv inv - lambda ln J T. */
    static Tensor<1, dim> body_force(const Point<dim> &x, const double t)
    {
      const double   factor = 1 - std::cos(w * t);
      Tensor<2, dim> F;
      Tensor<3, dim> second; // u_k,lj
      Tensor<1, dim> b;
      for (unsigned int i = 0; i < dim; ++i)
      {
        F[i][i] += 1;
        for (unsigned int j = 0; j < dim; ++j)
        {
          std::array<unsigned int, dim> order{};
          ++order[j];
          F[i][j] += factor * product(i, x, order);
          for (unsigned int l = 0; l < dim; ++l)
          {
            auto both = order;
            ++both[l];
            second[i][l][j] = factor * product(i, x, both);
          }
        }
        b[i] = w * w * std::cos(w * t) * product(i, x, {});
      }
      const Tensor<2, dim> inverse = invert(F);
      const double         log_J   = std::log(determinant(F));
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          for (unsigned int k = 0; k < dim; ++k)
            for (unsigned int l = 0; l < dim; ++l)
            {
              const double A = mu * (i == k && j == l) + (mu - lambda * log_J) * inverse[l][i] * inverse[j][k] +
                               lambda * inverse[j][i] * inverse[l][k];
              b[i] -= A * second[k][l][j] / rho;
            }
      return b;
    }
  };

  template <int dim>
  std::string clamped()
  {
    const std::string zero = dim == 2 ? "0; 0" : "0; 0; 0";
    return Test::conditions("all", Test::condition("all", dim == 2 ? "0, 1, 2, 3" : "0, 1, 2, 3, 4, 5", zero));
  }

  /** The error of u in L2 over its norm, at a time when the motion is at its greatest. */
  template <int dim>
  double error_of(const unsigned int degree, const unsigned int n)
  {
    // Errors of time must not show beside those of space, which fall with the third power of h when those fall with the
    // second.
    const double courant   = degree == 1 ? .5 : 1. / n;
    auto         reference = Test::make<DynamicReference<dim>>(
      box<dim>(degree, Test::repeat<dim>(std::to_string(n)),
               clamped<dim>() + Test::set("Courant number", std::to_string(courant)) + Test::set("Rows", "1")));
    reference->set_body_force([](const Point<dim> &x, const double t) { return Motion<dim>::body_force(x, t); });
    const double t = .5;
    reference->solve(t);

    std::vector<Point<dim>> points;
    const QIterated<dim>    all(QGauss<1>(3), n);
    const unsigned int      rank    = Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
    const unsigned int      n_ranks = Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
    std::vector<double>     weights;
    for (unsigned int q = rank; q < all.size(); q += n_ranks)
    {
      Point<dim> x;
      for (unsigned int d = 0; d < dim; ++d)
        x[d] = Box<dim>::lower[d] + Box<dim>::edge[d] * all.point(q)[d];
      points.push_back(x);
      weights.push_back(all.weight(q));
    }
    const auto found = reference->displacement(points);
    double     error = 0, norm = 0;
    for (unsigned int q = 0; q < points.size(); ++q)
    {
      const auto exact = Motion<dim>::value(points[q], t);
      error += weights[q] * (found[q] - exact).norm_square();
      norm += weights[q] * exact.norm_square();
    }
    return std::sqrt(Utilities::MPI::sum(error, MPI_COMM_WORLD) / Utilities::MPI::sum(norm, MPI_COMM_WORLD));
  }

  template <int dim>
  void check_order(const unsigned int degree, const unsigned int n)
  {
    const double coarse = error_of<dim>(degree, n), fine = error_of<dim>(degree, 2 * n);
    if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      std::cout << "  errors " << coarse << ", " << fine << '\n';
    const std::string name = std::to_string(dim) + "D Q" + std::to_string(degree);
    // Masses and body forces by Simpson's rule add a term in h^4 to that in h^3, which still shows with so few cells.
    Test::check_range(name + ": order of the displacement", std::log2(coarse / fine), degree + .8, degree + 1.6);
    Test::check(name + ": its error", fine, degree == 1 ? .05 : .01);
  }

  /** A clamped beam under gravity at once, its tip goes down by half its length: energy is kept. */
  template <int dim>
  void check_energy(const unsigned int degree, const std::string &cells)
  {
    const std::string zero      = dim == 2 ? "0; 0" : "0; 0; 0";
    auto              reference = Test::make<DynamicReference<dim>>(
      box<dim>(degree, cells,
               Test::conditions("wall", Test::condition("wall", "0", zero)) +
                 Test::set("Body force", dim == 2 ? "0; -.4" : "0; -.4; .1") + Test::set("Rows", "50")));
    double residual = 0, greatest = 0;
    reference->solve(4., [&](const double) {
      const auto &e = reference->energies();
      greatest      = std::max({greatest, e.kinetic + e.strain});
      residual      = std::max(residual, std::abs(e.residual()));
    });
    Test::check(std::to_string(dim) + "D Q" + std::to_string(degree) + ": energy", residual / greatest, 1e-3);
  }

  /**
   * Gravity at once on a column between smooth walls, so weak that it is linear: until the wave from the floor arrives
   * at t = H/c its top falls freely, at 2 H/c it is lowest, by g H^2/c^2.
   */
  void check_column()
  {
    const double H = Box<2>::edge[1], c = std::sqrt((lambda + 2 * mu) / rho), g = 1e-6;
    auto         reference = Test::make<DynamicReference<2>>(
      box<2>(2, "1, 40",
             Test::conditions("sides, floor",
                                      Test::condition("sides", "0, 1", "0; 0", "x") + Test::condition("floor", "2", "0; 0")) +
               Test::set("Body force", "0; -1e-6") + Test::set("Points", ".5, .9") + Test::set("Rows", "2")));
    std::vector<double> heights;
    reference->solve(2 * H / c, [&](const double) { heights.push_back(reference->displacements_at_points()[0][1]); });
    const double fall = g * H * H / (c * c);
    Test::check("top of a column in free fall", heights[1] / fall + .5, 2e-3);
    Test::check("top of a column at its lowest", heights[2] / fall + 1, 2e-3);
  }

  /** Work of a moving clamp: what is put in is found as energy. */
  void check_moving_clamp()
  {
    auto reference = Test::make<DynamicReference<2>>(
      box<2>(1, "8, 8",
             Test::conditions("wall, other", Test::condition("wall", "0", "0; 0") +
                                               Test::condition("other", "1", ".1*(1 - cos(4*t)); 0")) +
               Test::set("Rows", "20")));
    double residual = 0, greatest = 0;
    reference->solve(3., [&](const double) {
      const auto &e = reference->energies();
      greatest      = std::max(greatest, e.work);
      residual      = std::max(residual, std::abs(e.residual()));
    });
    Test::check("work of a moving clamp", residual / greatest, 5e-3);
  }

  template <int dim>
  void check_ranks()
  {
    Tensor<1, dim> tip[2];
    for (const unsigned int i : {0, 1})
    {
      auto reference = Test::make<DynamicReference<dim>>(
        box<dim>(2, dim == 2 ? "6, 4" : "3, 2, 2",
                 Test::conditions("wall", Test::condition("wall", "0", dim == 2 ? "0; 0" : "0; 0; 0")) +
                   Test::set("Body force", dim == 2 ? "0; -.4" : "0; -.4; .1") +
                   Test::set("Points", dim == 2 ? ".9, .3" : ".9, .3, .2")),
        i == 0 ? MPI_COMM_WORLD : MPI_COMM_SELF);
      reference->solve(1.);
      tip[i] = reference->displacements_at_points()[0];
    }
    Test::check(std::to_string(dim) + "D together and alone", (tip[0] - tip[1]).norm() / tip[1].norm(), 1e-10);
  }

  void check_message(const std::string &name, const std::string &part, const std::string &text)
  {
    std::string message;
    try
    {
      Test::make<DynamicReference<2>>(text)->solve(1.);
    }
    catch (const InputError &error)
    {
      message = error.message;
    }
    catch (const RunError &error)
    {
      message = error.message;
    }
    Test::check_true(name + ": " + message, message.find(part) != std::string::npos);
  }
} // namespace

void dynamic()
{
  check_order<2>(1, 16);
  check_order<2>(2, 8);
  check_order<3>(1, 5);
  check_order<3>(2, 3);
  check_energy<2>(1, "10, 4");
  check_energy<2>(2, "5, 2");
  check_energy<3>(2, "4, 1, 1");
  check_column();
  check_moving_clamp();
  check_ranks<2>();
  check_ranks<3>();
}

void dynamic_errors()
{
  const std::string wall = Test::conditions("wall", Test::condition("wall", "0", "0; 0"));
  check_message("point outside", "the point (2, 0.5) lies outside", wall + Test::set("Points", ".5, .5; 2, .5"));
  check_message("Poisson's ratio", "'0.495' is not a valid value",
                "  subsection Solid\n    set Poisson's ratio = 0.495\n  end\n");
  check_message("density", "it must be positive", "  subsection Solid\n    set Density = 0\n  end\n");
  check_message("Courant number", "it must be positive", Test::set("Courant number", "0"));
  check_message("too long a step",
                "has diverged at t =", wall + Test::set("Courant number", "1.5") + Test::set("Body force", "0; -1"));
  check_message("too soft", "has diverged at t =",
                wall + Test::set("Body force", "0; -1000") +
                  "  subsection Solid\n    set Young's modulus = 1e3\n  end\n");
}

#include "check.h"
#include "reference.h"

#include <deal.II/base/function.h>

using namespace dealii;

namespace
{
  const double E = 1e9, nu = .3, K = E / 3 / (1 - 2 * nu), G = E / 2 / (1 + nu);

  /** Uniaxial stretch between frictionless plates, uniform and so exact for every element; u_x = .001 t at x = 2. */
  template <int dim>
  void check_uniaxial(const unsigned int degree)
  {
    const std::string name      = std::to_string(dim) + "D Q" + std::to_string(degree) + " uniaxial ";
    const bool        is_2d     = dim == 2;
    const std::string zero      = is_2d ? "0; 0" : "0; 0; 0";
    auto              reference = Test::make_reference<dim>(
      Test::set("Degree", std::to_string(degree)) + Test::set("Cells", is_2d ? "4, 6" : "4, 6, 2") +
      Test::set("Upper corner", is_2d ? "2, 3" : "2, 3, .5") +
      Test::conditions(is_2d ? "left, right, floor" : "left, right, floor, back",
                       Test::condition("left", "0", zero, "x") +
                         Test::condition("right", "1", is_2d ? "1e-3*t; 0" : "1e-3*t; 0; 0", "x") +
                         Test::condition("floor", "2", zero, "y") +
                         (is_2d ? "" : Test::condition("back", "4", zero, "z"))));
    reference->set_moduli(K, G);
    reference->solve(2.);

    const double          strain = .001, area = is_2d ? 3. : 1.5;
    const double          stress = (is_2d ? E / (1 - nu * nu) : E) * strain;
    SymmetricTensor<2, 3> exact;
    exact[0][0] = stress;
    exact[2][2] = is_2d ? nu * stress : 0.;

    // Also on the border of cells and of the box, where round-off may move a point out.
    Point<dim> upper, lower;
    upper[0] = 2. + 1e-14;
    upper[1] = 3.;
    if (dim == 3)
      upper[dim - 1] = .5;
    auto points = Test::random_points<dim>(lower, upper, 20);
    points.insert(points.end(), {lower, upper, Point<dim>(lower + .5 * (upper - lower))});
    const auto sigma       = reference->stress(points);
    const auto u           = reference->displacement(points);
    double     sigma_error = 0., u_error = 0.;
    for (unsigned int q = 0; q < points.size(); ++q)
    {
      sigma_error = std::max(sigma_error, (sigma[q] - exact).norm() / stress);
      u_error     = std::max({u_error, std::abs(u[q][0] / .002 - points[q][0] / 2.),
                              std::abs(u[q][1] / .002 + (is_2d ? nu / (1 - nu) : nu) * points[q][1] / 2.)});
    }
    Test::check(name + "stress", sigma_error, 1e-9);
    Test::check(name + "displacement", u_error, 1e-9);
    Test::check(name + "pulls its plate back", reference->force("right")[0] / (-stress * area) - 1., 1e-9);
    Test::check(name + "other plate", reference->force("left")[0] / (stress * area) - 1., 1e-9);
    Test::check(name + "nothing on the floor", reference->force("floor").norm() / (stress * area), 1e-9);
  }

  /** A sheared block under a constant body force: all that acts on the plates is that body force. */
  template <int dim>
  void check_balance(const unsigned int degree)
  {
    const bool        is_2d        = dim == 2;
    const std::string zero         = is_2d ? "0; 0" : "0; 0; 0";
    const std::string bottom_plate = Test::condition("bottom", is_2d ? "2" : "4", zero);
    const std::string top_plate    = Test::condition("top", is_2d ? "3" : "5", is_2d ? "1e-4; 0" : "1e-4; 0; 0");
    auto              reference    = Test::make_reference<dim>(Test::set("Degree", std::to_string(degree)) +
                                               Test::set("Cells", Test::repeat<dim>("6")) +
                                               Test::conditions("bottom, top", bottom_plate + top_plate));
    Tensor<1, dim>    total;
    for (unsigned int i = 0; i < dim; ++i)
      total[i] = 1e4 * (1. + i);
    std::vector<double> components(total.begin_raw(), total.end_raw());
    reference->set_moduli(K, G);
    reference->set_body_force(std::make_shared<Functions::ConstantFunction<dim>>(components));
    reference->solve(0.);
    const auto bottom = reference->force("bottom"), top = reference->force("top");
    Test::check(std::to_string(dim) + "D Q" + std::to_string(degree) + " balance of forces",
                (bottom + top - total).norm() / (bottom.norm() + top.norm()), 1e-9);
  }

  /** Two conditions on one face: the last counts, and the force is its own. */
  void check_precedence()
  {
    const std::string first     = Test::condition("first", "3", "7; 0"),
                      last      = Test::condition("last", "3", "1e-3; 7", "x");
    const std::string floor     = Test::condition("floor", "2", "0; 0");
    auto              reference = Test::make_reference<2>(Test::set("Cells", "4, 4") +
                                             Test::conditions("floor, first, last", floor + first + last));
    reference->set_moduli(K, G);
    reference->solve(0.);
    const auto u = reference->displacement({Point<2>(0., 1.), Point<2>(.3, 1.), Point<2>(1., 1.)});
    for (const auto &u_top : u)
      Test::check("last condition counts", (u_top - Tensor<1, 2>({1e-3, 0.})).norm() / 1e-3, 1e-12);
    const auto first_force = reference->force("first"), last_force = reference->force("last");
    Test::check("force without x of the first condition", first_force[0] / (1e-3 * G), 1e-12);
    Test::check("force without y of the last condition", last_force[1] / (1e-3 * G), 1e-12);
    Test::check("x of the force is the last condition's",
                (reference->force("floor")[0] + last_force[0]) / last_force[0], 1e-9);
    Test::check_true("it opposes the motion", last_force[0] < -.1 * 1e-3 * G);
  }

  /** Random points' stress and the forces, computed by all ranks together and by each alone. */
  template <int dim>
  void check_ranks()
  {
    const std::string zero = dim == 2 ? "0; 0" : "0; 0; 0", moved = dim == 2 ? "1e-4*x; 0" : "1e-4*x; 0; 0";
    const std::string plates = Test::condition("bottom", "2", zero) + Test::condition("top", "3", moved);
    const std::string text =
      Test::set("Cells", dim == 2 ? "12, 12" : "4, 4, 4") + Test::conditions("bottom, top", plates);
    Point<dim> upper;
    for (unsigned int i = 0; i < dim; ++i)
      upper[i] = 1.;
    const auto                         points = Test::random_points<dim>({}, upper, 50, true);
    std::vector<SymmetricTensor<2, 3>> stress[2];
    Tensor<1, dim>                     force[2];
    for (const unsigned int i : {0, 1})
    {
      auto reference = Test::make_reference<dim>(text, i == 0 ? MPI_COMM_WORLD : MPI_COMM_SELF);
      reference->set_moduli(K, G);
      reference->solve(0.);
      stress[i] = reference->stress(points);
      force[i]  = reference->force("top");
    }
    double error = 0., largest = 0.;
    for (unsigned int q = 0; q < points.size(); ++q)
    {
      error   = std::max(error, (stress[0][q] - stress[1][q]).norm());
      largest = std::max(largest, stress[0][q].norm());
    }
    Test::check(std::to_string(dim) + "D stress together and alone", error / largest, 1e-9);
    Test::check(std::to_string(dim) + "D force together and alone", (force[0] - force[1]).norm() / force[0].norm(),
                1e-9);
  }
} // namespace

void affine()
{
  for (const unsigned int degree : {1, 2})
  {
    check_uniaxial<2>(degree);
    check_uniaxial<3>(degree);
  }
}

void forces()
{
  check_precedence();
  for (const unsigned int degree : {1, 2})
  {
    check_balance<2>(degree);
    check_balance<3>(degree);
  }
}

void ranks()
{
  check_ranks<2>();
  check_ranks<3>();
}

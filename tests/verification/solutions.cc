#include <talus/verification/ring_expansion.h>
#include <talus/verification/vibration.h>
#include <talus/verification/vortex.h>

#include <talus/core/parameters.h>

#include "../setup.h"

#include <Sacado.hpp>

using namespace Test;
using namespace dealii;

namespace
{
  // Numbers that carry their first derivatives by x, y (, z) and t, and those numbers again: second derivatives.
  template <int dim>
  using Once = Sacado::Fad::SFad<double, dim + 1>;
  template <int dim>
  using Twice = Sacado::Fad::SFad<Once<dim>, dim + 1>;

  /** What u alone says of a motion. */
  template <int dim>
  struct Derived
  {
    Tensor<1, dim> u, v, b;
    Tensor<2, dim> F, F_t, stress;
  };

  template <int dim, typename Number>
  using Matrix = std::array<std::array<Number, dim>, dim>;

  /** Determinant and inverse transposed times determinant. */
  template <int dim, typename Number>
  Number cofactors(const Matrix<dim, Number> &F, Matrix<dim, Number> &cofactor)
  {
    if constexpr (dim == 2)
      cofactor = {{{{F[1][1], -F[1][0]}}, {{-F[0][1], F[0][0]}}}};
    else
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
        {
          const unsigned int a = (i + 1) % 3, b = (i + 2) % 3, c = (j + 1) % 3, d = (j + 2) % 3;
          cofactor[i][j] = F[a][c] * F[b][d] - F[a][d] * F[b][c];
        }
    Number J = 0.;
    for (unsigned int j = 0; j < dim; ++j)
      J += F[0][j] * cofactor[0][j];
    return J;
  }

  /** The momentum balance in the reference configuration, with every derivative taken by the numbers themselves. */
  template <class Solution, int dim>
  Derived<dim> derive(const Solution &solution, const Point<dim> &X, const double t)
  {
    const auto &[lambda, mu, density] = solution.material;
    std::array<Twice<dim>, dim> place;
    const auto                  variable = [](const unsigned int i, const double value) {
      return Twice<dim>(dim + 1, i, Once<dim>(dim + 1, i, value));
    };
    for (unsigned int d = 0; d < dim; ++d)
      place[d] = variable(d, X[d]);
    const auto u = solution.displacement(place, variable(dim, t));

    Derived<dim>           result;
    Matrix<dim, Once<dim>> F, cofactor;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        F[i][j] = u[i].dx(j) + (i == j ? 1. : 0.);
    const Once<dim> J = cofactors<dim>(F, cofactor), log_J = log(J);
    Tensor<2, dim>  P;
    for (unsigned int i = 0; i < dim; ++i)
    {
      result.u[i] = u[i].val().val();
      result.v[i] = u[i].dx(dim).val();
      result.b[i] = u[i].dx(dim).dx(dim);
      for (unsigned int j = 0; j < dim; ++j)
      {
        result.F[i][j]       = F[i][j].val();
        result.F_t[i][j]     = F[i][j].dx(dim);
        const Once<dim> P_ij = (lambda * log_J - mu) * cofactor[i][j] / J + mu * F[i][j];
        P[i][j]              = P_ij.val();
        result.b[i] -= P_ij.dx(j) / density;
      }
    }
    result.stress = P * transpose(result.F) / J.val();
    return result;
  }

  /** Largest difference between the formulas and what u says, over points that `place` makes of numbers in [0, 1). */
  template <int dim, class Solution, class Place>
  void compare(const std::string &name, const Solution &solution, const double period, const Place &place)
  {
    std::array<double, 6> error{}, largest{};
    double                start = 0;
    for (unsigned int i = 0; i < 200; ++i)
    {
      std::array<double, dim> random;
      for (unsigned int d = 0; d < dim; ++d)
        random[d] = 0.5 + 0.5 * hashed_jitter(1, i, d);
      const Point<dim> X       = place(random);
      const double     t       = period * (0.5 + 0.5 * hashed_jitter(2, i, 0));
      const auto       exact   = derive(solution, X, t);
      const auto       measure = [&](const unsigned int k, const auto &coded, const auto &derived) {
        raise(error[k], (coded - derived).norm());
        raise(largest[k], derived.norm());
      };
      measure(0, solution.displacement(X, t), exact.u);
      measure(1, solution.velocity(X, t), exact.v);
      measure(2, solution.deformation_gradient(X, t), exact.F);
      measure(3, solution.deformation_rate(X, t), exact.F_t);
      measure(4, solution.stress(X, t), exact.stress);
      measure(5, solution.body_force(X, t), exact.b);
      raise(start, solution.displacement(X, 0.).norm());
    }
    const char *names[6] = {"u", "v = du/dt", "F = I + du/dX", "dF/dt", "stress", "b: momentum balance"};
    // Round-off of sums of a few terms that cancel to a hundredth or more.
    for (unsigned int k = 0; k < 6; ++k)
      check(name + ": " + names[k], error[k] / largest[k], 1e-12);
    check(name + ": u at the start", start, 1e-15); // a difference of lengths of about 1
  }

  /** A solution with these entries. */
  template <class Solution>
  std::unique_ptr<Solution> make(const std::string &entries, const NeoHookeanConstants &material)
  {
    Parameters parameters = Parameters::from_text(section("Verification", entries));
    auto       solution   = std::make_unique<Solution>("/Verification");
    parameters.parse();
    solution->material = material;
    return solution;
  }

  /** lambda and mu of E = 1e7 and nu = .3. */
  const NeoHookeanConstants rubber = {1e7 * 0.3 / (1.3 * 0.4), 1e7 / 2.6, 1000};

  template <int dim>
  Point<dim> polar(const std::array<double, dim> &random, const double inner, const double outer)
  {
    const double R = inner + (outer - inner) * random[0], angle = 2 * numbers::PI * random[1];
    Point<dim>   X;
    X[0] = R * std::cos(angle);
    X[1] = R * std::sin(angle);
    if (dim == 3)
      X[dim - 1] = random[dim - 1];
    return X;
  }
} // namespace

template <int dim>
void vibration()
{
  const auto box = [](const auto &random) {
    Point<dim> X;
    for (unsigned int d = 0; d < dim; ++d)
      X[d] = 0.7 * random[d];
    return X;
  };
  for (const std::string directions : {"x", dim == 2 ? "x, y" : "x, y, z"})
    for (const std::string k : {"2", "1", "2.5"})
    {
      const auto solution = make<Vibration<dim>>(set("Length", "0.7") + set("Amplitude", "0.08") +
                                                   set("Wave number", k) + set("Directions", directions),
                                                 rubber);
      compare<dim>("along " + directions + ", k = " + k, *solution, 0.014, box);
    }
  // The sides stay where they are, for whole k.
  const auto solution = make<Vibration<dim>>("", rubber);
  double     error    = 0;
  for (unsigned int d = 0; d < dim; ++d)
    for (const double side : {0., 1.})
    {
      Point<dim> X;
      for (unsigned int e = 0; e < dim; ++e)
        X[e] = e == d ? side : 0.3;
      raise(error, solution->displacement(X, 0.003)[d]);
    }
  check("normal displacement of the sides", error / 0.1, 1e-15);
}

template <int dim>
void ring_expansion()
{
  const auto place = [](const auto &random) { return polar<dim>(random, 0.4, 0.6); };
  compare<dim>("nu = .3", *make<RingExpansion<dim>>("", rubber), 0.02, place);
  const NeoHookeanConstants cork = {0, 5e6, 1000};
  compare<dim>("other radii", *make<RingExpansion<dim>>(set("Inner radius", "0.3") + set("Outer radius", "0.8"), cork),
               0.02, [](const auto &random) { return polar<dim>(random, 0.3, 0.8); });

  const auto solution = make<RingExpansion<dim>>("", cork);
  compare<dim>("nu = 0", *solution, 0.02, place);
  double traction = 0;
  for (unsigned int i = 0; i < 100; ++i)
    for (const double R : {0.4, 0.6})
    {
      const Point<dim> X = polar<dim>({{0., 0.01 * i}}, R, R);
      Tensor<1, dim>   N;
      N[0] = X[0] / R;
      N[1] = X[1] / R;
      // n is along N: F is symmetric with N as an axis.
      raise(traction, (solution->stress(X, 0.005) * N).norm());
    }
  check("rims: traction", traction / cork.youngs_modulus(), 1e-12);
}

template <int dim>
void vortex()
{
  const NeoHookeanConstants jelly    = {1000 * 0.3 / (1.3 * 0.4), 1000 / 2.6, 1000};
  const auto                solution = make<Vortex<dim>>(set("Amplitude", "0.8"), jelly);
  compare<dim>("vortex", *solution, 2., [](const auto &random) { return polar<dim>(random, 0.75, 1.25); });
  double traction = 0, motion = 0, J = 0;
  for (unsigned int i = 0; i < 100; ++i)
    for (const double R : {0.75, 1., 1.25})
    {
      const Point<dim> X = polar<dim>({{0., 0.01 * i}}, R, R);
      raise(J, determinant(solution->deformation_gradient(X, 0.5)) - 1);
      if (R == 1.)
        continue;
      raise(traction, solution->stress(X, 0.5).norm());
      raise(motion, solution->displacement(X, 0.5).norm());
    }
  check("J = 1", J, 1e-12);
  check("rims: stress", traction / jelly.youngs_modulus(), 1e-12);
  check("rims: displacement", motion, 1e-12);
}

/** Entries that contradict each other, and constants for which a solution does not hold. */
template <int dim>
void solution_errors()
{
  check_error<EntryError>("inside out", {"/Verification: Amplitude", "inside out"},
                          [] { make<Vibration<dim>>(set("Amplitude", "0.16"), rubber); });
  check_error<EntryError>("no length", {"/Verification: Length", "positive"},
                          [] { make<Vibration<dim>>(set("Length", "0"), rubber); });
  check_error<EntryError>("no ring", {"/Verification: Outer radius", "greater"},
                          [] { make<RingExpansion<dim>>(set("Outer radius", "0.3"), rubber); });
  check_error<EntryError>("no such ring", {"/Verification: Outer radius", "r_o = 3 r_i"},
                          [] { make<RingExpansion<dim>>(set("Outer radius", "1.2"), rubber); });
  check_error<EntryError>("traction at the rims", {"/Verification: Solution", "Poisson's ratio to 0"}, [] {
    const auto solution = make<RingExpansion<dim>>("", rubber);
    solution->check(solution->material);
  });
}

#define INSTANTIATE(name)                                                                                              \
  template void name<2>();                                                                                             \
  template void name<3>();
INSTANTIATE(vibration)
INSTANTIATE(ring_expansion)
INSTANTIATE(vortex)
INSTANTIATE(solution_errors)

#include "bodies.h"

using namespace Test;
using namespace dealii;

template <int dim>
void initial_state()
{
  const std::string velocity = dim == 2 ? "x + 2*y; 3*x*y" : "x + 2*y; 3*x*y; z";
  const std::string body     = box<dim>(0, 1) + set("Velocity", velocity) +
                           set("Velocity gradient", dim == 2 ? "1, 2, 3, 4" : "1, 2, 3, 4, 5, 6, 7, 8, 9");
  double error = 0;
  {
    Setup<dim> setup(on_grid(body + set("Initial stress", "uniform") +
                             set("Stress", dim == 2 ? "1, 2, 3, 4, 0, 0" : "1, 2, 3, 4, 5, 6")));
    auto      &set = setup.particles;
    for (unsigned int p = 0; p < set.size(); ++p)
    {
      const auto x = setup.position(p);
      raise(error, set.component(set.velocity, 0)[p] - x[0] - 2 * x[1]);
      raise(error, set.component(set.velocity, 1)[p] - 3 * x[0] * x[1]);
      for (unsigned int c = 0; c < dim * dim; ++c)
      {
        raise(error, set.component(set.grad_v, c)[p] - (c + 1));
        raise(error, set.component(set.F, c)[p] - (c % (dim + 1) == 0));
      }
      for (unsigned int d = 0; d < dim; ++d)
        raise(error, set.component(set.initial_position, d)[p] - x[d]);
      for (unsigned int c = 0; c < set.n_stress; ++c)
        raise(error, set.component(set.stress, c)[p] - (c + 1));
    }
    check("velocity, gradients, uniform stress", error, 1e-14);
  }
  for (const double K0 : {-1., 0.7})
  {
    const unsigned int up = dim - 1;
    Setup<dim>         setup(on_grid(box<dim>(0, 1) + set("Initial stress", "geostatic") + set("Unit weight", "20") +
                                     set("Surface level", "0.9") + (K0 < 0 ? "" : set("Rest stress ratio", "0.7"))));
    auto              &set = setup.particles;
    error                  = 0;
    for (unsigned int p = 0; p < set.size(); ++p)
    {
      const double vertical = -20 * std::max(0., 0.9 - setup.position(p)[up]);
      const double ratio    = K0 < 0 ? 0.2 / 0.8 : K0;
      for (unsigned int c = 0; c < set.n_stress; ++c)
        raise(error, set.component(set.stress, c)[p] - (c == up ? vertical : c < 3 ? ratio * vertical : 0.));
    }
    check("geostatic, K0 = " + std::to_string(K0), error, 1e-13);
  }
}

/** A fluid at rest: p = weight (level - height), and the density that the equation of state has at this pressure. */
template <int dim>
void hydrostatic()
{
  const unsigned int up = dim - 1;
  const std::string  water =
    section("water", set("Type", "Newtonian fluid") + set("Density", "3") + set("Sound speed", "5"));
  const std::string start =
    set("Initial stress", "hydrostatic") + set("Unit weight", "20") + set("Surface level", "0.9");
  Setup<dim> setup(section("Grid", grid_entries) + section("Materials", set("Names", "water") + water) +
                   section("Bodies", set("Names", "body") + section("body", box<dim>(0, 1) + start)));
  auto      &set   = setup.particles;
  double     error = 0;
  for (unsigned int p = 0; p < set.size(); ++p)
  {
    const double pressure = 20 * std::max(0., 0.9 - setup.position(p)[up]);
    for (unsigned int c = 0; c < set.n_stress; ++c)
      raise(error, set.component(set.stress, c)[p] - (c < 3 ? -pressure : 0.));
    raise(error, set.component(set.mass, 0)[p] / set.component(set.volume, 0)[p] - (3 + pressure / 25));
  }
  check("stress and density", error, 1e-13);
}

/** A body that starts compressed by .8 in all directions of the plane or of space: mass, F and stress in closed form.
 */
template <int dim>
void deformed()
{
  const auto text_of = [](const std::string &more, const std::string &type) {
    std::string result = on_grid(box<dim>(0, 1) + more);
    return result.insert(result.find("set Density"), set("Type", type));
  };
  const std::string F = dim == 2 ? "0.8, 0, 0, 0.8" : "0.8, 0, 0, 0, 0.8, 0, 0, 0, 0.8";
  Setup<dim>        setup(text_of(set("Deformation gradient", F), "neo-Hookean"));
  auto             &set_of = setup.particles;
  const double      J = std::pow(0.8, dim), mu = 7 / 2.4, lambda = 7 * 0.2 / (1.2 * 0.6);
  double            error = 0;
  for (unsigned int p = 0; p < set_of.size(); ++p)
  {
    for (unsigned int c = 0; c < dim * dim; ++c)
      raise(error, set_of.component(set_of.F, c)[p] - (c % (dim + 1) == 0 ? 0.8 : 0.));
    for (unsigned int c = 0; c < set_of.n_stress; ++c)
      raise(error, set_of.component(set_of.stress, c)[p] -
                     (c < 3 ? (lambda * std::log(J) + mu * (c < dim ? 0.64 - 1 : 0.)) / J : 0.));
  }
  check("F and stress", error, 1e-13);
  check("volume", total(setup, set_of.volume) - 1, 1e-13);
  check("mass", total(setup, set_of.mass) - 3 / J, 1e-12);
  const auto refused = [&](const std::string &name, const std::string &F, const std::string &type,
                           const std::string &message) {
    check_error<EntryError>(name, {"/Bodies/body: Deformation gradient", message},
                            [&] { Setup<dim> s(text_of(set("Deformation gradient", F), type)); });
  };
  refused("inside out", (dim == 2 ? "-1, 0, 0, 1" : "-1, 0, 0, 0, 1, 0, 0, 0, 1"), "neo-Hookean", "positive");
  refused("too few numbers", "1, 0", "neo-Hookean", "row by row");
  refused("a law in rates", F, "linear elastic", "no function of it");
}

#define INSTANTIATE(name)                                                                                              \
  template void name<2>();                                                                                             \
  template void name<3>();
INSTANTIATE(initial_state)
INSTANTIATE(hydrostatic)
INSTANTIATE(deformed)

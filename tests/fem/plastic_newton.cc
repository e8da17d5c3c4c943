#include "check.h"
#include "plastic.h"

using namespace dealii;
using namespace Talus;

namespace
{
  /** A block between rough plates, compressed by `amount` per time, in 3 steps to t = 1. */
  template <int dim>
  std::string block(const std::string &cells, const std::string &upper, const std::string &others,
                    const std::string &integration = "B-bar", const std::string &amount = ".1")
  {
    const std::string zero = dim == 2 ? "0; 0" : "0; 0; 0", moved = "0; -t*" + amount + (dim == 2 ? "" : "; 0");
    return Test::set("Cells", cells) + Test::set("Upper corner", upper) + Test::set("Steps", "3") +
           Test::set("Integration", integration) + others +
           Test::conditions(dim == 2 ? "bottom, top" : "slab, bottom, top",
                            Test::condition("bottom", "2", zero) + Test::condition("top", "3", moved) +
                              (dim == 2 ? "" : Test::condition("slab", "4, 5", zero, "z")));
  }

  /** The order p of r_{n+1} ~ r_n^p over the last three imbalances above round-off; 0 when there are fewer. */
  double order(std::vector<double> imbalances)
  {
    while (!imbalances.empty() && imbalances.back() < 1e-13)
      imbalances.pop_back();
    const auto n = imbalances.size();
    return n < 3 ? 0. :
                   std::log(imbalances[n - 1] / imbalances[n - 2]) / std::log(imbalances[n - 2] / imbalances[n - 3]);
  }

  template <int dim>
  void check_quadratic(const Test::Hardening &hardening, const std::string &cells, const std::string &amount)
  {
    auto reference = Test::make<PlasticReference<dim>>(
      block<dim>(cells, Test::repeat<dim>("1"), hardening.section(), "B-bar", amount));
    double least = 10.; // of the steps long enough to tell
    reference->solve(1., [&](const double t) {
      if (t == 0.)
        return;
      if (const double p = order(reference->imbalances()); p > 0.)
        least = std::min(least, p);
      if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
        for (const double imbalance : reference->imbalances())
          std::cout << (imbalance == reference->imbalances().front() ? "  " : ", ") << imbalance
                    << (imbalance == reference->imbalances().back() ? "\n" : "");
    });
    // Without softening the work of deformation is convex, and the line search finds its minimum.
    if (hardening.name != "exponential")
      Test::check_true(std::to_string(dim) + "D " + hardening.name + ": no step halved", reference->n_halvings() == 0);
    Test::check_range(std::to_string(dim) + "D " + hardening.name + ": order of Newton's method", least, 1.7, 4.);
  }

  /** Below yield, with full integration, it is the elastic reference. */
  template <int dim>
  void check_elastic()
  {
    const std::string cells = dim == 2 ? "6, 4" : "3, 2, 2", upper = dim == 2 ? "1, 2" : "1, 2, .5";
    const std::string strong = "  subsection J2\n" + Test::set("Young's modulus", "1000") +
                               Test::set("Poisson's ratio", ".333") + Test::set("Yield stress", "1e9") + "  end\n";
    auto plastic = Test::make<PlasticReference<dim>>(block<dim>(cells, upper, strong, "full"));
    // The elastic reference has neither steps nor a choice of integration.
    std::string text = block<dim>(cells, upper, "");
    for (const std::string line : {"  set Steps = 3\n", "  set Integration = B-bar\n"})
      text.erase(text.find(line), line.size());
    auto elastic = Test::make_reference<dim>(text);
    elastic->set_moduli(Test::K, Test::G);
    plastic->solve(1.);
    elastic->solve(1.);
    const auto force = elastic->force("top");
    Test::check(std::to_string(dim) + "D elastic force", (plastic->force("top") - force).norm() / force.norm(), 1e-9);
  }

  /** One layer of cells between smooth walls is plane strain to the last node. */
  void check_slab(const Test::Hardening &hardening, const std::string &amount)
  {
    const auto entries = hardening.section();
    auto       plane   = Test::make<PlasticReference<2>>(block<2>("3, 4", "1, 2", entries, "B-bar", amount));
    auto       slab    = Test::make<PlasticReference<3>>(block<3>("3, 4, 1", "1, 2, .25", entries, "B-bar", amount));
    plane->solve(1.);
    slab->solve(1.);
    for (const std::string name : {"bottom", "top"})
      for (unsigned int i = 0; i < 2; ++i)
        Test::check(hardening.name + ": slab and plane strain, " + name + " " + "xy"[i],
                    (slab->force(name)[i] / .25 - plane->force(name)[i]) / plane->force("top")[1], 1e-8);
  }

  template <int dim>
  void check_together_and_alone()
  {
    const auto text =
      block<dim>(dim == 2 ? "8, 8" : "2, 2, 2", Test::repeat<dim>("1"), Test::hardenings()[1].section());
    Tensor<1, dim> force[2];
    for (const unsigned int i : {0, 1})
    {
      auto reference = Test::make<PlasticReference<dim>>(text, i == 0 ? MPI_COMM_WORLD : MPI_COMM_SELF);
      reference->solve(1.);
      force[i] = reference->force("top");
    }
    Test::check(std::to_string(dim) + "D plastic force together and alone",
                (force[0] - force[1]).norm() / force[0].norm(), 1e-9);
  }
} // namespace

void plastic_newton()
{
  // Further on the softening body localises, and its solution is no longer unique.
  for (const auto &hardening : Test::hardenings())
  {
    const std::string amount = hardening.name == "exponential" ? ".01" : ".1";
    check_quadratic<2>(hardening, "6, 6", amount);
    check_slab(hardening, amount);
  }
  check_quadratic<3>(Test::hardenings()[1], "2, 2, 2", ".03");
  check_elastic<2>();
  check_elastic<3>();
  check_together_and_alone<2>();
  check_together_and_alone<3>();
}

#include "check.h"
#include "plastic.h"

using namespace dealii;
using namespace Talus;

namespace
{
  const std::string zero_2d = "0; 0", zero_3d = "0; 0; 0";

  template <int dim>
  std::unique_ptr<PlasticReference<dim>> make_element(const Test::Hardening &hardening, const std::string &conditions)
  {
    return Test::make<PlasticReference<dim>>(Test::set("Cells", Test::repeat<dim>("1")) + Test::set("Steps", "4") +
                                             hardening.section() + conditions);
  }

  /** Plane strain: stretch without contraction, shear, stretch in both directions. The path at time t is t long. */
  void check_plane(const Test::Hardening &hardening)
  {
    const double t      = .08;
    const auto   plates = Test::condition("left", "0", zero_2d, "x") + Test::condition("right", "1", "t; 0", "x");
    const auto   q_of   = [&](const double q_trial) {
      return q_trial - 3. * Test::G * hardening.alpha(q_trial, 3. * Test::G);
    };

    auto uniaxial = make_element<2>(
      hardening, Test::conditions("left, right, others", plates + Test::condition("others", "2, 3", zero_2d, "y")));
    uniaxial->solve(t);
    const double q = q_of(2. * Test::G * t);
    Test::check(hardening.name + " uniaxial strain: stress along",
                uniaxial->force("left")[0] / (Test::K * t + 2. / 3. * q) - 1., 1e-9);
    auto biaxial = make_element<2>(
      hardening, Test::conditions("left, right, bottom, top", plates + Test::condition("bottom", "2", zero_2d, "y") +
                                                                Test::condition("top", "3", "0; t", "y")));
    biaxial->solve(t);
    for (const std::string name : {"left", "bottom"})
      Test::check(hardening.name + " biaxial strain: " + name,
                  biaxial->force(name).norm() / (2. * Test::K * t + q / 3.) - 1., 1e-9);

    auto shear =
      make_element<2>(hardening, Test::conditions("sides, bottom, top", Test::condition("sides", "0, 1", "t*y; 0") +
                                                                          Test::condition("bottom", "2", zero_2d) +
                                                                          Test::condition("top", "3", "t; 0")));
    shear->solve(t);
    Test::check(hardening.name + " simple shear",
                shear->force("top")[0] / (-q_of(std::sqrt(3.) * Test::G * t) / std::sqrt(3.)) - 1., 1e-9);
  }

  /** Stress in one and in two directions, the others free; back by a tenth at the end. */
  void check_space(const Test::Hardening &hardening)
  {
    const double      e    = .08;
    const std::string path = "(t < .1 ? t : .11 - .1*t)*.8";
    const auto        held = Test::condition("left", "0", zero_3d, "x") + Test::condition("floor", "4", zero_3d, "z") +
                      Test::condition("front", "2", zero_3d, "y");
    auto uniaxial =
      make_element<3>(hardening, Test::conditions("left, floor, front, right",
                                                  held + Test::condition("right", "1", path + "; 0; 0", "x")));
    // Uniaxial: strain = stress/E + alpha.
    const double stress = Test::E * (e - hardening.alpha(Test::E * e, Test::E));
    uniaxial->solve(.1);
    Test::check(hardening.name + " uniaxial stress", uniaxial->force("left")[0] / stress - 1., 1e-9);
    Test::check(hardening.name + " uniaxial stress: nothing aside", uniaxial->force("front").norm() / stress, 1e-9);
    uniaxial->solve(.2);
    Test::check(hardening.name + " uniaxial stress: unloading",
                uniaxial->force("left")[0] / (stress - Test::E * .1 * e) - 1., 1e-9);

    // Biaxial: strain = stress (1 - nu)/E + alpha/2 in both directions.
    auto biaxial = make_element<3>(hardening, Test::conditions("left, floor, front, right, back",
                                                               held + Test::condition("right", "1", "t; 0; 0", "x") +
                                                                 Test::condition("back", "3", "0; t; 0", "y")));
    biaxial->solve(e);
    const double stiffness = Test::E / (1. - Test::nu);
    const double both      = stiffness * (e - .5 * hardening.alpha(stiffness * e, .5 * stiffness));
    for (const std::string name : {"left", "front"})
      Test::check(hardening.name + " biaxial stress: " + name, biaxial->force(name).norm() / both - 1., 1e-9);
  }

  /** Compression with free sides in plane strain tends to 2/sqrt(3) Y, where the flow along z ceases. */
  void check_limit_in_plane_strain()
  {
    const auto hardening = Test::hardenings()[0];
    auto       element   = make_element<2>(
      hardening, Test::conditions("left, right, bottom", Test::condition("left", "0", zero_2d, "x") +
                                                                   Test::condition("right", "1", "-t; 0", "x") +
                                                                   Test::condition("bottom", "2", zero_2d, "y")));
    element->solve(1.);
    Test::check("plane strain compression tends to 2/sqrt(3) Y",
                element->force("right")[0] / (2. / std::sqrt(3.) * Test::Y) - 1., 1e-6);
  }
} // namespace

void plastic_element()
{
  for (const auto &hardening : Test::hardenings())
  {
    check_plane(hardening);
    check_space(hardening);
  }
  check_limit_in_plane_strain();
}

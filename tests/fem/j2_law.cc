#include <talus/core/parameters.h>
#include <talus/fem/j2_law.h>

#include "check.h"
#include "plastic.h"

using namespace dealii;
using namespace Talus;

namespace
{
  using Strain = SymmetricTensor<2, 3>;

  std::unique_ptr<J2Law> make_law(const std::string &entries)
  {
    auto parameters = Parameters::from_text("subsection J2\n" + entries + "end\n");
    auto law        = std::make_unique<J2Law>("/J2");
    parameters.parse();
    return law;
  }

  Strain diagonal(const double xx, const double yy, const double zz)
  {
    Strain strain;
    strain[0][0] = xx;
    strain[1][1] = yy;
    strain[2][2] = zz;
    return strain;
  }

  /** Strain paths whose deviator keeps its direction: one step is exact. */
  void check_radial_paths(const Test::Hardening &hardening)
  {
    const auto law = make_law(hardening.entries());
    Strain     shear;
    shear[0][1]                                  = .5;
    const std::pair<std::string, Strain> paths[] = {{"uniaxial", diagonal(1., 0., 0.)},
                                                    {"simple shear", shear},
                                                    {"biaxial", diagonal(1., 1., 0.)},
                                                    {"isochoric", diagonal(1., -1., 0.)}};
    for (const auto &[name, direction] : paths)
    {
      double       error = 0., alpha_error = 0.;
      J2Law::State state;
      for (const double size : {.001, .02, .05, .3})
      {
        // q_trial = 2 G sqrt(3/2) |dev strain|
        const double q_trial  = 2. * Test::G * std::sqrt(1.5) * deviator(size * direction).norm();
        const double alpha    = hardening.alpha(q_trial, 3. * Test::G);
        const double q        = q_trial - 3. * Test::G * alpha;
        const auto   response = law->respond(size * direction, state);
        const Strain exact    = Test::K * trace(size * direction) * unit_symmetric_tensor<3>() +
                             q / q_trial * 2. * Test::G * deviator(size * direction);
        error       = std::max(error, (response.stress - exact).norm() / exact.norm());
        alpha_error = std::max(alpha_error, std::abs(response.state.alpha - alpha));
        state       = response.state;
      }
      Test::check(hardening.name + " " + name + ": stress", error, 1e-13);
      Test::check(hardening.name + " " + name + ": equivalent plastic strain", alpha_error, 1e-14);
    }
  }

  /** A path with corners: consistency, flow without volume, elastic unloading. */
  void check_corners(const Test::Hardening &hardening)
  {
    const auto   law = make_law(hardening.entries());
    J2Law::State state;
    Strain       strain;
    double       excess = 0., volume = 0., normality = 0.;
    const Strain corners[] = {diagonal(.03, -.01, 0.), diagonal(-.02, .05, .01), diagonal(.04, .04, -.06)};
    for (Strain corner : corners)
    {
      corner[0][2] = .02;
      corner[1][2] = -corner[0][0];
      for (unsigned int n = 0; n < 5; ++n)
      {
        strain += .2 * corner;
        const auto   response = law->respond(strain, state);
        const Strain s = deviator(response.stress), flow = response.state.plastic_strain - state.plastic_strain;
        excess = std::max(excess, std::sqrt(1.5) * s.norm() / law->yield_stress(response.state.alpha) - 1.);
        volume = std::max(volume, std::abs(trace(response.state.plastic_strain)));
        // Flow has the stress's direction, and sqrt(2/3) of its norm adds up to alpha.
        normality = std::max(normality, std::abs(flow * s - flow.norm() * s.norm()) / s.norm());
        normality =
          std::max(normality, std::abs(std::sqrt(2. / 3.) * flow.norm() - response.state.alpha + state.alpha));
        state = response.state;
      }
    }
    Test::check_true(hardening.name + " corners: it yields", state.alpha > .1);
    Test::check(hardening.name + " corners: stress beyond the yield surface", std::max(excess, 0.), 1e-13);
    Test::check(hardening.name + " corners: plastic volume", volume, 1e-15);
    Test::check(hardening.name + " corners: flow along the stress", normality, 1e-15);

    const Strain before = law->respond(strain, state).stress, back = -1e-4 * before / before.norm();
    const auto   after  = law->respond(strain + back, state);
    const Strain change = Test::K * trace(back) * unit_symmetric_tensor<3>() + 2. * Test::G * deviator(back);
    Test::check(hardening.name + " unloading is elastic", (after.stress - before - change).norm() / change.norm(),
                1e-11);
    Test::check(hardening.name + " unloading: no flow", after.state.alpha - state.alpha, 1e-16);
  }

  /** Central differences with steps d err by (d/strain)^2 and round-off/d: 1e-8 and 1e-11 of the tangent here. */
  void check_tangent(const Test::Hardening &hardening)
  {
    const auto   law   = make_law(hardening.entries());
    const double d     = 1e-6;
    Strain       first = diagonal(.03, -.01, .005), second = diagonal(.01, .03, -.02);
    first[0][1]        = .01;
    second[0][2]       = -.02;
    second[1][2]       = .03;
    const auto yielded = law->respond(first, {}).state;
    const auto compare = [&](const std::string &name, const Strain &strain, const J2Law::State &state) {
      const auto tangent = law->tangent(strain, state);
      double     error   = 0.;
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = i; j < 3; ++j)
        {
          Strain change;
          change[i][j] = d;
          const Strain by_step =
            (law->respond(strain + change, state).stress - law->respond(strain - change, state).stress) / (2. * d);
          error = std::max(error, (tangent * change / d - by_step).norm() / (2. * Test::G));
        }
      Test::check(hardening.name + " tangent, " + name, error, 1e-7);
    };
    compare("elastic", 1e-3 * first, {});
    compare("first yield", first, {});
    compare("after a corner", second, yielded);
    compare("unloading", .9 * first, yielded);
  }

  void check_error(const std::string &part, const std::string &entry, const std::string &value,
                   const std::string &others = "")
  {
    bool holds = false;
    try
    {
      make_law(others + Test::set(entry, value));
    }
    catch (const InputError &error)
    {
      holds = error.message.find(part) != std::string::npos;
    }
    Test::check_true(entry + " = " + value, holds);
  }
} // namespace

void j2_law()
{
  for (const auto &hardening : Test::hardenings())
  {
    check_radial_paths(hardening);
    check_corners(hardening);
    check_tangent(hardening);
  }
  check_error("must be positive", "Young's modulus", "0");
  check_error("between -1 and 0.5", "Poisson's ratio", "0.5");
  check_error("must be positive", "Yield stress", "-1");
  check_error("must not be negative", "Hardening modulus", "-1");
  check_error("must not be negative", "Residual yield stress", "-1");
  check_error("must be positive", "Reference strain", "0");
  check_error("falls so steeply", "Reference strain", "0.0008", Test::set("Hardening", "exponential"));
}

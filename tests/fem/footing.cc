#include "check.h"
#include "plastic.h"

using namespace dealii;
using namespace Talus;

namespace
{
  const double cohesion = 1e4, half_width = .5;

  /**
   * The strip footing of the benchmarks: half of it on a body of 5 x 5, rough, pressed down by 0.4 mm. Nodes
   * x <= B/2 of the surface move, the last of them included. Returns Q/(c B) = R_y/(c B/2) at the end.
   */
  double bearing_capacity(const unsigned int n, const unsigned int n_steps, const std::string &integration)
  {
    const std::string sides = Test::condition("sides", "0, 1", "0; 0", "x"),
                      floor = Test::condition("bottom", "2", "0; 0"),
                      foot  = "  subsection footing\n" + Test::set("Lower corner", "0, 5") +
                             Test::set("Upper corner", "0.5, 5") + Test::set("Displacement", "0; -4e-3*t") + "  end\n";
    const std::string soil = "  subsection J2\n" + Test::set("Young's modulus", "1e9") +
                             Test::set("Poisson's ratio", ".333") +
                             Test::set("Yield stress", std::to_string(std::sqrt(3.) * cohesion)) + "  end\n";
    auto reference = Test::make<PlasticReference<2>>(
      Test::set("Cells", Test::repeat<2>(std::to_string(n))) + Test::set("Upper corner", "5, 5") +
      Test::set("Steps", std::to_string(n_steps)) + Test::set("Integration", integration) + soil +
      Test::conditions("sides, bottom, footing", sides + floor + foot));
    reference->solve(.1);
    return reference->force("footing")[1] / (cohesion * half_width);
  }
} // namespace

/** On 20 x 20 cells: full integration carries more, and an upper bound theorem's 2 + pi is exceeded by both. */
void locking()
{
  const double b_bar = bearing_capacity(20, 4, "B-bar"), full = bearing_capacity(20, 4, "full");
  Test::check_range("h = .25, B-bar", b_bar, 2. + numbers::PI, 6.);
  Test::check_range("h = .25, full integration over B-bar", full / b_bar, 1.05, 1.5);
}

/** Values of a second, own FEM code. The plateau is the mechanism's and does not depend on the steps. */
void footing() { Test::check_range("h = .1, B-bar", bearing_capacity(50, 5, "B-bar"), 5.291 * .995, 5.291 * 1.005); }

void long_footing()
{
  Test::check_range("h = .1, full integration locks", bearing_capacity(50, 10, "full"), 5.645 * .995, 5.645 * 1.005);
  const double fine = bearing_capacity(50, 10, "B-bar");
  Test::check_range("h = .1, B-bar, 10 steps", fine, 5.291 * .995, 5.291 * 1.005);
  Test::check_range("h = .05, B-bar", bearing_capacity(100, 10, "B-bar"), 5.218 * .995, 5.218 * 1.005);
}

#include "check.h"
#include "plastic.h"

#include <deal.II/grid/grid_generator.h>

using namespace dealii;
using namespace Talus;

namespace
{
  const double a = 1., b = 2.;

  /** Limit pressure of a thick-walled cylinder in plane strain, widened from inside, on a quarter of it. */
  double limit_pressure(const unsigned int n_refinements)
  {
    auto cylinder = Test::make<PlasticReference<2>>(
      Test::set("Steps", "5") + Test::hardenings()[0].section() +
      Test::conditions("inner, left, bottom",
                       Test::condition("inner", "0", "t*x/sqrt(x*x + y*y); t*y/sqrt(x*x + y*y)") +
                         Test::condition("left", "2", "0; 0", "x") + Test::condition("bottom", "3", "0; 0", "y")));
    cylinder->set_mesh([&](auto &triangulation) {
      GridGenerator::quarter_hyper_shell(triangulation, Point<2>(), a, b, 0, true);
      triangulation.refine_global(n_refinements);
    });
    cylinder->solve(.5 * a);
    // The pressure's resultant over a quarter of the circle.
    Test::check("both components alike", cylinder->force("inner")[0] / cylinder->force("inner")[1] - 1., 1e-8);
    return -cylinder->force("inner")[0] / a;
  }
} // namespace

void cylinder()
{
  const double exact = 2. / std::sqrt(3.) * Test::Y * std::log(b / a);
  // Q2 elements: the limit load, an integral, converges with order 4.
  const double coarse = limit_pressure(1) / exact - 1., fine = limit_pressure(2) / exact - 1.;
  Test::check("limit pressure", fine, 2e-5);
  Test::check_range("order of the limit pressure", std::log2(coarse / fine), 3.6, 4.2);
}

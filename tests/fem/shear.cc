#include "check.h"
#include "reference.h"

using namespace dealii;

/** A unit square between rough plates, the upper one moved by 1e-4; sides free. Values of a second, own FEM code. */
void shear()
{
  const double E = 1e9, nu = .333;
  // The figures hold for 80 cells; argument TALUS_SHEAR_CELLS is for convergence studies.
  const char *const n         = std::getenv("TALUS_SHEAR_CELLS");
  auto              reference = Test::make_reference<2>(
    Test::set("Cells", Test::repeat<2>(n ? n : "80")) +
    Test::conditions("bottom, top", Test::condition("bottom", "2", "0; 0") + Test::condition("top", "3", "1e-4; 0")));
  reference->set_moduli(E / 3 / (1 - 2 * nu), E / 2 / (1 + nu));
  reference->solve(0.);
  const auto stress = reference->stress({Point<2>(.5, .5), Point<2>(.5, .01), Point<2>(.2, .7)});
  const auto top = reference->force("top"), bottom = reference->force("bottom");
  Test::check_range("force on the moved plate", top[0], -25914 * 1.0005, -25914 * .9995);
  Test::check("force on the fixed plate is opposite", (bottom[0] + top[0]) / top[0], 1e-9);
  Test::check_range("shear stress in the middle", stress[0][0][1], 38122 - 5, 38122 + 5);
  Test::check_range("shear stress at the plate", stress[1][0][1], 26350 - 30, 26350 + 30);
  // On the line x = .5 these vanish by symmetry.
  const double in_plane = stress[2][0][0] + stress[2][1][1];
  Test::check("plane strain", stress[2][2][2] / (nu * in_plane) - 1., 1e-9);
}

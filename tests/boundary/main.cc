#include "../check.h"

#define DECLARE(name)                                                                                                  \
  template <int dim>                                                                                                   \
  void name();
DECLARE(kinds)
DECLARE(symmetry)
DECLARE(order)
DECLARE(friction)
DECLARE(interval)
DECLARE(damping)
DECLARE(ghosts)
DECLARE(ghosts_damped)
DECLARE(boundary_errors)

int main(int argc, char **argv)
{
  return Test::run(argc, argv,
                   {{"kinds 2D", kinds<2>},
                    {"kinds 3D", kinds<3>},
                    {"symmetry 2D", symmetry<2>},
                    {"symmetry 3D", symmetry<3>},
                    {"order 2D", order<2>},
                    {"order 3D", order<3>},
                    {"friction 2D", friction<2>},
                    {"friction 3D", friction<3>},
                    {"interval 2D", interval<2>},
                    {"interval 3D", interval<3>},
                    {"damping 2D", damping<2>},
                    {"damping 3D", damping<3>},
                    {"ghosts 2D", ghosts<2>},
                    {"ghosts 3D", ghosts<3>},
                    {"ghosts, damping 2D", ghosts_damped<2>},
                    {"ghosts, damping 3D", ghosts_damped<3>},
                    {"errors 2D", boundary_errors<2>},
                    {"errors 3D", boundary_errors<3>}});
}

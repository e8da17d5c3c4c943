#include "../check.h"

#define DECLARE(name)                                                                                                  \
  template <int dim>                                                                                                   \
  void name();
DECLARE(vibration)
DECLARE(ring_expansion)
DECLARE(vortex)
DECLARE(solution_errors)

int main(int argc, char **argv)
{
  return Test::run(argc, argv,
                   {{"vibration 2D", vibration<2>},
                    {"vibration 3D", vibration<3>},
                    {"ring expansion 2D", ring_expansion<2>},
                    {"ring expansion 3D", ring_expansion<3>},
                    {"vortex 2D", vortex<2>},
                    {"vortex 3D", vortex<3>},
                    {"errors 2D", solution_errors<2>},
                    {"errors 3D", solution_errors<3>}});
}

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
DECLARE(obstacles)
DECLARE(obstacle_at_wall)
DECLARE(obstacle_account)
DECLARE(ghosts_and_obstacle)
DECLARE(boundary_errors)
void obstacle_held_and_rough();

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
                    {"obstacles 2D", obstacles<2>},
                    {"obstacles 3D", obstacles<3>},
                    {"obstacle at a wall 2D", obstacle_at_wall<2>},
                    {"obstacle at a wall 3D", obstacle_at_wall<3>},
                    {"obstacle, held and rough", obstacle_held_and_rough},
                    {"obstacle with account 2D", obstacle_account<2>},
                    {"obstacle with account 3D", obstacle_account<3>},
                    {"ghosts and obstacle 2D", ghosts_and_obstacle<2>},
                    {"ghosts and obstacle 3D", ghosts_and_obstacle<3>},
                    {"errors 2D", boundary_errors<2>},
                    {"errors 3D", boundary_errors<3>}});
}

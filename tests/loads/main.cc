#include "../check.h"

void barrier();
void nearest_points();
#define DECLARE(name)                                                                                                  \
  template <int dim>                                                                                                   \
  void name();
DECLARE(contact_surfaces)
DECLARE(contact_bounce)
DECLARE(contact_slope)
DECLARE(contact_container)
DECLARE(contact_errors)

int main(int argc, char **argv)
{
  return Test::run(argc, argv,
                   {{"barrier", barrier},
                    {"nearest points", nearest_points},
                    {"contact surfaces 2D", contact_surfaces<2>},
                    {"contact surfaces 3D", contact_surfaces<3>},
                    {"contact: bounce 2D", contact_bounce<2>},
                    {"contact: bounce 3D", contact_bounce<3>},
                    {"contact: slope 2D", contact_slope<2>},
                    {"contact: slope 3D", contact_slope<3>},
                    {"contact: container 2D", contact_container<2>},
                    {"contact: container 3D", contact_container<3>},
                    {"contact: errors 2D", contact_errors<2>},
                    {"contact: errors 3D", contact_errors<3>}});
}

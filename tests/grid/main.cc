#include "../check.h"

#define DECLARE(name)                                                                                                  \
  template <int dim>                                                                                                   \
  void name();
DECLARE(nodes)
DECLARE(tables)
DECLARE(boundary_nodes)
DECLARE(exchange)
DECLARE(layers)
DECLARE(coverage)
DECLARE(velocity_update)
DECLARE(walls)
DECLARE(activity)
DECLARE(grid_errors)
void closed_surfaces();
void surface_files();
void surface_errors();

int main(int argc, char **argv)
{
  return Test::run(argc, argv,
                   {{"nodes 2D", nodes<2>},
                    {"nodes 3D", nodes<3>},
                    {"tables 2D", tables<2>},
                    {"tables 3D", tables<3>},
                    {"boundary nodes 2D", boundary_nodes<2>},
                    {"boundary nodes 3D", boundary_nodes<3>},
                    {"exchange 2D", exchange<2>},
                    {"exchange 3D", exchange<3>},
                    {"layers 2D", layers<2>},
                    {"layers 3D", layers<3>},
                    {"coverage 2D", coverage<2>},
                    {"coverage 3D", coverage<3>},
                    {"velocity update 2D", velocity_update<2>},
                    {"velocity update 3D", velocity_update<3>},
                    {"activity 2D", activity<2>},
                    {"walls 2D", walls<2>},
                    {"walls 3D", walls<3>},
                    {"activity 3D", activity<3>},
                    {"errors 2D", grid_errors<2>},
                    {"errors 3D", grid_errors<3>},
                    {"closed surfaces", closed_surfaces},
                    {"surface files", surface_files},
                    {"surface errors", surface_errors}});
}

#include "../check.h"

#define DECLARE(name)                                                                                                  \
  template <int dim>                                                                                                   \
  void name();
DECLARE(lattice)
DECLARE(numbers_of_points)
DECLARE(round_bodies)
DECLARE(point_file)
DECLARE(initial_state)
DECLARE(hydrostatic)
DECLARE(deformed)
DECLARE(body_errors)
DECLARE(synchronise)
DECLARE(far_away)
DECLARE(beyond_ghost_cells)
DECLARE(lost)
DECLARE(drift)
DECLARE(outside)
DECLARE(unknown_nodes)
DECLARE(balance)
DECLARE(home)
DECLARE(surfaces)
DECLARE(half_edges_of_shapes)
DECLARE(ring)
DECLARE(ring_errors)
DECLARE(clipped)
DECLARE(on_grid_lines)
DECLARE(on_faces)
DECLARE(edge_volumes)
DECLARE(shifted_lattices)
DECLARE(overlaps)
DECLARE(joined_regions)
DECLARE(where)
void point_table();
void bodies_from_surfaces();
void polygons();
void polygon_faces();
void rasters();
void wrong_regions();
void named_columns();

namespace
{
  const std::vector<Test::Case> cases = {{"point table", point_table},
                                         {"edge volumes 2D", edge_volumes<2>},
                                         {"edge volumes 3D", edge_volumes<3>},
                                         {"shifted lattices 2D", shifted_lattices<2>},
                                         {"shifted lattices 3D", shifted_lattices<3>},
                                         {"overlaps 2D", overlaps<2>},
                                         {"overlaps 3D", overlaps<3>},
                                         {"on grid lines 2D", on_grid_lines<2>},
                                         {"on grid lines 3D", on_grid_lines<3>},
                                         {"on faces 2D", on_faces<2>},
                                         {"on faces 3D", on_faces<3>},
                                         {"lattice 2D", lattice<2>},
                                         {"lattice 3D", lattice<3>},
                                         {"numbers of points 2D", numbers_of_points<2>},
                                         {"numbers of points 3D", numbers_of_points<3>},
                                         {"round bodies 2D", round_bodies<2>},
                                         {"round bodies 3D", round_bodies<3>},
                                         {"point file 2D", point_file<2>},
                                         {"point file 3D", point_file<3>},
                                         {"initial state 2D", initial_state<2>},
                                         {"initial state 3D", initial_state<3>},
                                         {"hydrostatic 2D", hydrostatic<2>},
                                         {"hydrostatic 3D", hydrostatic<3>},
                                         {"deformed 2D", deformed<2>},
                                         {"deformed 3D", deformed<3>},
                                         {"errors 2D", body_errors<2>},
                                         {"errors 3D", body_errors<3>},
                                         {"synchronise 2D", synchronise<2>},
                                         {"synchronise 3D", synchronise<3>},
                                         {"far away 2D", far_away<2>},
                                         {"far away 3D", far_away<3>},
                                         {"beyond ghost cells 2D", beyond_ghost_cells<2>},
                                         {"beyond ghost cells 3D", beyond_ghost_cells<3>},
                                         {"lost 2D", lost<2>},
                                         {"lost 3D", lost<3>},
                                         {"drift 2D", drift<2>},
                                         {"drift 3D", drift<3>},
                                         {"outside 2D", outside<2>},
                                         {"outside 3D", outside<3>},
                                         {"unknown nodes 2D", unknown_nodes<2>},
                                         {"unknown nodes 3D", unknown_nodes<3>},
                                         {"balance 2D", balance<2>},
                                         {"balance 3D", balance<3>},
                                         {"home 2D", home<2>},
                                         {"home 3D", home<3>},
                                         {"surfaces 2D", surfaces<2>},
                                         {"surfaces 3D", surfaces<3>},
                                         {"half edges 2D", half_edges_of_shapes<2>},
                                         {"half edges 3D", half_edges_of_shapes<3>},
                                         {"ring 2D", ring<2>},
                                         {"ring 3D", ring<3>},
                                         {"ring errors 2D", ring_errors<2>},
                                         {"ring errors 3D", ring_errors<3>},
                                         {"clip to grid 2D", clipped<2>},
                                         {"clip to grid 3D", clipped<3>},
                                         {"bodies from surfaces", bodies_from_surfaces},
                                         {"polygons", polygons},
                                         {"faces of polygons", polygon_faces},
                                         {"joined regions 2D", joined_regions<2>},
                                         {"joined regions 3D", joined_regions<3>},
                                         {"where 2D", where<2>},
                                         {"where 3D", where<3>},
                                         {"rasters", rasters},
                                         {"wrong regions", wrong_regions},
                                         {"named columns", named_columns}};
}

int main(int argc, char **argv) { return Test::run(argc, argv, cases); }

#include "../check.h"

#define DECLARE(name)                                                                                                  \
  template <int dim>                                                                                                   \
  void name();
DECLARE(tables)
DECLARE(partition)
DECLARE(reproduction)
DECLARE(continuity)
DECLARE(ablation)
DECLARE(true_gradient)
DECLARE(held)
DECLARE(mirrors)
DECLARE(folded_layers)
DECLARE(mesh_file)
DECLARE(location)
DECLARE(many_particles)
DECLARE(parts)
DECLARE(moving_between_parts)
DECLARE(generated_mesh)
DECLARE(f_bar_on_a_mesh)
DECLARE(particles_on_a_mesh)
DECLARE(transfers_on_a_mesh)
DECLARE(shares_on_a_mesh)
void mesh_grid_errors();
void parts_errors();
void many_moves_between_parts();
void wrong_meshes();
void line();

int main(int argc, char **argv)
{
  return Test::run(argc, argv,
                   {{"tables 1D", tables<1>},
                    {"tables 2D", tables<2>},
                    {"tables 3D", tables<3>},
                    {"partition 1D", partition<1>},
                    {"partition 2D", partition<2>},
                    {"partition 3D", partition<3>},
                    {"reproduction 2D", reproduction<2>},
                    {"reproduction 3D", reproduction<3>},
                    {"continuity 1D", continuity<1>},
                    {"continuity 2D", continuity<2>},
                    {"continuity 3D", continuity<3>},
                    {"ablation 2D", ablation<2>},
                    {"ablation 3D", ablation<3>},
                    {"true gradient 1D", true_gradient<1>},
                    {"true gradient 2D", true_gradient<2>},
                    {"true gradient 3D", true_gradient<3>},
                    {"line", line},
                    {"held 2D", held<2>},
                    {"held 3D", held<3>},
                    {"mirrors 2D", mirrors<2>},
                    {"mirrors 3D", mirrors<3>},
                    {"folded layers 2D", folded_layers<2>},
                    {"folded layers 3D", folded_layers<3>},
                    {"mesh file 2D", mesh_file<2>},
                    {"mesh file 3D", mesh_file<3>},
                    {"wrong meshes", wrong_meshes},
                    {"location 2D", location<2>},
                    {"location 3D", location<3>},
                    {"parts 2D", parts<2>},
                    {"parts 3D", parts<3>},
                    {"moving between parts 2D", moving_between_parts<2>},
                    {"moving between parts 3D", moving_between_parts<3>},
                    {"parts: errors", parts_errors},
                    {"generated mesh 2D", generated_mesh<2>},
                    {"generated mesh 3D", generated_mesh<3>},
                    {"F-bar on a mesh 2D", f_bar_on_a_mesh<2>},
                    {"F-bar on a mesh 3D", f_bar_on_a_mesh<3>},
                    {"particles on a mesh 2D", particles_on_a_mesh<2>},
                    {"particles on a mesh 3D", particles_on_a_mesh<3>},
                    {"transfers on a mesh 2D", transfers_on_a_mesh<2>},
                    {"transfers on a mesh 3D", transfers_on_a_mesh<3>},
                    {"shares on a mesh 2D", shares_on_a_mesh<2>},
                    {"shares on a mesh 3D", shares_on_a_mesh<3>},
                    {"mesh grid: errors", mesh_grid_errors},
                    {"long: many particles 3D", many_particles<3>},
                    {"long: many moves between parts 3D", many_moves_between_parts}});
}

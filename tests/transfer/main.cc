#include "../check.h"

#define DECLARE(name)                                                                                                  \
  template <int dim>                                                                                                   \
  void name();
DECLARE(mass_and_momentum)
DECLARE(angular_momentum_of_apic)
DECLARE(affine_in_the_interior)
DECLARE(affine_at_walls)
DECLARE(affine_drive)
DECLARE(flip_keeps_velocity)
DECLARE(flip_after_condition)
DECLARE(filter)
DECLARE(motion)
DECLARE(nodal_force)
DECLARE(batched_and_plain)
DECLARE(batched_and_plain_slip)
DECLARE(domains_and_lists)
DECLARE(wall_shear)
DECLARE(slip_conservation)
DECLARE(projection_definition)
DECLARE(projection_elsewhere)
DECLARE(mirror_and_whole)
DECLARE(mirror_reaction)
DECLARE(smoothing)
DECLARE(stretched_fluid)
DECLARE(traction_sums)
DECLARE(traction_work)
DECLARE(traction_errors)
DECLARE(imls_on_a_lattice)
DECLARE(imls_domains)
DECLARE(cpls_affine)
DECLARE(cpls_momentum)
DECLARE(averaging)
DECLARE(f_bar)
void imls_at_a_node();

#define BOTH(name, function)                                                                                           \
  {name " 2D", function<2>}, { name " 3D", function<3> }

int main(int argc, char **argv)
{
  return Test::run(argc, argv,
                   {{"IMLS at a node", imls_at_a_node},
                    BOTH("IMLS on a lattice", imls_on_a_lattice),
                    BOTH("IMLS: domains", imls_domains),
                    BOTH("CPLS: affine velocity", cpls_affine),
                    BOTH("CPLS: momentum", cpls_momentum),
                    BOTH("mass and momentum", mass_and_momentum),
                    BOTH("angular momentum of APIC", angular_momentum_of_apic),
                    BOTH("affine in the interior", affine_in_the_interior),
                    BOTH("affine at walls", affine_at_walls),
                    BOTH("affine drive", affine_drive),
                    BOTH("FLIP keeps velocity", flip_keeps_velocity),
                    BOTH("FLIP after condition", flip_after_condition),
                    BOTH("filter", filter),
                    BOTH("motion", motion),
                    BOTH("nodal force", nodal_force),
                    BOTH("batched and plain", batched_and_plain),
                    BOTH("batched and plain, slip", batched_and_plain_slip),
                    BOTH("domains and lists", domains_and_lists),
                    BOTH("wall shear", wall_shear),
                    BOTH("slip: conservation", slip_conservation),
                    BOTH("slip projection: definition", projection_definition),
                    BOTH("slip projection: elsewhere", projection_elsewhere),
                    BOTH("mirror and whole", mirror_and_whole),
                    BOTH("mirror: reaction", mirror_reaction),
                    BOTH("smoothing of J", smoothing),
                    BOTH("averaging", averaging),
                    BOTH("F-bar", f_bar),
                    BOTH("stretched fluid", stretched_fluid),
                    BOTH("traction sums", traction_sums),
                    BOTH("traction work", traction_work),
                    BOTH("traction errors", traction_errors)});
}

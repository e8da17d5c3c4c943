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

int main(int argc, char **argv)
{
  return Test::run(argc, argv,
                   {{"IMLS at a node", imls_at_a_node},
                    {"IMLS on a lattice 2D", imls_on_a_lattice<2>},
                    {"IMLS on a lattice 3D", imls_on_a_lattice<3>},
                    {"IMLS: domains 2D", imls_domains<2>},
                    {"IMLS: domains 3D", imls_domains<3>},
                    {"CPLS: affine velocity 2D", cpls_affine<2>},
                    {"CPLS: affine velocity 3D", cpls_affine<3>},
                    {"CPLS: momentum 2D", cpls_momentum<2>},
                    {"CPLS: momentum 3D", cpls_momentum<3>},
                    {"mass and momentum 2D", mass_and_momentum<2>},
                    {"mass and momentum 3D", mass_and_momentum<3>},
                    {"angular momentum of APIC 2D", angular_momentum_of_apic<2>},
                    {"angular momentum of APIC 3D", angular_momentum_of_apic<3>},
                    {"affine in the interior 2D", affine_in_the_interior<2>},
                    {"affine in the interior 3D", affine_in_the_interior<3>},
                    {"affine at walls 2D", affine_at_walls<2>},
                    {"affine at walls 3D", affine_at_walls<3>},
                    {"affine drive 2D", affine_drive<2>},
                    {"affine drive 3D", affine_drive<3>},
                    {"FLIP keeps velocity 2D", flip_keeps_velocity<2>},
                    {"FLIP keeps velocity 3D", flip_keeps_velocity<3>},
                    {"FLIP after condition 2D", flip_after_condition<2>},
                    {"FLIP after condition 3D", flip_after_condition<3>},
                    {"filter 2D", filter<2>},
                    {"filter 3D", filter<3>},
                    {"motion 2D", motion<2>},
                    {"motion 3D", motion<3>},
                    {"nodal force 2D", nodal_force<2>},
                    {"nodal force 3D", nodal_force<3>},
                    {"batched and plain 2D", batched_and_plain<2>},
                    {"batched and plain 3D", batched_and_plain<3>},
                    {"batched and plain, slip 2D", batched_and_plain_slip<2>},
                    {"batched and plain, slip 3D", batched_and_plain_slip<3>},
                    {"domains and lists 2D", domains_and_lists<2>},
                    {"domains and lists 3D", domains_and_lists<3>},
                    {"wall shear 2D", wall_shear<2>},
                    {"wall shear 3D", wall_shear<3>},
                    {"slip: conservation 2D", slip_conservation<2>},
                    {"slip: conservation 3D", slip_conservation<3>},
                    {"slip projection: definition 2D", projection_definition<2>},
                    {"slip projection: definition 3D", projection_definition<3>},
                    {"slip projection: elsewhere 2D", projection_elsewhere<2>},
                    {"slip projection: elsewhere 3D", projection_elsewhere<3>},
                    {"mirror and whole 2D", mirror_and_whole<2>},
                    {"mirror and whole 3D", mirror_and_whole<3>},
                    {"mirror: reaction 2D", mirror_reaction<2>},
                    {"mirror: reaction 3D", mirror_reaction<3>},
                    {"smoothing of J 2D", smoothing<2>},
                    {"smoothing of J 3D", smoothing<3>},
                    {"averaging 2D", averaging<2>},
                    {"averaging 3D", averaging<3>},
                    {"F-bar 2D", f_bar<2>},
                    {"F-bar 3D", f_bar<3>},
                    {"stretched fluid 2D", stretched_fluid<2>},
                    {"stretched fluid 3D", stretched_fluid<3>},
                    {"traction sums 2D", traction_sums<2>},
                    {"traction sums 3D", traction_sums<3>},
                    {"traction work 2D", traction_work<2>},
                    {"traction work 3D", traction_work<3>},
                    {"traction errors 2D", traction_errors<2>},
                    {"traction errors 3D", traction_errors<3>}});
}

#include "../check.h"

void uniaxial_strain();
void simple_shear();
void constant_spin();
void constant_rotation();
void superposed_rotation();
void tangent();
void energy_and_wave_speed();
void plane_strain();
void parameter_errors();

namespace hooke
{
  void uniaxial_and_general();
}
namespace neo_hookean
{
  void uniaxial_strain();
  void simple_shear();
  void energy_and_stress();
  void objectivity();
  void wave_speed();
} // namespace neo_hookean

namespace von_mises_test
{
  void uniaxial_strain();
  void pure_shear();
  void yield_surface_and_dissipation();
  void plane_strain_limit();
  void plane_strain();
  void parameter_errors();
} // namespace von_mises_test

namespace hencky
{
  void uniaxial_strain();
  void simple_shear();
  void isochoric();
  void return_map();
  void energy();
  void objectivity();
  void initial_stress();
  void wave_speed();
  void plane_strain();
  void parameter_errors();
} // namespace hencky

namespace drucker_prager
{
  void uniaxial_strain();
  void pure_shear();
  void returns();
  void tension();
  void no_friction();
  void biaxial_test();
  void plane_strain();
  void parameter_errors();
} // namespace drucker_prager

namespace mohr_coulomb
{
  void uniaxial_compression();
  void uniaxial_extension();
  void pure_shear();
  void returns();
  void tension();
  void no_friction();
  void biaxial_test();
  void softening();
  void dissipation();
  void plane_strain();
  void parameter_errors();
} // namespace mohr_coulomb

namespace gap
{
  void uniaxial_strain();
  void cohesive();
  void dilation();
  void invariants();
  void frames();
  void forgotten();
} // namespace gap

namespace newtonian_fluid
{
  void uniaxial_strain();
  void simple_shear();
  void no_memory();
  void plane_strain();
  void energy();
  void numbers();
  void parameter_errors();
} // namespace newtonian_fluid

namespace objectivity
{
  void constant_rotation();
  void superposed_rotation();
  void constant_spin();
} // namespace objectivity

void batches();

namespace strength_reduction
{
  void strengths();
  void errors();
} // namespace strength_reduction

namespace softening_slip
{
  void energy();
  void errors();
} // namespace softening_slip

namespace
{
  std::vector<Test::Case> elastic_laws()
  {
    return {{"linear elastic: uniaxial strain", uniaxial_strain},
            {"linear elastic: simple shear", simple_shear},
            {"linear elastic: constant spin", constant_spin},
            {"linear elastic: constant rotation", constant_rotation},
            {"linear elastic: superposed rotation", superposed_rotation},
            {"linear elastic: tangent", tangent},
            {"linear elastic: energy and wave speed", energy_and_wave_speed},
            {"linear elastic: plane strain", plane_strain},
            {"linear elastic: parameter errors", parameter_errors},
            {"Hooke: uniaxial strain, and any", hooke::uniaxial_and_general},
            {"neo-Hookean: uniaxial strain", neo_hookean::uniaxial_strain},
            {"neo-Hookean: simple shear", neo_hookean::simple_shear},
            {"neo-Hookean: energy and stress", neo_hookean::energy_and_stress},
            {"neo-Hookean: objectivity", neo_hookean::objectivity},
            {"neo-Hookean: wave speed", neo_hookean::wave_speed}};
  }

  std::vector<Test::Case> plastic_laws()
  {
    return {{"von Mises: uniaxial strain", von_mises_test::uniaxial_strain},
            {"von Mises: pure shear", von_mises_test::pure_shear},
            {"von Mises: yield surface and dissipation", von_mises_test::yield_surface_and_dissipation},
            {"von Mises: plane strain limit", von_mises_test::plane_strain_limit},
            {"von Mises: plane strain", von_mises_test::plane_strain},
            {"von Mises: parameter errors", von_mises_test::parameter_errors},
            {"Hencky: uniaxial strain", hencky::uniaxial_strain},
            {"Hencky: simple shear", hencky::simple_shear},
            {"Hencky: isochoric", hencky::isochoric},
            {"Hencky: return map", hencky::return_map},
            {"Hencky: energy", hencky::energy},
            {"Hencky: objectivity", hencky::objectivity},
            {"Hencky: initial stress", hencky::initial_stress},
            {"Hencky: wave speed", hencky::wave_speed},
            {"Hencky: plane strain", hencky::plane_strain},
            {"Hencky: parameter errors", hencky::parameter_errors},
            {"Drucker-Prager: uniaxial strain", drucker_prager::uniaxial_strain},
            {"Drucker-Prager: pure shear", drucker_prager::pure_shear},
            {"Drucker-Prager: returns", drucker_prager::returns},
            {"Drucker-Prager: tension", drucker_prager::tension},
            {"Drucker-Prager: no friction", drucker_prager::no_friction},
            {"Drucker-Prager: biaxial test", drucker_prager::biaxial_test},
            {"Drucker-Prager: plane strain", drucker_prager::plane_strain},
            {"Drucker-Prager: parameter errors", drucker_prager::parameter_errors},
            {"Mohr-Coulomb: uniaxial compression", mohr_coulomb::uniaxial_compression},
            {"Mohr-Coulomb: uniaxial extension", mohr_coulomb::uniaxial_extension},
            {"Mohr-Coulomb: pure shear", mohr_coulomb::pure_shear},
            {"Mohr-Coulomb: returns", mohr_coulomb::returns},
            {"Mohr-Coulomb: tension", mohr_coulomb::tension},
            {"Mohr-Coulomb: no friction", mohr_coulomb::no_friction},
            {"Mohr-Coulomb: biaxial test", mohr_coulomb::biaxial_test},
            {"Mohr-Coulomb: softening", mohr_coulomb::softening},
            {"Mohr-Coulomb: dissipation", mohr_coulomb::dissipation},
            {"Mohr-Coulomb: plane strain", mohr_coulomb::plane_strain},
            {"Mohr-Coulomb: parameter errors", mohr_coulomb::parameter_errors},
            {"gap: uniaxial strain", gap::uniaxial_strain},
            {"gap: with cohesion", gap::cohesive},
            {"gap: dilation", gap::dilation},
            {"gap: invariants", gap::invariants},
            {"gap: frames", gap::frames},
            {"gap: switched off", gap::forgotten}};
  }

  std::vector<Test::Case> fluids_and_all_laws()
  {
    return {{"Newtonian fluid: uniaxial strain", newtonian_fluid::uniaxial_strain},
            {"Newtonian fluid: simple shear", newtonian_fluid::simple_shear},
            {"Newtonian fluid: no memory", newtonian_fluid::no_memory},
            {"Newtonian fluid: plane strain", newtonian_fluid::plane_strain},
            {"Newtonian fluid: energy", newtonian_fluid::energy},
            {"Newtonian fluid: numbers", newtonian_fluid::numbers},
            {"Newtonian fluid: parameter errors", newtonian_fluid::parameter_errors},
            {"softening slip: energy", softening_slip::energy},
            {"strength reduction", strength_reduction::strengths},
            {"strength reduction: errors", strength_reduction::errors},
            {"softening slip: errors", softening_slip::errors},
            {"all laws: constant rotation", objectivity::constant_rotation},
            {"all laws: superposed rotation", objectivity::superposed_rotation},
            {"all laws: constant spin", objectivity::constant_spin},
            {"all laws: batches", batches}};
  }
} // namespace

int main(int argc, char **argv)
{
  std::vector<Test::Case> cases;
  for (const auto &part : {elastic_laws(), plastic_laws(), fluids_and_all_laws()})
    cases.insert(cases.end(), part.begin(), part.end());
  return Test::run(argc, argv, cases);
}

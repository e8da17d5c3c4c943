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

int main(int argc, char **argv)
{
  return Test::run(argc, argv,
                   {{"linear elastic: uniaxial strain", uniaxial_strain},
                    {"linear elastic: simple shear", simple_shear},
                    {"linear elastic: constant spin", constant_spin},
                    {"linear elastic: constant rotation", constant_rotation},
                    {"linear elastic: superposed rotation", superposed_rotation},
                    {"linear elastic: tangent", tangent},
                    {"linear elastic: energy and wave speed", energy_and_wave_speed},
                    {"linear elastic: plane strain", plane_strain},
                    {"linear elastic: parameter errors", parameter_errors}});
}

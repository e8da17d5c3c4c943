#include "../check.h"

void sweep();
template <int dim>
void sound_state();
template <int dim>
void broken_limits();
template <int dim>
void edge();
template <int dim>
void explicit_steps();
template <int dim>
void courant_numbers();
template <int dim>
void strays();
template <int dim>
void musl_definition();
template <int dim>
void musl_momentum();
template <int dim>
void locking();
template <int dim>
void musl_energy();
template <int dim>
void droplet();
template <int dim>
void energy_account();

int main(int argc, char **argv)
{
  return Test::run(argc, argv,
                   {{"sweep", sweep},
                    {"watch: a sound state, 2D", sound_state<2>},
                    {"watch: a sound state, 3D", sound_state<3>},
                    {"watch: limits, 2D", broken_limits<2>},
                    {"watch: limits, 3D", broken_limits<3>},
                    {"watch: at the edge, 2D", edge<2>},
                    {"watch: at the edge, 3D", edge<3>},
                    {"explicit steps, 2D", explicit_steps<2>},
                    {"explicit steps, 3D", explicit_steps<3>},
                    {"Courant numbers, 2D", courant_numbers<2>},
                    {"Courant numbers, 3D", courant_numbers<3>},
                    {"strays, 2D", strays<2>},
                    {"strays, 3D", strays<3>},
                    {"MUSL: definition, 2D", musl_definition<2>},
                    {"MUSL: definition, 3D", musl_definition<3>},
                    {"MUSL: momentum, 2D", musl_momentum<2>},
                    {"MUSL: momentum, 3D", musl_momentum<3>},
                    {"MUSL: energy, 2D", musl_energy<2>},
                    {"MUSL: energy, 3D", musl_energy<3>},
                    {"locking, 2D", locking<2>},
                    {"locking, 3D", locking<3>},
                    {"droplet above a sea, 2D", droplet<2>},
                    {"droplet above a sea, 3D", droplet<3>},
                    {"energy account, 2D", energy_account<2>},
                    {"energy account, 3D", energy_account<3>}});
}

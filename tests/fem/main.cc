#include "check.h"

void manufactured();
void convergence();
void affine();
void forces();
void ranks();
void shear();
void errors();
void j2_law();
void cell_strains();
void plastic_element();
void plastic_newton();
void cylinder();
void locking();
void dynamic();
void dynamic_errors();
void footing();
void long_footing();

int main(int argc, char **argv)
{
  return Test::run(argc, argv,
                   {{"manufactured", manufactured},
                    {"convergence", convergence},
                    {"affine", affine},
                    {"forces", forces},
                    {"ranks", ranks},
                    {"shear", shear},
                    {"errors", errors},
                    {"j2 law", j2_law},
                    {"cell strains", cell_strains},
                    {"plastic element", plastic_element},
                    {"plastic newton", plastic_newton},
                    {"cylinder", cylinder},
                    {"locking", locking},
                    {"dynamic", dynamic},
                    {"dynamic errors", dynamic_errors},
                    {"long: footing h = .1", footing},
                    {"long: footings", long_footing}});
}

#include "check.h"

void manufactured();
void convergence();
void affine();
void forces();
void ranks();
void shear();
void errors();

int main(int argc, char **argv)
{
  return Test::run(argc, argv,
                   {{"manufactured", manufactured},
                    {"convergence", convergence},
                    {"affine", affine},
                    {"forces", forces},
                    {"ranks", ranks},
                    {"shear", shear},
                    {"errors", errors}});
}

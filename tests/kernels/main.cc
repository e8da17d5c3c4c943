#include "../check.h"

template <int dim>
void reproduction();
template <int dim>
void steffen();
template <int dim>
void gradient_of_weight();
template <int dim>
void continuity();
template <int dim>
void definition();
template <int dim>
void closed_form();
template <int dim>
void cpdi();
void negative_weights();
void polynomials();

int main(int argc, char **argv)
{
  return Test::run(argc, argv,
                   {{"reproduction 2D", reproduction<2>},
                    {"reproduction 3D", reproduction<3>},
                    {"Steffen 2D", steffen<2>},
                    {"Steffen 3D", steffen<3>},
                    {"gradient of weight 2D", gradient_of_weight<2>},
                    {"gradient of weight 3D", gradient_of_weight<3>},
                    {"continuity 2D", continuity<2>},
                    {"continuity 3D", continuity<3>},
                    {"definition 2D", definition<2>},
                    {"definition 3D", definition<3>},
                    {"closed form 2D", closed_form<2>},
                    {"closed form 3D", closed_form<3>},
                    {"CPDI 2D", cpdi<2>},
                    {"CPDI 3D", cpdi<3>},
                    {"negative weights", negative_weights},
                    {"polynomials", polynomials}});
}

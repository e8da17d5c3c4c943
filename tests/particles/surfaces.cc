#include "../setup.h"

using namespace Test;
using namespace dealii;

/** A closed surface: sum of dA is zero, sum of x . dA is dim times the volume, on any number of points. */
template <int dim>
void surfaces()
{
  const double pi = numbers::PI;
  struct Kind
  {
    std::string shape, entries;
    double      volume;
  };
  const std::string       centre = set("Centre", coordinates<dim>({{0.4, 0.5, 0.45}}));
  const std::vector<Kind> kinds  = {{"box",
                                     set("Lower corner", coordinates<dim>({{0.2, 0.3, 0.25}})) +
                                       set("Upper corner", coordinates<dim>({{0.7, 0.6, 0.8}})),
                                     0.15 * (dim == 2 ? 1 : 0.55)},
                                    {"ball", centre + set("Radius", "0.3"), dim == 2 ? 0.09 * pi : 0.036 * pi},
                                    {"cylinder", centre + set("Radius", "0.2") + set("Height", "0.3") + set("Axis", "x"),
                                    dim == 2 ? 0.12 : 0.012 * pi}};
  for (const auto &kind : kinds)
    for (const double spacing : {0.02, 0.09})
    {
      Setup<dim> setup(section("Grid", set("Spacing", "0.125")) + body_text(set("Shape", kind.shape) + kind.entries));
      SurfaceSpacing<dim> spacings;
      for (unsigned int d = 0; d < dim; ++d)
        spacings[d] = spacing * (1 + 0.2 * d);
      Tensor<1, dim> area;
      double         volume = 0;
      const auto    &shape  = *setup.bodies[0]->shape;
      for (const auto &face : shape.face_names())
        for (const auto &point : shape.face(face, spacings))
        {
          area += point.area;
          volume += point.area * point.x / dim;
        }
      check(kind.shape + ": closed", area.norm(), 1e-14);
      check(kind.shape + ": volume", volume - kind.volume, 1e-14);
    }
}

template void surfaces<2>();
template void surfaces<3>();

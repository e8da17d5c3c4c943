#include "../surfaces.h"

#include "../setup.h"

using namespace Test;
using namespace dealii;

/** Bodies that closed surfaces hold: numbers and volumes of particles, and their faces. */
namespace
{
  /** A grid from -1 to 1 of 16 cells per direction. */
  template <int dim>
  std::string text(const std::string &file, const std::string &more = "")
  {
    return section("Grid", set("Lower corner", coordinates<dim>({{-1, -1, -1}})) + set("Spacing", "0.125")) +
           body_text(set("Shape", "surface") + set("File", file) + more);
  }

  template <int dim>
  double total_volume(const Setup<dim> &setup)
  {
    double result = 0;
    for (unsigned int p = 0; p < setup.particles.size(); ++p)
      result += setup.particles.component(setup.particles.volume, 0)[p];
    return sum(result);
  }

  /** Whether all particles lie where they should. */
  template <int dim, class Inside>
  bool are_all(const Setup<dim> &setup, const Inside &is_inside)
  {
    bool result = true;
    for (unsigned int p = 0; p < setup.particles.size(); ++p)
      result = result && is_inside(setup.position(p));
    return result;
  }
} // namespace

/** A cube, of which every particle is known, a ball and a torus to the error of the sampling; holes in polygons. */
void bodies_from_surfaces()
{
  const double      pi    = numbers::PI;
  const std::string dense = set("Particles per cell and direction", "4");
  {
    const TemporaryFile file(".stl", stl_binary(box_surface(Point<3>(-4, -4, -4), Point<3>(4, 4, 4), 3)));
    Setup<3>            setup(text<3>(file.name, set("Scale", "0.125") + set("Shift", "0.25, 0, 0") + dense));
    check("cube: number", setup.particles.n_global / (32. * 32 * 32) - 1, 0.);
    check("cube: volume", total_volume(setup) - 1, 1e-13);
  }
  {
    const TemporaryFile    file(".stl", stl_text(sphere_surface(Point<3>(), 0.7, 16)));
    Setup<3>               setup(text<3>(file.name, dense));
    const auto             r       = [](const Point<3> &x) { return x.norm() < 0.7; };
    const ClosedSurface<3> surface = read_surface<3>(file.name, 1, {});
    check("ball: volume", total_volume(setup) / surface.volume() - 1, 2e-3);
    check("ball: of a sphere", total_volume(setup) / (4. / 3 * pi * 0.343) - 1, 2. / (16 * 16));
    check_true("ball: inside", are_all(setup, r));

    // What carries tractions: area, no net area, and the volume by the divergence theorem.
    Tensor<1, 3> spacing, net;
    for (unsigned int d = 0; d < 3; ++d)
      spacing[d] = 0.05;
    double area = 0, volume = 0, longest = 0;
    for (const auto &point : setup.bodies[0]->shape->face("surface", spacing))
    {
      area += point.area.norm();
      net += point.area;
      volume += point.x * point.area / 3;
      longest = std::max(longest, point.area.norm());
    }
    check("ball: area", area / (4 * pi * 0.49) - 1, 5e-3);
    check("ball: net area", net.norm(), 1e-14);
    check("ball: volume of its faces", volume / surface.volume() - 1, 1e-13);
    check_range("ball: largest part over its bound", longest / (0.5 * 3 * 0.05 * 0.05), 0.05, 1.);
  }
  {
    const TemporaryFile file(".stl", stl_binary(torus_surface(Point<3>(), 0.6, 0.25, 64)));
    Setup<3>            setup(text<3>(file.name, dense));
    check("torus: volume", total_volume(setup) / (2 * pi * pi * 0.6 * 0.0625) - 1, 5e-3);
    check_true("torus: inside", are_all(setup, [](const Point<3> &x) {
                 return std::hypot(std::hypot(x[0], x[1]) - 0.6, x[2]) < 0.25 + 0.35 * (1 - std::cos(numbers::PI / 64));
               }));
  }
  {
    // A square of side 1 with a square hole of a quarter of the area, aligned with the lattice.
    const TemporaryFile file("", "-.5 -.5\n.5 -.5\n.5 .5\n-.5 .5\n-.5 -.5\n"
                                 "-.25 -.25\n-.25 .25\n.25 .25\n.25 -.25\n-.25 -.25\n");
    Setup<2>            setup(text<2>(file.name, dense));
    check("polygons: number", setup.particles.n_global / (32. * 32 - 16 * 16) - 1, 0.);
    check("polygons: area", total_volume(setup) - 0.75, 1e-13);
  }
  {
    const TemporaryFile file(".stl", stl_text(Corners(3)));
    check_error<EntryError>("no extent", {"/Bodies/body: File", file.name, "is empty"},
                            [&] { Setup<3> bad(text<3>(file.name)); });
    check_error<EntryError>("scale", {"/Bodies/body: Scale", "must be positive"},
                            [&] { Setup<3> bad(text<3>(file.name, set("Scale", "0"))); });
  }
}

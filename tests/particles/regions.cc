#include "../surfaces.h"
#include "bodies.h"

#include <iomanip>
#include <sstream>

using namespace Test;
using namespace dealii;

/** Regions of all kinds against their volumes in closed form. */
namespace
{
  std::string on_wide_grid(const unsigned int dim, const std::string &body)
  {
    return section("Grid", set("Upper corner", dim == 2 ? "4, 4" : "4, 4, 4") + set("Spacing", "0.25")) +
           body_text(body);
  }

  template <int dim>
  double volume_of(const std::string &body)
  {
    const Setup<dim> setup(on_wide_grid(dim, body));
    return total(setup, setup.particles.volume);
  }

  /** The volume of a region, the moments of its particles' volumes, and whether all lie inside. */
  template <int dim, class Inside>
  void check_region(const std::string &name, const std::string &body, const double expected, const double bound,
                    const Inside &is_inside)
  {
    const Setup<dim> setup(on_wide_grid(dim, body));
    bool             all = true;
    for (unsigned int p = 0; p < setup.particles.size(); ++p)
      all = all && is_inside(setup.position(p));
    check(name + ": volume", total(setup, setup.particles.volume) / expected - 1, bound);
    check_true(name + ": particles inside", all);
  }

  /** A region's text, in a subsection of another. */
  std::string part(const std::string &name, const std::string &text) { return section(name, text); }

  const std::string corners = "0.5, 0.5; 3.5, 0.5; 3.5, 1.4; 1.9, 1.4; 1.9, 3.3; 0.5, 3.3"; // an L

  double area_of_l() { return 3 * 0.9 + 1.4 * 1.9; }
} // namespace

/** Polygons: whole, sloping, re-entrant, either way round; the sampled volumes are right to 1 %. */
void polygons()
{
  const auto        in_l    = [](const Point<2> &x) { return x[1] < 1.4 || x[0] < 1.9; };
  const std::string polygon = set("Shape", "polygon");
  // An edge across boxes is known to half a sample, a sixteenth of a box of .125; two of 1.6 and 1.9 lie so.
  const double sampled = 0.125 / 16 * (1.6 + 1.9) / area_of_l();
  check_region<2>("L", polygon + set("Corners", corners), area_of_l(), sampled, in_l);
  check_region<2>("L, other way",
                  polygon + set("Corners", "0.5, 3.3; 1.9, 3.3; 1.9, 1.4; 3.5, 1.4; 3.5, 0.5; 0.5, 0.5"), area_of_l(),
                  sampled, in_l);
  check_region<2>("L, sections of the lattice whole",
                  polygon + set("Corners", "0.5, 0.5; 3.5, 0.5; 3.5, 1.5; 2, 1.5; 2, 3; 0.5, 3"), 3 + 1.5 * 1.5, 1e-12,
                  [](const Point<2> &x) { return x[1] < 1.5 || x[0] < 2; });
  check_region<2>("triangle", polygon + set("Corners", "0.3, 0.4; 3.6, 0.9; 1.2, 3.1"), 0.5 * (3.3 * 2.7 - 0.5 * 0.9),
                  0.01, [](const Point<2> &x) { return x[1] > 0.4; });
  // A star: five tips of 0.5 and 1.8 around (2, 2), 20 triangles of which each has an angle of 36 degrees at the
  // middle.
  std::string star;
  for (unsigned int k = 0; k < 10; ++k)
  {
    const double r = k % 2 == 0 ? 1.8 : 0.7, a = numbers::PI * k / 5 + 0.1;
    star += (k > 0 ? "; " : "") + std::to_string(2 + r * std::cos(a)) + ", " + std::to_string(2 + r * std::sin(a));
  }
  check_region<2>("star", polygon + set("Corners", star), 10 * 0.5 * 1.8 * 0.7 * std::sin(numbers::PI / 5), 0.01,
                  [](const Point<2> &x) { return x.distance(Point<2>(2, 2)) < 1.8; });

  for (const char axis : {'x', 'y', 'z'})
  {
    const unsigned int a = axis - 'x';
    check_region<3>(std::string("prism along ") + axis,
                    polygon + set("Corners", corners) + set("Axis", std::string(1, axis)) + set("Ends", "0.5, 2.25") +
                      set("Particles per cell and direction", "2"),
                    area_of_l() * 1.75, 0.01, [a](const Point<3> &x) {
                      const double u = x[a == 0 ? 1 : 0], v = x[a == 2 ? 1 : 2];
                      return x[a] > 0.5 && x[a] < 2.25 && (v < 1.4 || u < 1.9);
                    });
  }
}

/** What polygons offer loads: length and normal of each edge, and no net area. */
void polygon_faces()
{
  const Setup<2>                    setup(on_wide_grid(2, set("Shape", "polygon") + set("Corners", corners)));
  const Shape<2>                   &shape    = *setup.bodies[0]->shape;
  const auto                        names    = shape.face_names();
  const std::array<Tensor<1, 2>, 6> expected = {
    {Point<2>(0, -3), Point<2>(0.9, 0), Point<2>(0, 1.6), Point<2>(1.9, 0), Point<2>(0, 1.4), Point<2>(-2.8, 0)}};
  double error = 0;
  check_true("six edges", names.size() == 6);
  for (unsigned int k = 0; k < 6; ++k)
  {
    Tensor<1, 2> area;
    for (const auto &point : shape.face(names[k], Point<2>(0.1, 0.1)))
      area += point.area;
    raise(error, (area - expected[k]).norm());
  }
  check("edges: outward areas", error, 1e-12);
}

template <int dim>
void joined_regions()
{
  const auto two_boxes = [](const std::string &kind, const std::string &a, const std::string &b, const std::string &c,
                            const std::string &d) {
    return set("Shape", kind) + set("Names", "one, two") +
           part("one", set("Lower corner", a) + set("Upper corner", b)) +
           part("two", set("Lower corner", c) + set("Upper corner", d));
  };
  const std::string z0 = dim == 2 ? "" : ", 0.5", z1 = dim == 2 ? "" : ", 1.5";
  // Boxes that overlap, on lines of the lattice: whole boxes, exact.
  const auto boxes = [&](const std::string &kind) {
    return two_boxes(kind, "0.5, 0.5" + z0, "2, 2" + z1, "1, 1" + z0, "3, 3" + z1);
  };
  check("union of boxes", volume_of<dim>(boxes("union")) - (2.25 + 4 - 1), 1e-12);
  check("intersection of boxes", volume_of<dim>(boxes("intersection")) - 1, 1e-12);
  check("difference of boxes", volume_of<dim>(boxes("difference")) - (2.25 - 1), 1e-12);
  // Two that share a face are one box without a seam.
  check("boxes side by side",
        volume_of<dim>(two_boxes("union", "0.5, 0.5" + z0, "1.6, 1.5" + z1, "1.6, 0.5" + z0, "2.5, 1.5" + z1)) - 2,
        1e-12);

  const std::string centre = dim == 2 ? "2, 2" : "2, 2, 2";
  Point<dim>        middle;
  for (unsigned int d = 0; d < dim; ++d)
    middle[d] = 2;
  const double R = 1.1, ball = dim == 2 ? numbers::PI * R * R : 4. / 3 * numbers::PI * R * R * R,
               box        = dim == 2 ? 9 : 27;
  const std::string whole = part("one", set("Lower corner", coordinates<dim>({{0.5, 0.5, 0.5}})) +
                                          set("Upper corner", coordinates<dim>({{3.5, 3.5, 3.5}})));
  const std::string round =
    part("two", set("Shape", "ball") + set("Centre", centre) + set("Radius", std::to_string(R)));
  check_region<dim>("box with a hole", set("Shape", "difference") + set("Names", "one, two") + whole + round,
                    box - ball, 0.005, [&](const Point<dim> &x) { return x.distance(middle) >= R; });
  // Within another: the shell between two balls, cut to a half.
  const std::string inner = part("two", set("Shape", "ball") + set("Centre", centre) + set("Radius", "0.6"));
  const std::string outer = part("one", set("Shape", "ball") + set("Centre", centre) + set("Radius", "1.7"));
  const std::string shell = set("Shape", "difference") + set("Names", "one, two") + outer + inner;
  const double      full =
    dim == 2 ? numbers::PI * (1.7 * 1.7 - 0.36) : 4. / 3 * numbers::PI * (std::pow(1.7, 3) - std::pow(0.6, 3));
  check_region<dim>("half a shell",
                    set("Shape", "intersection") + set("Names", "shell, left") + part("shell", shell) +
                      part("left", set("Lower corner", coordinates<dim>({{0, 0, 0}})) +
                                     set("Upper corner", dim == 2 ? "2, 4" : "2, 4, 4")),
                    full / 2, 0.01, [](const Point<dim> &x) { return x[0] < 2; });
}

/** Formulas: a wavy layer and what lies above it fill a box together; lists of points; boxes that are shifted. */
template <int dim>
void where()
{
  const std::string up   = dim == 2 ? "y" : "z";
  const std::string low  = set("Lower corner", coordinates<dim>({{0.5, 0.5, 0.5}})),
                    high = set("Upper corner", coordinates<dim>({{3.5, 3.5, 3.5}}));
  const std::string wave = "1.7 + 0.6 * sin(2 * pi / 3 * (x - 0.5))";
  const double      box = dim == 2 ? 9 : 27, below = box * 1.2 / 3;
  const auto height = [](const Point<dim> &x) { return 1.7 + 0.6 * std::sin(2 * numbers::PI / 3 * (x[0] - 0.5)); };
  check_region<dim>("below a wave", low + high + set("Where", up + " < " + wave), below, 0.005,
                    [&](const Point<dim> &x) { return x[dim - 1] < height(x); });
  check_region<dim>("above a wave", low + high + set("Where", up + " >= " + wave), box - below, 0.005,
                    [&](const Point<dim> &x) { return x[dim - 1] >= height(x); });
  const double moved = volume_of<dim>(low + high + set("Where", up + " < " + wave) +
                                      set("Lattice offset", coordinates<dim>({{0.3, -0.4, 0.2}})));
  check("shifted", moved / below - 1, dim == 2 ? 0.005 : 0.01);
  check("all of it", volume_of<dim>(low + high + set("Where", "1")) - volume_of<dim>(low + high), 1e-10);

  if (dim == 2)
  {
    const TemporaryFile file(".txt", "1 1 0.5\n2 2 0.25\n3 1 0.125\n");
    check("points", volume_of<2>(set("Shape", "points") + set("File", file.name) + set("Where", "x > 1.5")) - 0.375,
          0.);
    const std::string ring = set("Shape", "ring") + set("Centre", "2, 2") + set("Inner radius", "0.5") +
                             set("Outer radius", "1.5") + set("Particles", "8, 120");
    check("half a ring", volume_of<2>(ring + set("Where", "y > 2")) / (numbers::PI * (2.25 - 0.25) / 2) - 1, 1e-12);
  }
}

/** Ground below heights: a plane, a paraboloid on another; scale, both ways to give the origin. */
void rasters()
{
  const auto file_of = [](const std::string &head, const unsigned int nx, const unsigned int ny, const auto &height) {
    std::ostringstream text;
    text << "ncols " << nx << "\nNROWS " << ny << '\n'
         << head << "cellsize 0.5\nNODATA_value -1e4\n"
         << std::setprecision(17);
    for (unsigned int j = ny; j-- > 0;)
      for (unsigned int i = 0; i < nx; ++i)
        text << height(0.5 * i, 0.5 * j) << (i + 1 == nx ? '\n' : ' ');
    return text.str();
  };
  const auto          plane = [](const double x, const double y) { return 1 + 0.4 * x + 0.2 * y; };
  const TemporaryFile flat(".asc", file_of("xllcenter 0\nyllcenter 0\n", 9, 9, plane));
  const std::string   raster = set("Shape", "raster") + set("File", flat.name),
                    half     = set("Particles per cell and direction", "2");
  check_region<3>("plane",
                  raster + set("Bottom", "0.5") + set("Lower corner", "1, 0.5") + set("Upper corner", "3, 2.5") + half,
                  4 * (plane(2, 1.5) - 0.5), 0.005, [&](const Point<3> &x) { return x[2] < plane(x[0], x[1]); });
  const auto bowl = [](const double x, const double y) { return 0.5 + 0.05 * ((x - 2) * (x - 2) + (y - 2) * (y - 2)); };
  const TemporaryFile base(".asc", file_of("xllcorner -0.25\nyllcorner -0.25\n", 9, 9, bowl));
  // Bilinear between heights 0.5 apart: x^2 is too large by h^2/6 on average.
  const double mean = 0.5 + 0.05 * 2 * (4. / 3 + 0.25 / 6);
  check_region<3>("between two", raster + set("Bottom file", base.name) + half, 16 * (plane(2, 2) - mean), 0.005,
                  [&](const Point<3> &x) { return x[2] > bowl(x[0], x[1]) - 0.1 && x[2] < plane(x[0], x[1]); });
  check("scale",
        volume_of<3>(raster + set("Scale", "0.5") + set("Bottom", "0") + half) / (0.125 * 16 * plane(2, 2)) - 1, 0.005);

  const auto wrong = [&](const std::string &name, const std::string &text, const std::string &more,
                         const std::string &words) {
    const TemporaryFile file(".asc", text);
    check_error<EntryError>(
      name, {words}, [&] { Setup<3> setup(on_wide_grid(3, set("Shape", "raster") + set("File", file.name) + more)); });
  };
  const std::string good = file_of("xllcenter 0\nyllcenter 0\n", 9, 9, plane);
  wrong("no head", "1 2 3\n4 5 6\n", "", "cellsize");
  wrong("too few heights", good.substr(0, good.rfind(' ')), "", "of 81 heights");
  wrong("too many heights", good + "1 2\n", "", "more heights than the 9 x 9");
  wrong("a word", good.substr(0, good.size() - 5) + "x\n", "", "is no number");
  wrong("does not cover", good, set("Lower corner", "-1, 0") + set("Upper corner", "2, 2"), "do not cover");
  wrong("a gap",
        file_of("xllcenter 0\nyllcenter 0\n", 9, 9,
                [&](double x, double y) { return x == 1 && y == 2 ? -1e4 : plane(x, y); }),
        "", "has no height at x = 1, y = 2");
  wrong("a base above", good, set("Bottom", "1.5"), "lies above the surface at x = 0, y = 0");
}

/** What is refused, each by its entry. */
void wrong_regions()
{
  const auto wrong = [](const std::string &name, const std::string &body, const std::string &words) {
    check_error<EntryError>(name, {words}, [&] { Setup<2> setup(on_wide_grid(2, body)); });
  };
  const std::string polygon = set("Shape", "polygon");
  wrong("two corners", polygon + set("Corners", "1, 1; 2, 1"), "three corners or more");
  wrong("crossing edges", polygon + set("Corners", "1, 1; 3, 3; 3, 1; 1, 3"),
        "crosses itself: the edge from (1, 1) to (3, 3)");
  wrong("a corner twice", polygon + set("Corners", "1, 1; 3, 1; 2, 2; 3, 3; 1, 3; 2, 2"), "is not closed");
  wrong("no extent", polygon + set("Corners", "1, 1; 2, 2; 3, 3"), "holds no volume");
  wrong("one part", set("Shape", "union") + set("Names", "one") + part("one", ""), "two regions or more");
  wrong("nothing in common",
        set("Shape", "intersection") + set("Names", "one, two") + part("one", set("Upper corner", "1, 1")) +
          part("two", set("Lower corner", "2, 2") + set("Upper corner", "3, 3")),
        "no point in common");
  wrong("raster in 2D", set("Shape", "raster") + set("File", "a.asc"), "In 2D take a 'polygon'");
  wrong("formula of t", set("Where", "x < t"), "leave out t");
  wrong("two formulas", set("Where", "x < 1; y < 1"), "join several with &&");
  wrong("no formula", set("Where", "x <"), "cannot understand");
  if (Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) == 1) // a program ends all ranks when one has an error
    wrong("no value", set("Where", "sqrt(x - 9) > 0 ? 1 : 1 / (x - x)"), "no finite value");
  wrong("nowhere", set("Where", "x > 9"), "empty");
}
template void joined_regions<2>();
template void joined_regions<3>();
template void where<2>();
template void where<3>();

#include "../surfaces.h"

#include "../setup.h"

using namespace Test;
using namespace dealii;

namespace
{
  const double pi = numbers::PI;

  /** Numbers in the box from -2 to 2 without a pattern. */
  template <int dim>
  Point<dim> some_point(const unsigned int n)
  {
    Point<dim> x;
    for (unsigned int d = 0; d < dim; ++d)
      x[d] = 2 * hashed_jitter(5, n, d);
    return x;
  }

  std::string polygon(const std::vector<Point<2>> &corners)
  {
    std::ostringstream text;
    text << std::setprecision(17);
    for (const auto &x : corners)
      text << x << '\n';
    text << corners.front() << '\n';
    return text.str();
  }
} // namespace

/** Volumes in closed form, points in and out against formulas, on corners' and edges' lines too; turned, and holes. */
void closed_surfaces()
{
  const Corners          corners = box_surface(Point<3>(-1, -0.5, 0), Point<3>(1, 0.75, 2), 4);
  const ClosedSurface<3> box(corners, "box");
  check("box: volume", box.volume() / (2 * 1.25 * 2) - 1, 1e-14);
  check("box: vertices", box.vertices.size(), 98.);
  check_true("box: all vertices", box.vertices.size() == 98 && box.faces.size() == 192);
  unsigned int wrong = 0;
  for (unsigned int n = 0; n < 4000; ++n)
  {
    Point<3> x = some_point<3>(n);
    if (n % 2 == 0) // on lines through vertices and edges
      for (unsigned int d = 0; d < 3; ++d)
        x[d] = 0.25 * std::round(4 * x[d]) + (d == 0 ? 0.01 : 0);
    if (n % 2 == 0 && (std::abs(x[1] - 0.125) == 0.625 || x[2] == 0 || x[2] == 2))
      continue; // on the surface
    const bool is_inside = std::abs(x[0]) < 1 && x[1] > -0.5 && x[1] < 0.75 && x[2] > 0 && x[2] < 2;
    wrong += box.contains(x) != is_inside;
  }
  check("box: points on the wrong side", wrong, 0.);

  for (const unsigned int n : {8, 16})
  {
    const ClosedSurface<3> ball(sphere_surface(Point<3>(0.3, 0, -0.1), 1.5, n), "ball");
    check_range("ball, n = " + std::to_string(n) + ": volume missing times n^2",
                n * n * (1 - ball.volume() / (4. / 3 * pi * std::pow(1.5, 3))), 0.3, 2.);
    const ClosedSurface<3> torus(torus_surface(Point<3>(0, 0, 0), 1.2, 0.4, 4 * n), "torus");
    check_range("torus, n = " + std::to_string(n) + ": volume missing times n^2",
                n * n * (1 - torus.volume() / (2 * pi * pi * 1.2 * 0.16)), 0.3, 2.);
    wrong = 0;
    for (unsigned int k = 0; k < 4000; ++k)
    {
      const Point<3> x = some_point<3>(k);
      const double   r = x.distance(Point<3>(0.3, 0, -0.1)), s = std::hypot(std::hypot(x[0], x[1]) - 1.2, x[2]);
      // Between the polyhedron and the surface nothing is said.
      wrong += ball.contains(x) != (r < 1.5) && (r > 1.5 || r < 1.5 * (1 - 1. / n / n));
      wrong += torus.contains(x) != (s < 0.4) && (s > 0.4 || s < 0.4 * (1 - 1. / n / n) - 0.1 / n / n);
    }
    check("ball and torus, n = " + std::to_string(n) + ": points on the wrong side", wrong, 0.);
  }

  // Seen from inside, and with a hole in it whose parts are turned as those of a body.
  Corners turned = corners;
  for (unsigned int c = 0; c < turned.size(); c += 3)
    std::swap(turned[c], turned[c + 1]);
  check("turned: volume", ClosedSurface<3>(turned, "box").volume() / 5 - 1, 1e-14);
  Corners       hollow = turned;
  const Corners hole   = box_surface(Point<3>(-0.5, 0, 0.5), Point<3>(0.5, 0.5, 1));
  hollow.insert(hollow.end(), hole.begin(), hole.end());
  const ClosedSurface<3> shell(hollow, "shell");
  check("hollow: volume", shell.volume() / (5 - 0.25) - 1, 1e-14);
  check_true("hollow: in the hole",
             !shell.contains(Point<3>(0.1, 0.2, 0.7)) && shell.contains(Point<3>(0.1, 0.2, 1.2)));
  for (const auto &face : shell.faces)
  {
    Point<3> middle;
    for (const unsigned int v : face)
      middle += shell.vertices[v] / 3.;
    const auto n = shell.area(face) / shell.area(face).norm();
    wrong += shell.contains(middle + 1e-3 * n) || !shell.contains(middle - 1e-3 * n);
  }
  check("hollow: normals that point inwards", wrong, 0.);
}

/** Files that say the same in text and in bytes, scaled and moved; polygons in 2D. */
void surface_files()
{
  const Corners       corners = sphere_surface(Point<3>(0.25, -0.5, 1), 0.75, 6);
  const TemporaryFile text(".stl", stl_text(corners)), binary(".stl", stl_binary(corners));
  Tensor<1, 3>        shift;
  shift[2]                 = -4;
  const ClosedSurface<3> a = read_surface<3>(text.name, 2, shift), b = read_surface<3>(binary.name, 2, shift);
  const double           wanted = 8 * ClosedSurface<3>(corners, "").volume();
  check("text: volume", a.volume() / wanted - 1, 1e-14);
  check("binary: volume", b.volume() / wanted - 1, 1e-6);
  check("as many vertices", 1. * a.vertices.size() - b.vertices.size(), 0.);
  check("moved", b.bounding_box().center().distance(Point<3>(0.5, -1, -2)), 1e-6);

  // A star with a hole; corners on the lines of others.
  const TemporaryFile star(
    "", "# a diamond with a hole\n" + polygon({Point<2>(1, 0), Point<2>(0, 1), Point<2>(-1, 0), Point<2>(0, -1)}) +
          "\n" + polygon({Point<2>(0.25, 0), Point<2>(0, 0.25), Point<2>(-0.25, 0), Point<2>(0, -0.25)}));
  const auto surface = read_surface<2>(star.name, 1, {});
  check("polygons: area", surface.volume() - (2 - 0.125), 1e-15);
  unsigned int wrong = 0;
  for (unsigned int n = 0; n < 4000; ++n)
  {
    Point<2> x = some_point<2>(n);
    if (n % 2 == 0)
      x[1] = 0.25 * std::round(4 * x[1]);
    const double sum = std::abs(x[0]) + std::abs(x[1]);
    wrong += surface.contains(x) != (sum < 1 && sum > 0.25);
  }
  check("polygons: points on the wrong side", wrong, 0.);
}

/** What is wrong with a surface is said by name and place. */
void surface_errors()
{
  const auto refuse = [](const std::string &name, const std::vector<std::string> &parts, const std::string &content) {
    const TemporaryFile file(".stl", content);
    check_error<InputError>(name, parts, [&] { read_surface<3>(file.name, 1, {}); });
  };
  const Corners whole = box_surface(Point<3>(), Point<3>(1, 1, 1));
  Corners       open(whole.begin() + 3, whole.end()), turned = whole, branched = whole;
  std::swap(turned[0], turned[1]);
  branched.insert(branched.end(), {whole[0], whole[1], Point<3>(7, 7, 7)});
  refuse("open", {"not closed", "3 edges belong to one triangle", "(0, 0, 0)"}, stl_text(open));
  refuse("open, binary", {"not closed"}, stl_binary(open));
  refuse("turned", {"turned against each other", "unify"}, stl_text(turned));
  refuse("branched", {"branches", "3 triangles"}, stl_text(branched));
  refuse("empty", {"is empty"}, "solid nothing\nendsolid\n");
  refuse("no STL", {"is no STL file", "84 bytes instead of"}, "some text of whatever kind");
  std::string broken = stl_text(whole);
  refuse("cut", {":14: the facet that ends here has not three"}, broken.substr(0, broken.find("vertex ", 200)) + "\n");
  refuse("no number", {":4: 'nan' is not a finite number"}, broken.replace(broken.find("vertex "), 8, "vertex nan"));
  check_error<InputError>("no file", {"cannot read 'nothing.stl'"}, [] { read_surface<3>("nothing.stl", 1, {}); });
  const TemporaryFile polygon("", "0 0\n1 0\n\n1 1\n");
  check_error<InputError>("open polygon", {"not closed", "begins in line 1 at (0, 0) ends at (1, 1)"},
                          [&] { read_surface<2>(polygon.name, 1, {}); });
  const TemporaryFile touching("", "0 0\n1 0\n1 1\n0 0\n2 2\n3 2\n3 3\n1 1\n2 2\n");
  check_error<InputError>("polygons that touch", {"at the corner (1, 1) end 2 edges and begin 2"},
                          [&] { read_surface<2>(touching.name, 1, {}); });
}

#include <talus/loads/barrier.h>
#include <talus/grid/contact_surface.h>
#include <talus/grid/nearest.h>

#include "../surfaces.h"

#include "../setup.h"

using namespace Test;
using namespace dealii;

/** Derivatives by differences, twice continuous at the reach, and the pressure at half of it. */
void barrier()
{
  const Barrier barrier{0.3};
  double        slope_error = 0, curvature_error = 0, least = 1;
  for (const double d : {0.003, 0.02, 0.1, 0.2, 0.29, 0.2999})
  {
    const double step = 1e-4 * std::min(d, 0.3 - d);
    raise(slope_error, ((barrier.value(d + step) - barrier.value(d - step)) / (2 * step) - barrier.slope(d)) / 0.3);
    raise(curvature_error, ((barrier.slope(d + step) - barrier.slope(d - step)) / (2 * step) - barrier.curvature(d)) /
                             barrier.curvature(d));
    least = std::min({least, -barrier.slope(d), barrier.curvature(d), barrier.value(d)});
  }
  check("slope", slope_error, 1e-6);
  check("curvature", curvature_error, 1e-6);
  check_true("it repels", least > 0);
  check("value at the reach", barrier.value(0.3 * (1 - 1e-6)), 1e-17);
  check("slope at the reach", barrier.slope(0.3 * (1 - 1e-6)), 1e-11);
  check("curvature at the reach", barrier.curvature(0.3 * (1 - 1e-6)), 1e-5);
  check("beyond", barrier.value(0.31) + barrier.slope(0.3) + barrier.curvature(7), 0.);
  check("pressure", -barrier.stiffness(7) * barrier.slope(0.15) - 7, 1e-14);
  check("friction", friction_share(0.5) - 0.75, 1e-16);
  check("full friction", friction_share(1) + friction_share(3) - 2, 1e-16);
  check("no slip", friction_share(0), 0.);
}

namespace
{
  Point<3> some_point(const unsigned int n, const unsigned int seed)
  {
    return Point<3>(hashed_jitter(seed, n, 0), hashed_jitter(seed, n, 1), hashed_jitter(seed, n, 2));
  }
} // namespace

/** No point of a triangle is nearer than the nearest one, which is of the triangle; slivers too. */
void nearest_points()
{
  double nearer = 0, off = 0, gradient_error = 0;
  for (unsigned int n = 0; n < 300; ++n)
  {
    std::array<Point<3>, 3> corner{{some_point(n, 1), some_point(n, 2), some_point(n, 3)}};
    if (n % 4 == 0) // nearly a line
      corner[2] = corner[0] + 0.3 * (corner[1] - corner[0]) + 1e-9 * Tensor<1, 3>(some_point(n, 4));
    if (n % 4 == 1) // a line
      corner[2] = corner[0] + 0.5 * (corner[1] - corner[0]);
    const Point<3> x = 2. * some_point(n, 5), y = nearest_point(x, corner);
    double         least = 100, on = 100;
    constexpr int  N = 40;
    for (int i = 0; i <= N; ++i)
      for (int j = 0; i + j <= N; ++j)
      {
        const Point<3> z = corner[0] + 1. * i / N * (corner[1] - corner[0]) + 1. * j / N * (corner[2] - corner[0]);
        least            = std::min(least, x.distance(z));
        on               = std::min(on, y.distance(z));
      }
    nearer = std::max(nearer, x.distance(y) - least);
    raise(off, on);
    // The distance grows with slope 1 along the normal, and with none across it.
    const Tensor<1, 3> normal = (x - y) / x.distance(y);
    for (unsigned int d = 0; d < 3; ++d)
    {
      Point<3> a = x, b = x;
      a[d] += 1e-6;
      b[d] -= 1e-6;
      raise(gradient_error,
            (a.distance(nearest_point(a, corner)) - b.distance(nearest_point(b, corner))) / 2e-6 - normal[d]);
    }
  }
  check("nearer points of a triangle", nearer, 1e-12);
  check("off the triangle, over the distance of samples", off, 3. / 40);
  check("gradient of the distance", gradient_error, 1e-4);
}

namespace
{
  template <int dim>
  std::unique_ptr<ContactSurface<dim>> contact_surface(const std::string &type, const std::string &entries)
  {
    Parameters parameters = Parameters::from_text(section("Contacts", section("c", set("Surface", type) + entries)));
    auto       surface    = parameters.make<ContactSurface<dim>>("/Contacts/c", "Surface", "box", "");
    parameters.parse();
    return surface;
  }

  /** Points without a pattern, in columns as particles have them. */
  template <int dim>
  class ManyPoints
  {
  public:
    ManyPoints() : columns(dim, std::vector<double>(n))
    {
      for (unsigned int d = 0; d < dim; ++d)
      {
        x[d] = columns[d].data();
        for (unsigned int p = 0; p < n; ++p)
          columns[d][p] = 1.5 * hashed_jitter(2, p, d);
      }
    }

    /** What a surface finds near it and inside, against its distance in closed form. */
    template <class SignedDistance>
    void compare(const std::string &name, const ContactSurface<dim> &surface, const double reach,
                 const SignedDistance &signed_distance, const double bound) const
    {
      std::vector<Near<dim>> near;
      surface.find(x, 0, n, near);
      std::vector<bool> is_found(n, false);
      double            error = 0, slope = 0;
      unsigned int      wrong = 0;
      for (const auto &one : near)
      {
        const double exact = signed_distance(point(one.p));
        is_found[one.p]    = true;
        raise(error, one.distance - std::abs(exact));
        // Along the normal the distance grows.
        raise(slope, std::abs(signed_distance(point(one.p) + 1e-7 * one.normal)) - std::abs(exact) - 1e-7);
      }
      for (unsigned int p = 0; p < n; ++p)
      {
        const double exact = signed_distance(point(p));
        if (const auto found = surface.signed_distance(point(p)))
        {
          raise(error, found->value - exact);
          raise(slope, signed_distance(point(p) + 1e-7 * found->normal) - exact - 1e-7);
        }
        else
          wrong += std::abs(exact) < reach - bound;
        wrong += is_found[p] != (std::abs(exact) < reach) && std::abs(std::abs(exact) - reach) > bound;
        wrong += surface.contains(point(p)) != (exact < 0) && std::abs(exact) > bound;
      }
      check(name + ": distances", error, bound);
      check(name + ": normals", slope, std::max(1e-9, 1e-7 * std::sqrt(bound)));
      check(name + ": found, or inside, where it is not", wrong, 0.);
      check_true(name + ": some are near", near.size() > 100);
    }

  private:
    Point<dim> point(const unsigned int p) const
    {
      Point<dim> result;
      for (unsigned int d = 0; d < dim; ++d)
        result[d] = columns[d][p];
      return result;
    }

    static constexpr unsigned int    n = 3000;
    std::vector<std::vector<double>> columns;
    std::array<const double *, dim>  x;
  };

  constexpr std::array<double, 3> box_lower = {{-1, -0.5, -0.75}}, box_upper = {{0.75, 1, 0.5}};

  template <int dim>
  double distance_from_box(const Point<dim> &y)
  {
    double outside = 0, inside = -10;
    for (unsigned int d = 0; d < dim; ++d)
    {
      const double beyond = std::max(box_lower[d] - y[d], y[d] - box_upper[d]);
      outside += std::pow(std::max(beyond, 0.), 2);
      inside = std::max(inside, beyond);
    }
    return outside > 0 ? std::sqrt(outside) : inside;
  }
} // namespace

/** Distances of many points from a box in closed form, within and without, from a ball, and from facets of it. */
template <int dim>
void contact_surfaces()
{
  const ManyPoints<dim> points;
  const std::string     corners =
    set("Lower corner", coordinates<dim>(box_lower)) + set("Upper corner", coordinates<dim>(box_upper));
  auto box = contact_surface<dim>("box", corners);
  box->create(0.25);
  points.compare("box", *box, 0.25, distance_from_box<dim>, 1e-14);

  auto polygon = contact_surface<dim>("polygon", set("Corners", "-1, -0.5; 0.75, -0.5; 0.75, 1; -1, 1") +
                                                   (dim == 2 ? "" : set("Axis", "z") + set("Ends", "-0.75, 0.5")));
  polygon->create(0.25);
  points.compare("polygon", *polygon, 0.25, distance_from_box<dim>, 1e-14);

  // On the surface there is no way to the nearest point, but a normal.
  for (auto *surface : {box.get(), polygon.get()})
  {
    Point<dim> below;
    below[1]         = -0.5;
    const auto found = surface->signed_distance(below);
    check_true("found on the surface", found.has_value());
    check("distance on the surface", found ? found->value : 1, 1e-15);
    check("normal on the surface", found ? found->normal[1] + 1 : 1, 1e-15);
  }

  // The same box as the boundary of a mesh, whose faces belong to several ranks.
  Parameters parameters =
    Parameters::from_text(section("Grid", set("Type", "mesh") + set("Cells", coordinates<dim>({{7, 6, 5}})) + corners) +
                          section("Kernel", set("Type", "P1")));
  Model<dim> model(parameters, MPI_COMM_WORLD);
  parameters.parse();
  model.create();
  auto boundary = contact_surface<dim>("mesh", "");
  boundary->attach(model.grid);
  boundary->create(0.25);
  points.compare("boundary of a mesh", *boundary, 0.25, distance_from_box<dim>, 1e-14);

  const auto of_ball = [](const Point<dim> &y) { return y.norm() - 0.8; };
  auto       ball    = contact_surface<dim>("ball", set("Radius", "0.8"));
  ball->create(0.3);
  points.compare("ball", *ball, 0.3, of_ball, 1e-14);
  auto formula = contact_surface<dim>(
    "formula", set("Formula", dim == 2 ? "3 * (sqrt(x^2 + y^2) - 0.8)" : "3 * (sqrt(x^2 + y^2 + z^2) - 0.8)"));
  formula->create(0.3);
  points.compare("formula", *formula, 0.3, of_ball, 1e-8);
  if constexpr (dim == 3)
  {
    const TemporaryFile file(".stl", stl_text(sphere_surface(Point<3>(), 0.8, 24)));
    auto                facets = contact_surface<dim>("surface", set("File", file.name));
    facets->create(0.3);
    points.compare("facets", *facets, 0.3, of_ball, 0.8 * 1.5 / (24 * 24));
  }
}

template void contact_surfaces<2>();
template void contact_surfaces<3>();

#include "bodies.h"

#include <cstdio>
#include <fstream>

using namespace Test;
using namespace dealii;

/** Position and id by one formula of the id alone, so that no rank count can matter. */
template <int dim>
void lattice()
{
  for (const double jitter : {0., 0.7})
    for (const int per_cell : {1, 2, 3})
    {
      Setup<dim>         setup(on_grid(box<dim>(0.25, 0.75) +
                                       set("Particles per cell and direction", std::to_string(per_cell)) +
                                       set("Jitter", std::to_string(jitter)) + set("Seed", "5")));
      const unsigned int n_axis = 4 * per_cell, n = std::pow(n_axis, dim) + .5;
      const double       distance = 0.125 / per_cell;
      double             error    = 0;
      for (unsigned int p = 0; p < setup.particles.size(); ++p)
        for (unsigned int d = 0, rest = setup.particles.id[p]; d < dim; ++d, rest /= n_axis)
        {
          const double shift = 0.5 * distance * jitter * hashed_jitter(5, setup.particles.id[p], d);
          raise(error, setup.position(p)[d] - (0.25 + (rest % n_axis + 0.5) * distance + shift));
        }
      const std::string name = std::to_string(per_cell) + " per cell, jitter " + std::to_string(jitter);
      check_true(name + ": ids", has_ids(setup, n));
      check_true(name + ": n_global", setup.particles.n_global == n);
      check(name + ": positions", error, 1e-15);
      check(name + ": volume", total(setup, setup.particles.volume) / std::pow(0.5, dim) - 1, 1e-13);
      check(name + ": mass", total(setup, setup.particles.mass) / (3 * std::pow(0.5, dim)) - 1, 1e-13);
    }
  // The jitter is uniform in [-1, 1): mean 0 and variance 1/3 within four standard errors, and no two axes alike.
  double     mean = 0, variance = 0, product = 0;
  const auto n = 10000;
  for (unsigned int i = 0; i < n; ++i)
  {
    mean += hashed_jitter(1, i, 0) / n;
    variance += std::pow(hashed_jitter(1, i, 0), 2) / n;
    product += hashed_jitter(1, i, 0) * hashed_jitter(1, i, 1) / n;
  }
  check("jitter: mean", mean, 4 * std::sqrt(1. / 3 / n));
  check("jitter: variance", variance - 1. / 3, 4 * std::sqrt(4. / 45 / n));
  check("jitter: axes", product, 4 * std::sqrt(1. / 9 / n));
}

/** Indices of points beyond 32 bits, and jitter that tells them apart. */
template <int dim>
void numbers_of_points()
{
  const double            n = dim == 2 ? 1 << 17 : 1 << 12; // along each axis of the unit box; 2^34 and 2^36 in all
  Setup<dim>              setup(on_grid(box<dim>(0, 1)));
  auto                   &shape = *setup.bodies[0]->shape;
  std::array<double, dim> h;
  h.fill(2 / n);
  shape.create(h);
  check("number of points", shape.n_indices() / std::pow(n, dim) - 1, 1e-15);
  Point<dim> lower, upper;
  for (unsigned int d = 0; d < dim; ++d)
  {
    lower[d] = 1 - 3 / n;
    upper[d] = 1;
  }
  double error = 0;
  shape.visit(dealii::BoundingBox<dim>({lower, upper}),
              [&](const std::uint64_t index, const Point<dim> &x, const double) {
                double expected = 0;
                for (int d = dim - 1; d >= 0; --d)
                  expected = expected * n + std::floor(x[d] * n);
                raise(error, static_cast<double>(index) - expected);
              });
  check("indices", error, 0.5);
  check_true("jitter", hashed_jitter(1, 7, 0) != hashed_jitter(1, 7 + (1ull << 32), 0));
  h.fill(1e-10);
  check_error<EntryError>("too many along an axis",
                          {"Particles per cell and direction", "more points than can be numbered"},
                          [&] { shape.create(h); });
}

/** Counts of lattice points in balls and cylinders, counted here; their volume approaches that of the shape. */
template <int dim>
void round_bodies()
{
  const std::string centre = set("Centre", coordinates<dim>({{0.5, 0.5, 0.5}})) + set("Radius", "0.4");
  const auto        count  = [](const auto &is_inside) {
    unsigned int       n      = 0;
    const unsigned int n_axis = 26; // 0.8 * 4 / 0.125 = 25.6 points, rounded to fill the length
    for (unsigned int i = 0; i < (dim == 2 ? n_axis * n_axis : n_axis * n_axis * n_axis); ++i)
    {
      Tensor<1, dim> r;
      for (unsigned int d = 0, rest = i; d < dim; ++d, rest /= n_axis)
        r[d] = 0.8 * ((rest % n_axis + 0.5) / n_axis - 0.5);
      n += is_inside(r);
    }
    return n;
  };
  const std::string dense = set("Particles per cell and direction", "4");
  {
    Setup<dim> setup(on_grid(set("Shape", "ball") + centre + dense));
    check_true("ball: count", setup.particles.n_global == count([](const auto &r) { return r.norm() < 0.4; }));
    const double volume = dim == 2 ? numbers::PI * 0.16 : 4. / 3 * numbers::PI * 0.064;
    check("ball: volume", total(setup, setup.particles.volume) / volume - 1, 0.02);
  }
  for (unsigned int axis = 0; axis < dim; ++axis)
  {
    std::array<double, 3> base = {{0.5, 0.5, 0.5}};
    base[axis]                 = 0.1;
    Setup<dim> setup(on_grid(set("Shape", "cylinder") + set("Centre", coordinates<dim>(base)) + set("Radius", "0.4") +
                             set("Height", "0.8") + set("Axis", std::string(1, "xyz"[axis])) + dense));
    const auto is_inside = [axis](Tensor<1, dim> r) {
      r[axis] = 0;
      return r.norm() < 0.4;
    };
    check_true("cylinder: count, axis " + std::to_string(axis), setup.particles.n_global == count(is_inside));
  }
}

/** Points and volumes of a file; two bodies have consecutive ids. */
template <int dim>
void point_file()
{
  const std::string name =
    "points_" + std::to_string(dim) + "_" + std::to_string(Utilities::MPI::this_mpi_process(MPI_COMM_WORLD)) + ".txt";
  const auto        write = [&](const std::string &content) { std::ofstream(name) << content; };
  const std::string z     = dim == 3 ? " 0.3" : "";
  write("# x y z volume\n0.1 0.2" + z + " 0.5\n\n0.9 0.8" + z + " 0.25 # a comment\n0.5 0.5" + z + " 1e-3\n");
  const std::string body = set("Shape", "points") + set("File", name);
  Setup<dim>        setup(on_grid(body));
  check_true("ids", has_ids(setup, 3));
  check("volume", total(setup, setup.particles.volume) - 0.751, 1e-15);
  double error = 0;
  for (unsigned int p = 0; p < setup.particles.size(); ++p)
  {
    const unsigned int i = setup.particles.id[p];
    raise(error, setup.position(p)[0] - (i == 0 ? 0.1 : i == 1 ? 0.9 : 0.5));
    raise(error, setup.position(p)[1] - (i == 0 ? 0.2 : i == 1 ? 0.8 : 0.5));
  }
  check("positions", error, 0.);

  const auto error_in = [&](const std::string &what, const std::string &content, const std::string &message) {
    write(content);
    check_error<InputError>(what, {message}, [&] { Setup<dim> s(on_grid(body)); });
  };
  error_in("short line", "0.1 0.2" + z + " 0.5\n0.1 0.2\n", name + ":2: expected " + std::to_string(dim + 1));
  error_in("no number", "0.1 abc" + z + " 0.5\n", name + ":1: 'abc' is not a finite number");
  error_in("not a number", "0.1 nan" + z + " 0.5\n", name + ":1: 'nan' is not a finite number");
  error_in("no volume", "0.1 0.2" + z + " 0\n", "volume must be positive");
  error_in("no points", "# nothing\n", "contains no points");
  error_in("point outside", "0.1 0.2" + z + " 0.5\n1.5 0.2" + z + " 0.5\n", "outside the grid");
  std::remove(name.c_str());
  check_error<EntryError>("missing file", {"/Bodies/body: File", "cannot read", name},
                          [&] { Setup<dim> s(on_grid(body)); });
}

template <int dim>
void body_errors()
{
  const auto error = [](const std::string &name, const std::string &body, const std::string &entry,
                        const std::string &message) {
    check_error<EntryError>(name, {"/Bodies/body: " + entry, message}, [&] { Setup<dim> s(on_grid(body)); });
  };
  error("empty box", box<dim>(0.5, 0.5), "Upper corner", "the body is empty");
  error("negative radius", set("Shape", "ball") + set("Radius", "-1"), "Radius", "the body is empty");
  error("outside the grid", box<dim>(2, 3), "Lower corner", "outside the grid");
  error("partly outside the grid", box<dim>(0.5, 1.25), "Lower corner", "outside the grid");
  error("lattice shifted out of the grid", box<dim>(0, 1) + set("Lattice offset", coordinates<dim>({{0.75, 0, 0}})),
        "Lower corner", "outside the grid");
  error("ball between the points",
        set("Shape", "ball") + set("Radius", "1e-9") + set("Centre", coordinates<dim>({{0.5, 0.5, 0.5}})) +
          set("Particles per cell and direction", "1") + set("Lattice offset", coordinates<dim>({{0.5, 0.5, 0.5}})),
        "Centre", "the body is empty");
  error("two components short", box<dim>(0, 1) + set("Velocity gradient", "1, 2"), "Velocity gradient", "numbers");
  error("velocity without value", box<dim>(0, 1) + set("Velocity", dim == 2 ? "1/0*x; 0" : "1/0*x; 0; 0"), "Velocity",
        "no finite value");
  error("no unit weight", box<dim>(0, 1) + set("Initial stress", "geostatic"), "Unit weight", "must be positive");
  error("a weightless fluid", box<dim>(0, 1) + set("Initial stress", "hydrostatic"), "Unit weight", "must be positive");
}

#define INSTANTIATE(name)                                                                                              \
  template void name<2>();                                                                                             \
  template void name<3>();
INSTANTIATE(lattice)
INSTANTIATE(numbers_of_points)
INSTANTIATE(round_bodies)
INSTANTIATE(point_file)
INSTANTIATE(body_errors)

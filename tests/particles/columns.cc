#include "../surfaces.h"
#include "bodies.h"

using namespace Test;
using namespace dealii;

namespace
{
  std::string points(const std::string &file, const std::string &more = "")
  {
    return set("Shape", "points") + set("File", file) + more;
  }

  std::string plastic_body(const std::string &content)
  {
    const std::string ground = section("ground", set("Type", "von Mises") + set("Density", "10"));
    return section("Grid", grid_entries) + section("Materials", set("Names", "ground") + ground) +
           section("Bodies", set("Names", "body") + section("body", content));
  }
} // namespace

/** Tables whose columns have names: any order, what particles carry, what is computed from it. */
void named_columns()
{
  const TemporaryFile file(
    ".csv",
    "# time 2\n"
    "id,body,volume,y,x,velocity_x,velocity_y,stress_xx,stress_yy,stress_zz,stress_xy,equivalent_plastic_strain,weight\n"
    "7,0,0.01,0.3,0.2,1,-2,-10,-20,-30,4,0.25,99\n"
    "8,1,0.02,0.6,0.7,3,5,-1,-2,-3,0.5,0,98\n");
  const std::string all = points(file.name, set("Ignore columns", "weight"));
  const Setup<2>    setup(plastic_body(all));
  const auto       &particles = setup.particles;
  check_true("both", particles.n_global == 2);
  double error = 0;
  for (unsigned int p = 0; p < particles.size(); ++p)
  {
    const bool   first = setup.position(p)[0] < 0.5;
    const auto   at = [&](const unsigned int field, const unsigned int c) { return particles.component(field, c)[p]; };
    const double v[2] = {first ? 1. : 3., first ? -2. : 5.},
                 s[4] = {first ? -10. : -1., first ? -20. : -2., first ? -30. : -3., first ? 4. : 0.5};
    for (unsigned int d = 0; d < 2; ++d)
      raise(error, at(particles.velocity, d) - v[d]);
    for (unsigned int c = 0; c < 4; ++c)
      raise(error, at(particles.stress, c) - s[c]);
    raise(error, setup.position(p)[1] - (first ? 0.3 : 0.6));
    raise(error, at(particles.mass, 0) - (first ? 0.1 : 0.2));
    raise(error, at(*particles.find_field("equivalent plastic strain"), 0) - (first ? 0.25 : 0.));
  }
  check("values", error, 1e-14);
  const Setup<2> second(plastic_body(all + set("Only body", "1")));
  check("one body of two", total(second, second.particles.volume) - 0.02, 1e-16);

  const auto wrong = [](const std::string &name, const std::string &table, const std::string &more,
                        const std::string &words) {
    const TemporaryFile file(".csv", table);
    check_error<EntryError>(name, {words}, [&] { Setup<2> setup(plastic_body(points(file.name, more))); });
  };
  wrong("unknown column", "x y volume pressure\n.1 .1 .01 3\n", "", "have no 'pressure'. They have position_x");
  wrong("half a vector", "x y volume velocity_x\n.1 .1 .01 3\n", "", "of velocity the table has 1 of 2 components");
  wrong("two stresses", "x y volume stress_xx stress_yy stress_zz stress_xy\n.1 .1 .01 1 1 1 0\n",
        set("Initial stress", "uniform"), "the table gives the stress");
  if (Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) == 1) // a program ends all ranks when one has an error
    wrong("no mass", "x y volume mass\n.1 .1 .01 0\n", "", "its mass must be positive");
  wrong("nothing to ignore", "x y volume mass\n.1 .1 .01 1\n", set("Ignore columns", "m"), "has no column 'm'");
  wrong("no names", ".1 .1 .01\n", set("Only body", "0"), "its first line must name all");
  wrong("no such body", "x y volume body\n.1 .1 .01 1\n", set("Only body", "0"), "contains no points");
}

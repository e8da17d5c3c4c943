#include "fixture.h"

using namespace dealii;
using namespace Test;

namespace
{
  std::string probe(const std::string &name, const std::string &kind, const std::string &position)
  {
    return "subsection " + name + "\nset Kind = " + kind + "\nset Position = " + position + "\nend\n";
  }

  /** Two probes at the corner (4, 1) of the body, whose nearest particle sits 1/8 inside. */
  template <int dim>
  void check_probes()
  {
    const std::string d    = " in " + std::to_string(dim) + "D";
    const std::string base = scratch();
    const std::string x    = dim == 2 ? "4, 1" : "4, 1, 1";
    Fixture<dim>      run("subsection Probes\nset Names = tip, corner\n" + probe("tip", "particle", x) +
                          probe("corner", "point", x) + "end\n");
    run.create();
    auto &particles = run.particles;
    run.probes.open(base, particles, run.grid);
    // Stress by id; the body then moves by a cell and a half, across ranks.
    for (unsigned int p = 0; p < particles.size(); ++p)
      for (unsigned int c = 0; c < particles.n_stress; ++c)
        particles.component(particles.stress, c)[p] = particles.id[p] + 0.25 * c;
    run.probes.write(0., particles);
    for (unsigned int move = 0; move < 2; ++move) // no farther at once than a rank knows its neighbours' cells
    {
      for (unsigned int p = 0; p < particles.size(); ++p)
        particles.component(particles.position, 0)[p] += 0.375;
      particles.synchronise();
    }
    run.probes.write(0.5, particles);
    // All but two at one place; 16 and 17 stand before 2 in the first cell's order.
    for (unsigned int p = 0; p < particles.size(); ++p)
      for (unsigned int c = 0; c < dim; ++c)
        particles.component(particles.position, c)[p] = particles.id[p] < 2 ? 0. : 1.;
    run.probes.write(1., particles);

    const auto table = lines(base + "/probes.csv");
    check_true("a row for each time" + d, table.size() == 4);
    check_true("names" + d,
               table[0].find("time [time],tip_position_x [length],tip_position_y [length],") == 0 &&
                 table[0].find(",tip_stress_xx [stress]") != std::string::npos &&
                 table[0].find(",corner_distance [length],corner_position_x [length]") != std::string::npos);
    const auto         first = read_numbers(table[1]), second = read_numbers(table[2]);
    const unsigned int n = 2 * dim + particles.n_stress; // columns of a particle
    check_true("all columns" + d, first.size() == 2 + 2 * n);
    const double last = particles.n_global - 1; // id of the last lattice point, at the corner
    check("the particle is found" + d, first[1] - 3.875, 1e-14);
    check("in all directions" + d, first[dim] - 0.875, 1e-14);
    check("and followed" + d, second[1] - 4.625, 1e-14);
    check("with its stress" + d, second[1 + 2 * dim + 1] - (last + 0.25), 1e-14);
    check("the point's nearest particle is the same at first" + d, first[1 + n + 1] - first[1], 1e-15);
    check("at its distance" + d, first[1 + n] - std::sqrt(dim) / 8, 1e-14);
    // 3.125 + 0.75 = 3.875 and 4.125 are equally far: the lower id, three points back, is taken.
    check("later another one" + d, second[1 + n + 1] - 3.875, 1e-14);
    check("with its stress" + d, second[1 + n + 1 + 2 * dim] - (last - 3), 1e-14);
    check("of many the lowest id" + d, read_numbers(table[3])[1 + n + 1 + 2 * dim] - 2, 1e-14);
  }
} // namespace

void test_probes()
{
  check_probes<2>();
  check_probes<3>();

  const std::string base = scratch();
  Fixture<2>        run;
  run.create();
  run.probes.open(base, run.particles, run.grid);
  run.probes.write(0., run.particles);
  MPI_Barrier(MPI_COMM_WORLD);
  check_true("no probe, no file", run.probes.is_empty() && std::filesystem::is_empty(base));
}

void test_probe_errors()
{
  const std::string base = scratch();
  const auto        open = [&](const std::string &entries) {
    Fixture<2> run("subsection Probes\nset Names = a\n" + entries + "end\n");
    run.create();
    run.probes.open(base, run.particles, run.grid);
  };
  check_throws<EntryError>("outside the grid", "outside the grid", [&] { open(probe("a", "point", "1, 4.5")); });
  check_throws<EntryError>("no particle near", "no particle starts within",
                           [&] { open(probe("a", "particle", "6, 1.5")); });
  check_throws<EntryError>("unknown field", "there is no particle field 'colour'",
                           [&] { open("set Fields = colour\n" + probe("a", "point", "1, 1")); });
}

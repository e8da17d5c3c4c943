#include "../setup.h"

#include <cstring>
#include <map>

using namespace Test;
using namespace dealii;

namespace
{
  /** 8 cells along x and 4 across: two ranks share it at x = 1/2. */
  template <int dim>
  std::string text(const std::string &kernel, const bool has_two_materials = true)
  {
    return section("Grid", set("Cells", coordinates<dim>({{8, 4, 4}}))) + kernel_text(kernel, "WLS") +
           section("Materials", set("Names", "soft, hard") + section("soft", "") + section("hard", "")) +
           section("Bodies", set("Names", "left, right") +
                               section("left", set("Material", has_two_materials ? "hard" : "soft") +
                                                 set("Upper corner", coordinates<dim>({{0.5, 1, 1}}))) +
                               section("right", set("Material", "soft") + set("Jitter", "0.9") +
                                                  set("Lower corner", coordinates<dim>({{0.5, 0, 0}}))));
  }

  /** All columns, body and material of every particle on every rank, by id. */
  template <int dim>
  std::map<unsigned int, std::vector<double>> everything(const Setup<dim> &setup)
  {
    const auto                      &set = setup.particles;
    std::vector<std::vector<double>> rows;
    for (unsigned int m = 0; m + 1 < set.material_begin.size(); ++m)
      for (unsigned int p = set.material_begin[m]; p < set.material_begin[m + 1]; ++p)
      {
        std::vector<double> row = {1. * set.id[p], 1. * set.body[p], 1. * m};
        for (unsigned int c = 0; c < set.n_columns(); ++c)
          row.push_back(set.column(c)[p]);
        rows.push_back(row);
      }
    std::map<unsigned int, std::vector<double>> result;
    for (const auto &of_rank : Utilities::MPI::all_gather(MPI_COMM_WORLD, rows))
      for (const auto &row : of_rank)
        result[row[0]] = row;
    return result;
  }

  template <int dim>
  typename Lattice<dim>::Index cell_of(const Setup<dim> &setup, const unsigned int p, const double shift = 0)
  {
    typename Lattice<dim>::Index cell;
    for (unsigned int d = 0; d < dim; ++d)
      cell[d] = static_cast<int>(std::floor(setup.grid.lattice.coordinate(setup.position(p)[d], d) - shift));
    return cell;
  }

  /** Particles lie in cells of this rank, ordered by material, first node of the stencil (x fastest) and id. */
  template <int dim>
  bool is_canonical(const Setup<dim> &setup)
  {
    const auto &set     = setup.particles;
    const auto &lattice = setup.grid.lattice;
    bool        holds   = set.material_begin.back() == set.size();
    for (unsigned int m = 0; m + 1 < set.material_begin.size(); ++m)
      for (unsigned int p = set.material_begin[m]; p < set.material_begin[m + 1]; ++p)
      {
        const auto cell = cell_of(setup, p);
        holds           = holds && lattice.is_in_table(cell) && setup.grid.owns_cell(lattice.table_index(cell));
        if (p > set.material_begin[m])
        {
          const double shift = setup.kernel->reach().shift;
          auto         here = cell_of(setup, p, shift), before = cell_of(setup, p - 1, shift);
          std::reverse(here.begin(), here.end());
          std::reverse(before.begin(), before.end());
          holds = holds && (before < here || (before == here && set.id[p - 1] < set.id[p]));
        }
      }
    return holds;
  }
} // namespace

/** Particles change cells and ranks, and nothing else about them changes by a single bit. */
template <int dim>
void synchronise(const bool has_two_materials)
{
  Setup<dim> setup(text<dim>("quadratic B-spline", has_two_materials));
  auto      &set = setup.particles;
  check_true("canonical order at first", is_canonical(setup));
  for (unsigned int f = 0; f < set.fields.size(); ++f)
    if (f != set.position)
      setup.randomize(f, f);
  unsigned int n_changed_rank = 0;
  for (unsigned int round = 0; round < 4; ++round)
  {
    // Up to 0.9 of a cell in each direction, but not out of the grid; there and back and elsewhere.
    setup.fill(set.position, [&](const unsigned int p, const unsigned int d) {
      const double x     = set.component(set.position, d)[p];
      const double moved = x + 0.9 * setup.grid.lattice.h[d] * hashed_jitter(round, set.id[p], d);
      return moved > 0 && moved < 1 ? moved : x;
    });
    for (unsigned int p = 0; p < set.size(); ++p)
    {
      const auto cell = cell_of(setup, p);
      n_changed_rank += !setup.grid.owns_cell(setup.grid.lattice.table_index(cell));
    }
    const auto        before = everything(setup);
    const std::string name =
      (has_two_materials ? "two materials" : "one material") + (": round " + std::to_string(round));
    const auto compare = [&](const std::string &what) {
      const auto after   = everything(setup);
      bool       is_same = before.size() == after.size() && before.size() == set.n_global;
      for (const auto &[id, row] : before)
        is_same = is_same && after.count(id) == 1 &&
                  std::memcmp(row.data(), after.at(id).data(), row.size() * sizeof(double)) == 0;
      check_true(name + ": bit for bit the same after " + what, is_same);
    };
    set.migrate();
    compare("migrate");
    bool all_here = true;
    for (unsigned int p = 0; p < set.size(); ++p)
      all_here = all_here && setup.grid.owns_cell(setup.grid.lattice.table_index(cell_of(setup, p)));
    check_true(name + ": all particles on the rank of their cell", all_here);
    set.sort();
    compare("sort");
    check_true(name + ": canonical order", is_canonical(setup));
    check_true(name + ": nothing left to do", !set.needs_synchronise);
  }
  const double n = sum(n_changed_rank);
  check_true("particles changed rank", Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) == 1 ? n == 0 : n > 20);
}

template <int dim>
void synchronise()
{
  synchronise<dim>(true);
  synchronise<dim>(false);
}

/**
 * A particle far beyond the ghost cells of its rank, where relocate() would have called long before: its rank does not
 * know the cell, and asks for who does.
 */
template <int dim>
void far_away()
{
  Setup<dim> setup(text<dim>("quadratic B-spline"));
  auto      &set = setup.particles;
  for (unsigned int p = 0; p < set.size(); ++p)
    if (set.id[p] == 0) // at the left end
      set.component(set.position, 0)[p] = 0.95;
  set.synchronise();
  check_true("kept, though its rank did not know the cell", sum(set.size()) == set.n_global && is_canonical(setup));
}

/** A particle just beyond the ghost cells is sent to who owns the cell, and none but those that must go. */
template <int dim>
void beyond_ghost_cells()
{
  for (const std::string kernel : {"linear", "quadratic B-spline", "cubic B-spline"})
  {
    Setup<dim> setup(text<dim>(kernel));
    auto      &set     = setup.particles;
    auto      &lattice = setup.grid.lattice;
    // Along x to the other side of the ghost cells of the rank.
    bool is_known = true;
    for (unsigned int p = 0; p < set.size(); ++p)
    {
      const double x = set.component(set.position, 0)[p], moved = x + (x < 0.5 ? 1.5 : -1.5) / 8;
      set.component(set.position, 0)[p] = moved;
      is_known = is_known && lattice.owner[lattice.table_index(cell_of(setup, p))] != lattice.missing;
    }
    check_true(kernel + ": owners are known two cells away", is_known);
    const auto before = everything(setup);
    set.synchronise();
    check_true(kernel + ": nothing changed", before == everything(setup) && is_canonical(setup));
  }
}

/** A particle that no rank's cells hold, which relocate() would have named before, ends the run in one sentence. */
template <int dim>
void lost()
{
  if (Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) == 1)
    return; // nothing to search
  Setup<dim> setup(text<dim>("quadratic B-spline"));
  auto      &set                    = setup.particles;
  set.component(set.position, 0)[0] = 5; // on every rank: all must stop
  std::string what                  = "nothing";
  try
  {
    set.migrate();
  }
  catch (const RunError &error)
  {
    what = error.what();
  }
  check_true("a particle lost between ranks is named",
             what.find("Particle " + std::to_string(set.id[0]) + " at (5,") != std::string::npos &&
               what.find("lost between ranks") != std::string::npos);
}

/**
 * How far a particle may go beyond its rank's cells: as far as the rank knows its nodes, which are those of the
 * neighbouring cells and, for stencils of four, of their neighbours: h for linear and cubic, h/2 for quadratic and
 * uGIMP (its stencil of three). On two ranks, which meet in the middle; where more meet, there is no one answer.
 */
template <int dim>
void drift()
{
  if (Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 2)
    return;
  for (const auto &[kernel, limit] : std::map<std::string, double>{
         {"linear", 1.}, {"quadratic B-spline", 0.5}, {"cubic B-spline", 1.}, {"uGIMP", 0.5}})
  {
    Setup<dim> setup(text<dim>(kernel));
    auto      &set = setup.particles;
    set.relocate();
    check_true(kernel + ": stays at first", !set.needs_synchronise && set.outside == set.none);
    const bool   is_alone = Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) == 1;
    const double h        = 0.125;
    // The rank on the left lets its particles go to the right, and the other way round.
    const bool is_left = set.size() > 0 && setup.position(0)[0] < 0.5;
    for (const double distance : {-0.01, 0.01, 0.49, 0.51, 0.99, 1.01})
    {
      const double before               = set.component(set.position, 0)[0];
      set.component(set.position, 0)[0] = 0.5 + (is_left ? 1 : -1) * distance * h;
      set.relocate();
      check_true(kernel + ": " + std::to_string(distance) + " h beyond",
                 set.needs_synchronise == (!is_alone && distance > limit) && set.outside == set.none);
      set.component(set.position, 0)[0] = before;
    }
    set.relocate();
    check_true(kernel + ": back again", !set.needs_synchronise);
  }
}

/** Of the particles outside that of lowest number is found; NaN is outside. */
template <int dim>
void outside()
{
  Setup<dim> setup(text<dim>("quadratic B-spline"));
  auto      &set = setup.particles;
  for (unsigned int d = 0; d < dim; ++d)
    for (const double x : {-1e-9, 1 + 1e-8, 1.5, 1e30, -1e30, std::nan("")})
    {
      const unsigned int p              = 5;
      const double       before         = set.component(set.position, d)[p];
      const double       other          = set.component(set.position, d)[p + 3];
      set.component(set.position, d)[p] = set.component(set.position, d)[p + 3] = x;
      set.relocate();
      check_true("axis " + std::to_string(d) + ", x = " + std::to_string(x),
                 set.outside == (set.id[p] < set.id[p + 3] ? p : p + 3));
      set.component(set.position, d)[p]     = before;
      set.component(set.position, d)[p + 3] = other;
    }
  set.relocate();
  check_true("all inside", set.outside == set.none);
}

/** A particle whose rank does not know its stencil's nodes cannot be sorted, nor make nodes active. */
template <int dim>
void unknown_nodes()
{
  Setup<dim> setup(text<dim>("quadratic B-spline"));
  auto      &set      = setup.particles;
  const bool is_alone = Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) == 1;
  const bool is_left  = setup.position(3)[0] < 0.5;
  for (const double x : {is_left ? 0.9 : 0.1, 7., -7., 1e30, -1e30, std::nan("")})
  {
    if (is_alone && x > 0 && x < 1)
      continue;
    const double before               = set.component(set.position, 0)[3];
    set.component(set.position, 0)[3] = x;
    const std::vector<std::string> words{"Particle " + std::to_string(set.id[3]),
                                         "beyond the nodes that its rank knows"};
    check_error<RunError>("sort, x = " + std::to_string(x), words, [&] { set.sort(); });
    check_error<RunError>("activate, x = " + std::to_string(x), words, [&] { set.used_places(); });
    set.component(set.position, 0)[3] = before;
  }
  set.sort();
  check_true("back again", is_canonical(setup));
}

#define INSTANTIATE(name)                                                                                              \
  template void name<2>();                                                                                             \
  template void name<3>();
INSTANTIATE(synchronise)
INSTANTIATE(far_away)
INSTANTIATE(beyond_ghost_cells)
INSTANTIATE(lost)
INSTANTIATE(drift)
INSTANTIATE(outside)
INSTANTIATE(unknown_nodes)

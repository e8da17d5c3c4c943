#include <talus/particles/amount.h>

#include "../setup.h"

#include <cstdio>
#include <fstream>

using namespace Test;
using namespace dealii;

namespace
{
  /** A box that round-off does not spare: neither corners nor spacings are numbers of the machine. */
  template <int dim>
  std::string exact_grid(const double origin, const int n_cells, const double h)
  {
    std::ostringstream lower, upper;
    lower << std::setprecision(17);
    upper << std::setprecision(17);
    for (unsigned int d = 0; d < dim; ++d)
    {
      lower << (d > 0 ? ", " : "") << origin;
      upper << (d > 0 ? ", " : "") << origin + n_cells * h;
    }
    return section("Grid", set("Lower corner", lower.str()) + set("Upper corner", upper.str()) +
                             set("Spacing", std::to_string(h)));
  }

  /** Writes the points of a lattice from face to face, of spacing h/2, as text with some digits. */
  template <int dim>
  unsigned int write_points(const std::string &name, const double origin, const int n_cells, const double h,
                            const int digits)
  {
    std::ofstream      file(name);
    const unsigned int n = 2 * n_cells + 1, n_total = dim == 2 ? n * n : n * n * n;
    file << std::setprecision(digits);
    for (unsigned int k = 0; k < n_total; ++k)
    {
      for (unsigned int d = 0, rest = k; d < dim; ++d, rest /= n)
        file << origin + (rest % n) * h / 2 << ' ';
      file << std::pow(h / 2, dim) << '\n';
    }
    return n_total;
  }

  template <int dim>
  double total_of(const Setup<dim> &setup, const unsigned int field)
  {
    double result = 0;
    for (unsigned int p = 0; p < setup.particles.size(); ++p)
      result += setup.particles.component(field, 0)[p];
    return sum(result);
  }
} // namespace

/** Points on all grid lines, corners and faces of the domain, as a mesher gives them: none is lost, each counts once.
 */
template <int dim>
void on_grid_lines()
{
  const std::string name =
    "lines_" + std::to_string(dim) + "_" + std::to_string(Utilities::MPI::this_mpi_process(MPI_COMM_WORLD)) + ".txt";
  for (const double origin : {0., -0.7, 4649000.3})
    for (const double h : {0.1, 0.3})
      for (const int digits : {17, 9})
      {
        const int          n_cells = dim == 2 ? 10 : 6;
        const unsigned int n       = write_points<dim>(name, origin, n_cells, h, origin > 1 ? 17 : digits);
        Setup<dim> setup(exact_grid<dim>(origin, n_cells, h) + body_text(set("Shape", "points") + set("File", name)));
        const std::string what =
          "origin " + std::to_string(origin) + ", h " + std::to_string(h) + ", digits " + std::to_string(digits);
        check_true(what + ": number", sum(setup.particles.size()) == n && setup.particles.n_global == n);
        check(what + ": mass", total_of(setup, setup.particles.mass) / (3 * n * std::pow(h / 2, dim)) - 1, 1e-8);
        bool is_inside = true;
        for (unsigned int p = 0; p < setup.particles.size(); ++p)
          is_inside = is_inside && setup.grid.contains(setup.position(p));
        check_true(what + ": inside", is_inside);
        // A step in which nothing moves finds them where they are.
        setup.particles.relocate();
        check_true(what + ": none leaves",
                   Utilities::MPI::max(setup.particles.outside != setup.particles.none ? 1 : 0, MPI_COMM_WORLD) == 0);
      }
  std::remove(name.c_str());
}

/** Faces of the domain: what is beyond one by round-off is put on it, what is farther out is not. */
template <int dim>
void on_faces()
{
  for (const double origin : {0., -0.7, 4649000.3})
  {
    Setup<dim>          setup(exact_grid<dim>(origin, 10, 0.3) +
                              body_text(set("Shape", "ball") + set("Radius", "0.3") +
                                        set("Centre", coordinates<dim>({{origin + 1.5, origin + 1.5, origin + 1.5}}))));
    const Lattice<dim> &lattice = setup.grid.lattice;
    const double        lower = lattice.origin[1], upper = lattice.node_position(10, 1);
    const double        tolerance = std::max(0.3e-9, 8 * std::abs(std::nextafter(upper, 1e9) - upper));
    const std::string   what      = "origin " + std::to_string(origin);
    for (const double beyond : {0., 0.4 * tolerance, 2.5 * tolerance, 0.1})
    {
      const bool is_near = beyond < tolerance;
      for (const bool is_upper : {false, true})
      {
        Point<dim> x;
        for (unsigned int d = 0; d < dim; ++d)
          x[d] = origin + 1;
        x[1]               = is_upper ? upper + beyond : lower - beyond;
        const bool entered = lattice.enter(x);
        check_true(what + ": " + std::to_string(beyond) + " beyond", entered == is_near);
        if (!is_near)
          continue;
        check(what + ": on the face", x[1] - (is_upper ? upper : lower), is_upper ? 0.3 * tolerance : 0.);
        check_true(what + ": its cell", lattice.cell_index(x)[1] == (is_upper ? 9 : 0));
      }
    }
    // The same in motion: particles moved to and just beyond the faces stay, one farther out is told of.
    for (const double beyond : {0.4 * tolerance, 2.5 * tolerance})
    {
      for (unsigned int p = 0; p < setup.particles.size(); ++p)
        setup.particles.component(setup.particles.position, 1)[p] = p % 2 == 0 ? upper + beyond : lower - beyond;
      setup.particles.relocate();
      const bool has_left =
        Utilities::MPI::max(setup.particles.outside != setup.particles.none ? 1 : 0, MPI_COMM_WORLD);
      check_true(what + ": moved beyond a face", has_left == (beyond > tolerance));
      if (has_left)
        continue;
      setup.particles.synchronise();
      check_true(what + ": none is lost", sum(setup.particles.size()) == setup.particles.n_global);
    }
  }
}

#define INSTANTIATE(name)                                                                                              \
  template void name<2>();                                                                                             \
  template void name<3>();
INSTANTIATE(on_grid_lines)
INSTANTIATE(on_faces)

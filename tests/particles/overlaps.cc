#include "../setup.h"

#include <cstdio>
#include <fstream>

using namespace Test;
using namespace dealii;

namespace
{
  template <int dim>
  std::string two_bodies(const std::string &a, const std::string &b, const std::string &more = "")
  {
    const std::string material = set("Density", "3") + set("Young's modulus", "7") + set("Poisson's ratio", "0.2");
    return section("Grid", set("Upper corner", coordinates<dim>({{2, 2, 2}})) + set("Spacing", "0.125")) +
           section("Materials", set("Names", "rubber") + section("rubber", material)) +
           section("Bodies", set("Names", "a, b") + section("a", a) + section("b", b) + more);
  }

  template <int dim>
  std::string box_between(const std::array<double, 3> &lower, const std::array<double, 3> &upper,
                          const std::string &more = "")
  {
    return set("Lower corner", coordinates<dim>(lower)) + set("Upper corner", coordinates<dim>(upper)) + more;
  }

  template <int dim>
  std::string ball_at(const double x, const double radius)
  {
    return set("Shape", "ball") + set("Centre", coordinates<dim>({{x, 1, 1}})) + set("Radius", std::to_string(radius));
  }

  /** A lattice of points of spacing h from `lower` on, in a file of its own for each rank. */
  template <int dim>
  std::string list_of_points(const std::string &name, const double lower, const unsigned int n, const double h)
  {
    const std::string path = name + "_" + std::to_string(dim) + "_" +
                             std::to_string(Utilities::MPI::this_mpi_process(MPI_COMM_WORLD)) + ".txt";
    std::ofstream file(path);
    for (unsigned int k = 0; k < (dim == 2 ? n * n : n * n * n); ++k)
    {
      for (unsigned int d = 0, rest = k; d < dim; ++d, rest /= n)
        file << lower + (rest % n + 0.5) * h << ' ';
      file << std::pow(h, dim) << '\n';
    }
    return set("Shape", "points") + set("File", path);
  }

  template <int dim>
  void refused(const std::string &what, const std::string &a, const std::string &b, const std::string &message)
  {
    check_error<EntryError>(what, {"/Bodies/", message, "Allow overlap"}, [&] { Setup<dim> s(two_bodies<dim>(a, b)); });
    Setup<dim> setup(two_bodies<dim>(a, b, set("Allow overlap", "true")));
    check_true(what + ": allowed", setup.particles.n_global > 0);
  }

  template <int dim>
  void taken(const std::string &what, const std::string &a, const std::string &b)
  {
    Setup<dim> setup(two_bodies<dim>(a, b));
    check_true(what, setup.particles.n_global > 0);
  }
} // namespace

/** Bodies that overlap, wherever their points lie, are refused; those that touch are not. */
template <int dim>
void overlaps()
{
  const std::string first = box_between<dim>({{0.25, 0.25, 0.25}}, {{1, 1, 1}});
  refused<dim>("the same box", first, first, "'a' and 'b' overlap");
  refused<dim>("a box a row deep in another", first, box_between<dim>({{0.9375, 0.25, 0.25}}, {{1.5, 1, 1}}),
               "overlap");
  refused<dim>("a box in another", first, box_between<dim>({{0.5, 0.5, 0.5}}, {{0.75, 0.75, 0.75}}), "overlap");
  refused<dim>(
    "shifted by half a row", first,
    box_between<dim>({{0.25, 0.25, 0.25}}, {{1, 1, 1}}, set("Lattice offset", coordinates<dim>({{0.5, 0.5, 0.5}}))),
    "overlap");
  refused<dim>("a ball in a box", box_between<dim>({{0.25, 0.25, 0.25}}, {{1.5, 1.5, 1.5}}), ball_at<dim>(1, 0.25),
               "overlap");
  refused<dim>("two balls", ball_at<dim>(0.75, 0.4), ball_at<dim>(1.25, 0.4), "overlap");
  refused<dim>("points in a box", first, list_of_points<dim>("in_a_box", 0.75, 4, 0.1), "overlap");
  refused<dim>("lists of points", list_of_points<dim>("list_a", 0.5, 8, 0.0625),
               list_of_points<dim>("list_b", 0.53125, 8, 0.0625), "-fold");
  refused<dim>("lists of points at the same places", list_of_points<dim>("list_c", 0.5, 8, 0.0625),
               list_of_points<dim>("list_d", 0.5, 8, 0.0625), "lie at the same place");

  refused<dim>("a box a fifth of a particle deep in another", first,
               box_between<dim>({{0.9875, 0.25, 0.25}}, {{1.5, 1, 1}}), "particles of one reach into the other");
  refused<dim>("the same place, in cells that meet at a corner",
               list_of_points<dim>("corner_a", 1 - 0.01 - 1e-9, 1, 0.02),
               list_of_points<dim>("corner_b", 1 - 0.01 + 1e-9, 1, 0.02), "lie at the same place");

  taken<dim>("a box a twentieth of a particle deep in another", first,
             box_between<dim>({{1 - 0.0625 / 20, 0.25, 0.25}}, {{1.5, 1, 1}}));
  taken<dim>("boxes that touch", first, box_between<dim>({{1, 0.25, 0.25}}, {{1.5, 1, 1}}));
  taken<dim>("boxes that touch, jittered", box_between<dim>({{0.25, 0.25, 0.25}}, {{1, 1, 1}}, set("Jitter", "1")),
             box_between<dim>({{1, 0.25, 0.25}}, {{1.5, 1, 1}}, set("Jitter", "1")));
  taken<dim>("coarse beside fine", first,
             box_between<dim>({{1, 0.25, 0.25}}, {{1.5, 1, 1}}, set("Particles per cell and direction", "4")));
  taken<dim>("balls that touch", ball_at<dim>(0.5, 0.4), ball_at<dim>(1.3, 0.4));
  taken<dim>("a ball on a box", box_between<dim>({{0.25, 0.25, 0.25}}, {{1.5, 0.75, 1.5}}), ball_at<dim>(1, 0.25));
  taken<dim>("lists that touch", list_of_points<dim>("list_e", 0.5, 8, 0.0625),
             list_of_points<dim>("list_f", 1, 8, 0.0625));
  for (const std::string name :
       {"in_a_box", "list_a", "list_b", "list_c", "list_d", "list_e", "list_f", "corner_a", "corner_b"})
    std::remove((name + "_" + std::to_string(dim) + "_" +
                 std::to_string(Utilities::MPI::this_mpi_process(MPI_COMM_WORLD)) + ".txt")
                  .c_str());
}

#define INSTANTIATE(name)                                                                                              \
  template void name<2>();                                                                                             \
  template void name<3>();
INSTANTIATE(overlaps)

#include "../run.h"

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/vector.h>

#include <map>

using namespace Test;
using namespace dealii;

namespace
{
  /**
   * How rough the mean stress is: the root mean square of what is left of it beside a plane through its values in each
   * block of two cells, over that of the mean stress itself. Blocks belong to one rank each or are left out.
   */
  template <int dim>
  double roughness(const Run<dim> &run, const double h)
  {
    const auto                                               &particles = run.model.particles;
    std::map<std::array<int, dim>, std::vector<unsigned int>> blocks;
    for (unsigned int p = 0; p < particles.size(); ++p)
    {
      std::array<int, dim> k;
      for (unsigned int d = 0; d < dim; ++d)
        k[d] = static_cast<int>(particles.vector(particles.position, p)[d] / (2 * h));
      blocks[k].push_back(p);
    }
    double rest = 0, all = 0;
    for (const auto &[place, members] : blocks)
    {
      const auto &k = place;
      if (members.size() < std::pow(3, dim))
        continue;
      FullMatrix<double> A(dim + 1, dim + 1);
      Vector<double>     b(dim + 1), a(dim + 1);
      const auto         row = [&](const unsigned int p) {
        Vector<double> r(dim + 1);
        r(0) = 1;
        for (unsigned int d = 0; d < dim; ++d)
          r(1 + d) = particles.vector(particles.position, p)[d] / h - 2 * k[d] - 1;
        return r;
      };
      const auto mean = [&](const unsigned int p) {
        double sum = 0;
        for (unsigned int d = 0; d < 3; ++d)
          sum += particles.component(particles.stress, d)[p] / 3;
        return sum;
      };
      for (const unsigned int p : members)
      {
        const auto r = row(p);
        for (unsigned int i = 0; i <= dim; ++i)
        {
          b(i) += r(i) * mean(p);
          for (unsigned int j = 0; j <= dim; ++j)
            A(i, j) += r(i) * r(j);
        }
      }
      A.gauss_jordan();
      A.vmult(a, b);
      for (const unsigned int p : members)
      {
        rest += std::pow(mean(p) - a * row(p), 2);
        all += std::pow(mean(p), 2);
      }
    }
    return std::sqrt(sum(rest) / sum(all));
  }
} // namespace

/**
 * A block of nearly incompressible rubber, nu = .499, that its weight presses more on one side than on the other: its
 * mean stress is a checkerboard, and with F-bar it is smooth; the volumes that the law sees stay near 1.
 */
template <int dim>
void locking()
{
  const double                  h      = dim == 2 ? 1. / 16 : 1. / 8;
  const std::string             weight = "-3 * (x < 0.4 ? 3 : 1) * min(1, 5*t)";
  const std::string             law    = dim == 2 ? "neo-Hookean" : "Hencky";
  std::map<std::string, double> rough;
  for (const std::string is_on : {"false", "true"})
  {
    std::string normal_walls = dim == 2 ? "0, 1" : "0, 1, 4, 5";
    Run<dim>    run(
         section("Grid", set("Upper corner", coordinates<dim>({{1, 1, 0.5}})) + set("Spacing", std::to_string(h))) +
         section("Run", set("F-bar", is_on) + set("Courant number", "0.4") + set("Local damping", "0.3") +
                          set("Body force", "0; " + weight + (dim == 3 ? "; 0" : ""))) +
         section("Materials", set("Names", "clay") +
                                section("clay", set("Type", law) + set("Density", "1") + set("Young's modulus", "1000") +
                                                  set("Poisson's ratio", "0.499") +
                                                  (law == "Hencky" ? set("Yield stress", "1e5") : ""))) +
         section("Bodies",
                 set("Names", "block") + section("block", set("Upper corner", coordinates<dim>({{1, 0.75, 0.5}})))) +
         section("Conditions", set("Names", "sides, floor") +
                                 section("sides", set("Type", "slip") + set("Boundary ids", normal_walls)) +
                                 section("floor", set("Type", "no-slip") + set("Boundary ids", "2"))));
    while (run.time < 0.3)
      run.step(run.stepper->step_size(run.model, run.report));
    rough[is_on] = roughness(run, h);
    if (is_on == "true")
    {
      const auto &particles = run.model.particles;
      double      change    = 0;
      for (unsigned int p = 0; p < particles.size(); ++p)
        raise(change, determinant(particles.matrix(particles.F, p)) - 1);
      check(law + ": J", max(change), 0.03);
    }
  }
  check_range(law + ": roughness without", rough["false"], 0.1, 10);
  check(law + ": with F-bar, of that", rough["true"] / rough["false"], 0.2);
}

template void locking<2>();
template void locking<3>();

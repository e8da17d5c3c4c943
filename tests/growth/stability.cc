#include <talus/steppers/explicit_step.h>

#include <deal.II/lac/lapack_full_matrix.h>

#include "../setup.h"
#include "stability.h"

#include <random>

using namespace Test;
using namespace dealii;

/**
 * A step as a linear map: a few particles of an inviscid fluid in a box with ghost nodes, frozen where they are, near
 * the state at rest. c = h = rho = 1. The magnitude of the map's largest eigenvalue is what an error grows by in a
 * step.
 */
namespace
{
  const std::string fluid = set("Type", "Newtonian fluid") + set("Density", "1") + set("Sound speed", "1");

  /** Of this Poisson's ratio, with pressure waves as fast. */
  std::string elastic(const double nu)
  {
    return set("Type", "linear elastic") + set("Density", "1") + set("Poisson's ratio", std::to_string(nu)) +
           set("Young's modulus", std::to_string((1 + nu) * (1 - 2 * nu) / (1 - nu)));
  }

  template <int dim>
  std::string one_box(const std::string &kernel, const std::string &transfer, const std::string &conditions,
                      const std::string &material)
  {
    return section("Grid", set("Upper corner", coordinates<dim>({{5, 5, 5}})) + set("Spacing", "1")) +
           kernel_text(kernel, "ghost nodes") + transfer_text(transfer) + conditions +
           section("Materials", set("Names", "water") + section("water", material)) +
           section("Bodies",
                   set("Names", "body") + section("body", set("Lower corner", coordinates<dim>({{1, 1, 1}})) +
                                                            set("Upper corner", coordinates<dim>({{3, 2, 2}}))));
  }

  template <int dim>
  class Frozen
  {
  public:
    static constexpr unsigned int max_particles = 6;

    Frozen(const std::string &kernel, const std::string &transfer, const std::string &conditions,
           const std::string &material = fluid) :
      setup(one_box<dim>(kernel, transfer, conditions, material)),
      particles(setup.particles)
    {
      const auto add = [&](const unsigned int field, const unsigned int n) {
        for (unsigned int c = 0; c < n; ++c)
          columns.push_back(particles.fields[field].first + c);
      };
      add(particles.velocity, dim);
      if (material == fluid)
        add(particles.volume, 1);
      else
        add(particles.stress, WorkingSet<dim>::n_stress);
      if (transfer == "TPIC")
        add(particles.grad_v, dim * dim);
      if (transfer == "APIC")
        add(*particles.find_field("affine moment"), dim * dim);
    }

    /** Puts particles at places, with their masses. */
    void place(const std::vector<Point<dim>> &places, const std::vector<double> &masses)
    {
      particles.resize(places.size());
      particles.material_begin.back() = places.size();
      x                               = places;
      m                               = masses;
    }

    /** The largest magnitude of an eigenvalue of a step. */
    double radius(const double dt)
    {
      const unsigned int       n = columns.size() * x.size();
      LAPACKFullMatrix<double> A(n);
      for (unsigned int j = 0; j < n; ++j)
      {
        // Of fourth order: errors of the derivative are round-off.
        constexpr double          epsilon = 1e-4;
        const std::vector<double> f[4]    = {step(j, epsilon, dt), step(j, -epsilon, dt), step(j, 2 * epsilon, dt),
                                             step(j, -2 * epsilon, dt)};
        for (unsigned int i = 0; i < n; ++i)
          A(i, j) = (8 * (f[0][i] - f[1][i]) - (f[2][i] - f[3][i])) / (12 * epsilon);
      }
      A.compute_eigenvalues();
      double largest = 0;
      for (unsigned int i = 0; i < n; ++i)
        largest = std::max(largest, std::abs(A.eigenvalue(i)));
      return largest;
    }

    Stencil<dim> stencil()
    {
      reset();
      return setup.stencil(0);
    }

  private:
    /** At rest. */
    void reset()
    {
      for (unsigned int c = 0; c < particles.n_columns(); ++c)
        std::fill_n(particles.column(c), x.size(), 0.);
      for (unsigned int p = 0; p < x.size(); ++p)
      {
        for (unsigned int d = 0; d < dim; ++d)
        {
          particles.component(particles.position, d)[p]      = x[p][d];
          particles.component(particles.F, d * (dim + 1))[p] = 1;
        }
        particles.component(particles.mass, 0)[p] = particles.component(particles.volume, 0)[p] = m[p];
      }
    }

    /** The state after a step from rest but for number j of it. Volumes are counted relative to the initial ones. */
    std::vector<double> step(const unsigned int j, const double change, const double dt)
    {
      reset();
      const unsigned int column = columns[j / x.size()], p = j % x.size();
      const bool         is_volume = column == particles.fields[particles.volume].first;
      particles.column(column)[p] += change * (is_volume ? m[p] : 1.);
      auto ranges = material_ranges(particles, 0.);
      if (is_volume) // the stress of this volume
        update_stress(particles, setup.materials, ranges, 0, x.size());
      setup.step(dt);
      ranges = material_ranges(particles, dt);
      update_stress(particles, setup.materials, ranges, 0, x.size());
      std::vector<double> state;
      for (const unsigned int c : columns)
        for (unsigned int q = 0; q < x.size(); ++q)
          state.push_back(particles.column(c)[q] / (c == particles.fields[particles.volume].first ? m[q] : 1.));
      return state;
    }

    Setup<dim>                setup;
    Talus::Particles<dim>    &particles;
    std::vector<unsigned int> columns;
    std::vector<Point<dim>>   x;
    std::vector<double>       m;
  };

  /** A condition for each lower face: slip (s), no-slip (n), or none (f). */
  std::string faces(const std::string &types)
  {
    std::string names, content;
    for (unsigned int d = 0; d < types.size(); ++d)
      if (types[d] != 'f')
      {
        const std::string name = std::string("face") + "xyz"[d];
        names += (names.empty() ? "" : ", ") + name;
        content +=
          section(name, set("Type", types[d] == 's' ? "slip" : "no-slip") + set("Boundary ids", std::to_string(2 * d)));
      }
    return names.empty() ? "" : section("Conditions", set("Names", names) + content);
  }

  /**
   * One to six particles near a corner of a cell, half of their distances from its faces as small as 1e-6: from those
   * of the box if `first` is 0, in the open grid if it is 2.
   */
  template <int dim>
  void arrange(std::mt19937 &random, const double first, Frozen<dim> &frozen)
  {
    const auto uniform = [&](const double from, const double to) {
      return std::uniform_real_distribution<>(from, to)(random);
    };
    std::vector<Point<dim>> places(1 + random() % Frozen<dim>::max_particles);
    std::vector<double>     masses;
    for (auto &x : places)
    {
      for (unsigned int d = 0; d < dim; ++d)
        x[d] = first + (uniform(0, 1) < 0.5 ? std::pow(10., uniform(-6, 0)) : uniform(0, 2));
      masses.push_back(uniform(0.5, 1) / (1u << dim));
    }
    frozen.place(places, masses);
  }

  bool is_alone() { return Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) == 1; }

  template <int dim>
  double greatest_radius(const std::string &kernel, const std::string &transfer, const double courant_number,
                         const unsigned int n, const double first)
  {
    const std::vector<std::string> walls    = dim == 2 ? std::vector<std::string>{"ss", "nn", "sn", "ff", "fs"} :
                                                         std::vector<std::string>{"sss", "nnn", "nns", "fff", "sfn"};
    double                         greatest = 0;
    std::mt19937                   random(17);
    for (const auto &types : walls)
    {
      Frozen<dim> frozen(kernel, transfer, faces(types));
      for (unsigned int k = 0; k < n / walls.size(); ++k)
      {
        arrange(random, first, frozen);
        raise(greatest, frozen.radius(courant_number));
      }
    }
    return greatest;
  }

  template <int dim>
  void scan(const std::string &kernel, const std::string &transfer, const double courant_number, const double bound,
            const unsigned int n)
  {
    const double greatest = greatest_radius<dim>(kernel, transfer, courant_number, n, 0);
    check(std::to_string(dim) + "D, " + kernel + ", " + transfer + " at " + std::to_string(courant_number) +
            ": radius - 1 = " + std::to_string(greatest - 1),
          std::max(0., greatest - 1), bound);
  }

  /** Of a lone particle, how far dt^2 c^2 may go; sharp. */
  template <int dim>
  double limit(const Stencil<dim> &stencil, const std::string &transfer)
  {
    double sigma = 0, q = 0;
    for (unsigned int d = 0; d < dim; ++d)
    {
      double D = 0;
      for (unsigned int k = 0; k < stencil.size; ++k)
      {
        sigma += stencil.weight[k] > 0 ? stencil.gradient[d][k] * stencil.gradient[d][k] / stencil.weight[k] : 0.;
        D += stencil.weight[k] * stencil.offset[d][k] * stencil.offset[d][k];
      }
      q += 1 / D;
    }
    return transfer == "TPIC" ? 4 / sigma : transfer == "APIC" ? 4 / (2 * sigma - q) : 2 / sigma;
  }
} // namespace

/** The limits of doc/walls.md, reached where the kernel bears least. */
template <int dim>
void lone_particles()
{
  if (!is_alone())
    return;
  using Limits       = std::array<double, 3>; // TPIC, APIC, FLIP and PIC
  const auto compare = [](const std::string &kernel, const double t, const Limits &limits,
                          const std::string &material = fluid, const double factor = 1) {
    for (const std::string transfer : {"TPIC", "APIC", "FLIP", "PIC"})
    {
      Frozen<dim> frozen(kernel, transfer, "", material);
      Point<dim>  x;
      for (unsigned int d = 0; d < dim; ++d)
        x[d] = 2 + t;
      frozen.place({x}, {1. / (1u << dim)});
      const double      dt   = factor * std::sqrt(limit(frozen.stencil(), transfer));
      const std::string name = std::to_string(dim) + "D, " + kernel + ", " + transfer + ", " + material.substr(11, 7);
      check(name + ": limit of the table",
            dt / factor - limits[transfer == "TPIC" ? 0 :
                                 transfer == "APIC" ? 1 :
                                                      2],
            6e-3);
      check(name + ": below", std::max(0., frozen.radius(0.98 * dt) - 1), 1e-6);
      check_range(name + ": above", frozen.radius(1.02 * dt), 1.05, 2);
    }
  };
  compare("quadratic B-spline", 0.4999, dim == 2 ? Limits{{0.577, 0.5, 0.408}} : Limits{{0.471, 0.408, 0.333}});
  // Lame's constants of an elastic body: (l + 2 G) over (d l + 2 G) / d.
  for (const double nu : {0., 0.3, 0.45})
    compare("quadratic B-spline", 0.4999, dim == 2 ? Limits{{0.577, 0.5, 0.408}} : Limits{{0.471, 0.408, 0.333}},
            elastic(nu), std::sqrt(dim / (1 + (dim - 1) * nu / (1 - nu))));
  compare("uGIMP", 0.2499, dim == 2 ? Limits{{0.463, 0.387, 0.327}} : Limits{{0.378, 0.316, 0.267}});
  compare("cubic B-spline", 0.7245, dim == 2 ? Limits{{0.80, 0.78, 0.565}} : Limits{{0.65, 0.64, 0.461}});
}

/** Arrangements with small cuts at faces, edges and corners. TPIC's weak growth is its own: the open grid has it too.
 */
template <int dim>
void arrangements(const unsigned int n)
{
  if (!is_alone())
    return;
  scan<dim>("quadratic B-spline", "APIC", dim == 2 ? 0.5 : 0.408, 1e-5, n);
  scan<dim>("quadratic B-spline", "FLIP", dim == 2 ? 0.4 : 0.33, 1e-5, n);
  scan<dim>("quadratic B-spline", "PIC", dim == 2 ? 0.4 : 0.33, 1e-5, n);
  // Rare ones among thousands grow more: they are measured against the same in the open grid.
  const double open =
    n < 500 ? 0 : greatest_radius<dim>("quadratic B-spline", "TPIC", dim == 2 ? 0.577 : 0.47, n, 2) - 1;
  scan<dim>("quadratic B-spline", "TPIC", dim == 2 ? 0.577 : 0.47, std::max(2e-3, open), n);
  scan<dim>("cubic B-spline", "FLIP", dim == 2 ? 0.56 : 0.46, 1e-5, n / 5);
  scan<dim>("uGIMP", "FLIP", dim == 2 ? 0.32 : 0.26, 1e-5, n / 5);
}

template void lone_particles<2>();
template void lone_particles<3>();
template void arrangements<2>(const unsigned int);
template void arrangements<3>(const unsigned int);

#include "../setup.h"

#include <fstream>

using namespace Test;
using namespace dealii;

namespace
{
  /** A field that only kernels with particle domains add: here the test asks for it. */
  template <int dim>
  std::unique_ptr<Setup<dim>> with_half_edges(const std::string &grid, const std::string &body)
  {
    return std::make_unique<Setup<dim>>(section("Grid", grid) + body_text(body), /* half_edges = */ true);
  }

  template <int dim>
  std::array<Tensor<1, dim>, dim> half_edges(const Setup<dim> &setup, const unsigned int p)
  {
    const unsigned int              field = *setup.particles.find_field("half edges");
    std::array<Tensor<1, dim>, dim> edges;
    for (unsigned int e = 0; e < dim; ++e)
      for (unsigned int d = 0; d < dim; ++d)
        edges[e][d] = setup.particles.component(field, dim * e + d)[p];
    return edges;
  }

  /** 2^dim det(r1, r2 (, r3)): positive where they are right-handed. */
  template <int dim>
  double domain_volume(const std::array<Tensor<1, dim>, dim> &edges)
  {
    Tensor<2, dim> matrix;
    for (unsigned int e = 0; e < dim; ++e)
      matrix[e] = edges[e];
    return std::pow(2, dim) * determinant(matrix);
  }

  /** Largest relative difference between a particle's volume and that of its domain. */
  template <int dim>
  double volume_error(const Setup<dim> &setup)
  {
    double error = 0;
    for (unsigned int p = 0; p < setup.particles.size(); ++p)
      raise(error,
            domain_volume<dim>(half_edges(setup, p)) / setup.particles.component(setup.particles.volume, 0)[p] - 1);
    return error;
  }
} // namespace

/** Domains tile their body: boxes of a lattice, squares of the volume for points. */
template <int dim>
void half_edges_of_shapes()
{
  {
    // 5 x 7 (x 3) boxes of different edges; jitter moves points, not the domains' edges.
    const auto setup = with_half_edges<dim>(set("Cells", coordinates<dim>({{5, 7, 3}})),
                                            set("Particles per cell and direction", "1") + set("Jitter", "0.5"));
    double     error = 0;
    for (unsigned int p = 0; p < setup->particles.size(); ++p)
      for (unsigned int e = 0; e < dim; ++e)
        for (unsigned int d = 0; d < dim; ++d)
          raise(error, half_edges(*setup, p)[e][d] - (d != e ? 0. : d == 0 ? 0.1 : d == 1 ? 0.5 / 7 : 0.5 / 3));
    check("lattice: edges", error, 1e-15);
    check("lattice: volume", volume_error(*setup), 1e-14);
  }
  {
    const std::string name = "half_edges_" + std::to_string(dim) + "_" +
                             std::to_string(Utilities::MPI::this_mpi_process(MPI_COMM_WORLD)) + ".txt";
    std::ofstream(name) << (dim == 2 ? "0.1 0.2 0.04\n0.9 0.8 0.01\n" : "0.1 0.2 0.3 0.008\n0.9 0.8 0.4 0.001\n");
    const auto setup = with_half_edges<dim>(set("Spacing", "0.25"), set("Shape", "points") + set("File", name));
    double     error = 0;
    for (unsigned int p = 0; p < setup->particles.size(); ++p)
      for (unsigned int e = 0; e < dim; ++e)
        for (unsigned int d = 0; d < dim; ++d)
          raise(error, half_edges(*setup, p)[e][d] - (d != e ? 0. : setup->particles.id[p] == 0 ? 0.1 : 0.05));
    check("points: edges", error, 1e-15);
    check("points: volume", volume_error(*setup), 1e-14);
    std::remove(name.c_str());
  }
}

/** Places, volumes and half edges of a polar lattice by formulas of the id, for sectors that begin anywhere. */
template <int dim>
void ring()
{
  constexpr double pi = numbers::PI;
  for (const auto &[start, end] :
       {std::pair(0., 360.), {0., 90.}, {-30., 200.}, {170., 190.}, {300., 720.}, {300., 660.}})
  {
    const std::string text = set("Shape", "ring") + set("Centre", coordinates<dim>({{0.1, -0.2, 0.3}})) +
                             set("Inner radius", "0.25") + set("Outer radius", "0.75") +
                             set("Start angle", std::to_string(start)) + set("End angle", std::to_string(end)) +
                             set("Particles", coordinates<dim>({{3, 40, 5}})) + (dim == 3 ? set("Height", "0.2") : "");
    const std::string grid = set("Lower corner", coordinates<dim>({{-1, -1, 0}})) +
                             set("Upper corner", coordinates<dim>({{1, 1, 1}})) +
                             set("Cells", coordinates<dim>({{17, 16, 8}}));
    const std::string name = std::to_string(static_cast<int>(start)) + ".." + std::to_string(static_cast<int>(end));
    if (end - start > 360)
    {
      check_error<EntryError>(name, {"/Bodies/body: End angle", "at most 360"},
                              [&] { Setup<dim> s(section("Grid", grid) + body_text(text)); });
      continue;
    }
    const auto   setup     = with_half_edges<dim>(grid, text);
    const auto  &particles = setup->particles;
    const double dR = 0.5 / 3, dA = (end - start) / 180 * pi / 40, dz = dim == 3 ? 0.04 : 1;
    double       place = 0, edge = 0, volume = 0, total = 0;
    for (unsigned int p = 0; p < particles.size(); ++p)
    {
      const unsigned int id = particles.id[p], i = id % 3, j = id / 3 % 40, k = id / 120;
      const double       R = 0.25 + (i + 0.5) * dR, angle = start / 180 * pi + (j + 0.5) * dA;
      raise(place, setup->position(p)[0] - 0.1 - R * std::cos(angle));
      raise(place, setup->position(p)[1] + 0.2 - R * std::sin(angle));
      if (dim == 3)
        raise(place, setup->position(p)[dim - 1] - 0.3 - (k + 0.5) * dz);
      const auto edges = half_edges(*setup, p);
      raise(edge, edges[0][0] - 0.5 * dR * std::cos(angle));
      raise(edge, edges[0][1] - 0.5 * dR * std::sin(angle));
      raise(edge, edges[1][0] + 0.5 * dA * R * std::sin(angle));
      raise(edge, edges[1][1] - 0.5 * dA * R * std::cos(angle));
      if (dim == 3)
        raise(edge, edges[dim - 1][dim - 1] - 0.5 * dz);
      raise(volume, particles.component(particles.volume, 0)[p] / (R * dR * dA * dz) - 1);
      total += particles.component(particles.volume, 0)[p];
    }
    check_true(name + ": all particles", particles.n_global == (dim == 3 ? 600 : 120));
    check(name + ": places", place, 1e-14);
    check(name + ": half edges", edge, 1e-14);
    check(name + ": volumes", volume, 1e-13);
    check(name + ": volumes of the domains", volume_error(*setup), 1e-13);
    check(name + ": sum of volumes", sum(total) / ((end - start) / 360 * pi * 0.5 * (dim == 3 ? 0.2 : 1)) - 1, 1e-13);
  }
}

/** What a ring cannot be. */
template <int dim>
void ring_errors()
{
  const auto error = [](const std::string &body, const std::string &entry, const std::string &message) {
    check_error<EntryError>(message, {"/Bodies/body: " + entry, message}, [&] {
      Setup<dim> s(section("Grid", set("Lower corner", coordinates<dim>({{-2, -2, -2}})) + set("Spacing", "0.5")) +
                   body_text(set("Shape", "ring") + body));
    });
  };
  error(set("Inner radius", "1"), "Outer radius", "the body is empty");
  error(set("Start angle", "90") + set("End angle", "90"), "End angle", "at most 360");
  error(set("Centre", coordinates<dim>({{0.5, 0.5, 0}})), "Centre", "outside the grid");
  if (dim == 3)
    error(set("Height", "0"), "Height", "the body is empty");
}

#define INSTANTIATE(name)                                                                                              \
  template void name<2>();                                                                                             \
  template void name<3>();
INSTANTIATE(half_edges_of_shapes)
INSTANTIATE(ring)
INSTANTIATE(ring_errors)

#pragma once

#include "../setup.h"

#include <talus/grid/mesh_check.h>
#include <talus/grid/mesh_file.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <utility>
#include <vector>

/** Meshes that tests build themselves, and points in them. */
namespace Test
{
  using Talus::Mesh;

  template <int dim>
  using Coordinates = typename Mesh<dim>::Vector;

  /** A unit box, n cells along each axis, each cut into dim! simplices around its diagonal (Kuhn). */
  template <int dim>
  Mesh<dim> kuhn(const unsigned int n, const std::function<Coordinates<dim>(Coordinates<dim>)> &map = {})
  {
    std::vector<Coordinates<dim>>            positions;
    std::vector<typename Mesh<dim>::Corners> cells;
    unsigned int                             n_nodes = 1, stride[dim];
    for (unsigned int d = 0; d < dim; ++d)
    {
      stride[d] = n_nodes;
      n_nodes *= n + 1;
    }
    for (unsigned int v = 0; v < n_nodes; ++v)
    {
      Coordinates<dim> x;
      bool             is_corner = true;
      for (unsigned int d = 0; d < dim; ++d)
      {
        x[d]      = static_cast<double>(v / stride[d] % (n + 1)) / n;
        is_corner = is_corner && v / stride[d] % (n + 1) < n;
      }
      positions.push_back(map ? map(x) : x);
      std::array<unsigned int, dim> order;
      for (unsigned int d = 0; d < dim; ++d)
        order[d] = d;
      // From the lower to the upper corner of the box along its edges, in each order of the axes.
      if (is_corner)
        do
        {
          typename Mesh<dim>::Corners cell;
          cell[0] = v;
          for (unsigned int d = 0; d < dim; ++d)
            cell[d + 1] = cell[d] + stride[order[d]];
          cells.push_back(cell);
        } while (std::next_permutation(order.begin(), order.end()));
    }
    Mesh<dim> mesh;
    mesh.reinit(positions, cells);
    return mesh;
  }

  /** Its inner vertices moved at random, by at most this share of the spacing along each axis. */
  template <int dim>
  Mesh<dim> jittered(const unsigned int n, const double share)
  {
    std::mt19937                           random(5);
    std::uniform_real_distribution<double> uniform(-share / n, share / n);
    return kuhn<dim>(n, [&](Coordinates<dim> x) {
      const auto is_inside = [](const double c) { return c > 0 && c < 1; };
      if (std::all_of(x.begin(), x.end(), is_inside))
        for (double &c : x)
          c += uniform(random);
      return x;
    });
  }

  /** Cells that grow along the first axis, as 1 to 4. */
  template <int dim>
  Mesh<dim> graded(const unsigned int n)
  {
    return kuhn<dim>(n, [](Coordinates<dim> x) {
      x[0] = (std::pow(4., x[0]) - 1) / 3;
      return x;
    });
  }

  /** A file beside the tests. */
  inline std::string data(const std::string &name)
  {
    const std::string here = __FILE__;
    return here.substr(0, here.rfind('/')) + "/data/" + name;
  }

  template <int dim>
  Mesh<dim> mesh_of(const Talus::MeshInput<dim> &input)
  {
    Mesh<dim> mesh;
    mesh.reinit(input.positions, input.cells);
    return mesh;
  }

  /** Delaunay meshes by gmsh. */
  template <int dim>
  Talus::MeshInput<dim> gmsh()
  {
    return Talus::read_msh<dim>(data(dim == 2 ? "plate.msh" : "block.msh"));
  }

  template <int dim>
  std::vector<std::pair<std::string, Mesh<dim>>> meshes()
  {
    const unsigned int                             n      = dim == 1 ? 12 : dim == 2 ? 6 : 3;
    std::vector<std::pair<std::string, Mesh<dim>>> meshes = {
      {"structured", kuhn<dim>(n)}, {"jittered", jittered<dim>(n, .2)}, {"graded", graded<dim>(n)}};
    if constexpr (dim > 1)
      meshes.emplace_back("gmsh", mesh_of(gmsh<dim>()));
    return meshes;
  }

  /** The point with barycentric coordinates B. */
  template <int dim>
  Coordinates<dim> point(const Mesh<dim> &mesh, const unsigned int cell, const typename Mesh<dim>::Barycentric &B)
  {
    Coordinates<dim> x{};
    for (unsigned int k = 0; k <= dim; ++k)
      for (unsigned int d = 0; d < dim; ++d)
        x[d] += B[k] * mesh.position[mesh.nodes[cell][k]][d];
    return x;
  }

  /** Random barycentric coordinates; those of `zero` (a set of vertices) vanish. */
  template <int dim>
  typename Mesh<dim>::Barycentric barycentric(std::mt19937 &random, const unsigned int zero = 0)
  {
    std::uniform_real_distribution<double> uniform(.02, 1.);
    typename Mesh<dim>::Barycentric        B;
    double                                 sum = 0;
    for (unsigned int k = 0; k <= dim; ++k)
      sum += B[k] = zero >> k & 1 ? 0. : uniform(random);
    for (double &b : B)
      b /= sum;
    return B;
  }

  /** Calls `visit(cell, x)` for points within each cell and on all its faces, edges and vertices. */
  template <int dim, class Visitor>
  void for_points(const Mesh<dim> &mesh, const unsigned int n, const Visitor &visit)
  {
    std::mt19937 random(3);
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
    {
      for (unsigned int zero = 1; zero + 1 < 2u << dim; ++zero)
        visit(c, point(mesh, c, barycentric<dim>(random, zero)));
      for (unsigned int i = 0; i < n; ++i)
        visit(c, point(mesh, c, barycentric<dim>(random)));
      typename Mesh<dim>::Barycentric middle;
      middle.fill(1. / (dim + 1));
      visit(c, point(mesh, c, middle));
    }
  }

  /** Calls `visit(cell, neighbour, x)` for points on each inner face. */
  template <int dim, class Visitor>
  void for_face_points(const Mesh<dim> &mesh, const unsigned int n, const Visitor &visit)
  {
    std::mt19937 random(4);
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      for (unsigned int k = 0; k <= dim; ++k)
        if (const unsigned int beyond = mesh.neighbours[c][k]; beyond != mesh.missing && beyond > c)
          for (unsigned int i = 0; i < n; ++i)
            visit(c, beyond, point(mesh, c, barycentric<dim>(random, 1u << k)));
  }
} // namespace Test

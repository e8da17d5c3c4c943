#pragma once

#include <talus/grid/closed_surface.h>

#include "check.h"

#include <cstdint>
#include <cstdio>
#include <fstream>
#include <map>
#include <sstream>
#include <unistd.h>

/** Closed surfaces whose volumes are known, and files of them. */
namespace Test
{
  using Corners = std::vector<dealii::Point<3>>; // three of each triangle

  /** A quadrilateral as two triangles. */
  inline void add_quadrilateral(Corners &corners, const dealii::Point<3> &a, const dealii::Point<3> &b,
                                const dealii::Point<3> &c, const dealii::Point<3> &d)
  {
    corners.insert(corners.end(), {a, b, c, a, c, d});
  }

  /** A box, each face in n^2 squares; outward. */
  inline Corners box_surface(const dealii::Point<3> &lower, const dealii::Point<3> &upper, const unsigned int n = 1)
  {
    Corners corners;
    for (unsigned int axis = 0; axis < 3; ++axis)
      for (const bool is_upper : {false, true})
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int j = 0; j < n; ++j)
          {
            const unsigned int u = (axis + 1) % 3, v = (axis + 2) % 3;
            const auto         at = [&](const unsigned int a, const unsigned int b) {
              dealii::Point<3> x;
              x[axis] = is_upper ? upper[axis] : lower[axis];
              x[u]    = lower[u] + (upper[u] - lower[u]) * a / n;
              x[v]    = lower[v] + (upper[v] - lower[v]) * b / n;
              return x;
            };
            if (is_upper)
              add_quadrilateral(corners, at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
            else
              add_quadrilateral(corners, at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j));
          }
    return corners;
  }

  /** A sphere: that of a box, its points drawn to the radius; a polyhedron of less volume than the ball. */
  inline Corners sphere_surface(const dealii::Point<3> &centre, const double radius, const unsigned int n)
  {
    Corners corners = box_surface(dealii::Point<3>(-1, -1, -1), dealii::Point<3>(1, 1, 1), n);
    for (auto &x : corners)
    {
      // Tangents make the squares alike in size.
      for (unsigned int d = 0; d < 3; ++d)
        x[d] = std::abs(x[d]) == 1 ? x[d] : std::tan(dealii::numbers::PI / 4 * x[d]);
      x = centre + radius / x.norm() * dealii::Tensor<1, 3>(x);
    }
    return corners;
  }

  /** A torus around the z axis. */
  inline Corners torus_surface(const dealii::Point<3> &centre, const double large, const double small,
                               const unsigned int n)
  {
    Corners    corners;
    const auto at = [&](const unsigned int i, const unsigned int j) {
      const double a = 2 * dealii::numbers::PI * (i % n) / n, b = 2 * dealii::numbers::PI * (j % n) / n,
                   r = large + small * std::cos(b);
      return dealii::Point<3>(centre[0] + r * std::cos(a), centre[1] + r * std::sin(a),
                              centre[2] + small * std::sin(b));
    };
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        add_quadrilateral(corners, at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
    return corners;
  }

  /** A file that rank 0 writes, and that is gone with the object. Collective. */
  class TemporaryFile
  {
  public:
    TemporaryFile(const std::string &ending, const std::string &content)
    {
      static int n     = 0;
      const bool is_me = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
      const int  id    = dealii::Utilities::MPI::sum(is_me ? static_cast<int>(getpid()) : 0, MPI_COMM_WORLD);
      name             = "/tmp/talus_test_" + std::to_string(id) + "_" + std::to_string(n++) + ending;
      if (is_me)
        std::ofstream(name, std::ios::binary) << content;
      MPI_Barrier(MPI_COMM_WORLD);
    }
    ~TemporaryFile()
    {
      MPI_Barrier(MPI_COMM_WORLD);
      if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
        std::remove(name.c_str());
    }
    TemporaryFile(const TemporaryFile &) = delete;

    std::string name;
  };

  inline std::string stl_text(const Corners &corners)
  {
    std::ostringstream text;
    text << std::setprecision(17) << "solid test\n";
    for (unsigned int c = 0; c < corners.size(); c += 3)
    {
      text << "  facet normal 0 0 0\n    outer loop\n";
      for (unsigned int k = 0; k < 3; ++k)
        text << "      vertex " << corners[c + k] << '\n';
      text << "    endloop\n  endfacet\n";
    }
    text << "endsolid test\n";
    return text.str();
  }

  inline std::string stl_binary(const Corners &corners)
  {
    std::string         bytes = "solid although it is binary";
    const std::uint32_t n     = corners.size() / 3;
    bytes.resize(80, ' ');
    bytes.append(reinterpret_cast<const char *>(&n), 4);
    for (unsigned int c = 0; c < corners.size(); c += 3)
    {
      float numbers[12] = {};
      for (unsigned int k = 0; k < 9; ++k)
        numbers[3 + k] = static_cast<float>(corners[c + k / 3][k % 3]);
      bytes.append(reinterpret_cast<const char *>(numbers), 48);
      bytes.append(2, '\0');
    }
    return bytes;
  }
} // namespace Test

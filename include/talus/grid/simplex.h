#pragma once

#include <array>
#include <cmath>

namespace Talus
{
  /** The edges x_k - x_0 of a simplex; edge k is row k. */
  template <std::size_t dim>
  using Edges = std::array<std::array<double, dim>, dim>;

  template <class Number, std::size_t dim>
  Number determinant(const std::array<std::array<Number, dim>, dim> &E)
  {
    if constexpr (dim == 1)
      return E[0][0];
    else if constexpr (dim == 2)
      return E[0][0] * E[1][1] - E[0][1] * E[1][0];
    else
      return E[0][0] * (E[1][1] * E[2][2] - E[1][2] * E[2][1]) - E[0][1] * (E[1][0] * E[2][2] - E[1][2] * E[2][0]) +
             E[0][2] * (E[1][0] * E[2][1] - E[1][1] * E[2][0]);
  }

  /** The rows g_k with g_k . edge_l = delta_kl: gradients of the barycentric coordinates 1, ..., dim. */
  template <class Number, std::size_t dim>
  std::array<std::array<Number, dim>, dim> dual(const std::array<std::array<Number, dim>, dim> &E)
  {
    const Number                             scale = 1. / determinant(E);
    std::array<std::array<Number, dim>, dim> g;
    if constexpr (dim == 1)
      g[0][0] = scale;
    else if constexpr (dim == 2)
      g = {{{{scale * E[1][1], -scale * E[1][0]}}, {{-scale * E[0][1], scale * E[0][0]}}}};
    else
      for (unsigned int k = 0; k < 3; ++k)
      {
        const auto &a = E[(k + 1) % 3], &b = E[(k + 2) % 3];
        for (unsigned int e = 0; e < 3; ++e)
          g[k][e] = scale * (a[(e + 1) % 3] * b[(e + 2) % 3] - a[(e + 2) % 3] * b[(e + 1) % 3]);
      }
    return g;
  }

  /** Edges of the simplex with these vertices, the first as origin. */
  template <std::size_t dim, class Positions>
  Edges<dim> edges(const Positions &position, const std::array<unsigned int, dim + 1> &vertices)
  {
    Edges<dim> E;
    for (unsigned int k = 0; k < dim; ++k)
      for (unsigned int e = 0; e < dim; ++e)
        E[k][e] = position[vertices[k + 1]][e] - position[vertices[0]][e];
    return E;
  }

  template <std::size_t dim>
  double distance(const std::array<double, dim> &a, const std::array<double, dim> &b)
  {
    double square = 0;
    for (unsigned int e = 0; e < dim; ++e)
      square += (a[e] - b[e]) * (a[e] - b[e]);
    return std::sqrt(square);
  }
} // namespace Talus

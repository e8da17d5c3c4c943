#pragma once

#include <talus/grid/mesh.h>

#include <array>
#include <cmath>

namespace Talus
{
  /**
   * How the barycentric coordinates of a point and of its feet on the simplex's faces go together: the foot on face a
   * (opposite to vertex a) has @f$ \hat B_j = B_j + \lambda_j^a B_a @f$ for the vertices j of the face, with
   * @f$ \lambda_j^a = -\nabla B_j\cdot\nabla B_a/|\nabla B_a|^2 @f$; likewise for the faces of the faces.
   */
  template <int n>
  struct FootCoordinates
  {
    using Gram = std::array<std::array<double, n + 1>, n + 1>;

    double                 lambda[n + 1][n + 1]; // [a][j]
    FootCoordinates<n - 1> face[n + 1];          // vertices in their order here, without a

    /** From G_jk = grad B_j . grad B_k. */
    void reinit(const Gram &G)
    {
      for (unsigned int a = 0; a <= n; ++a)
      {
        for (unsigned int j = 0; j <= n; ++j)
          lambda[a][j] = -G[j][a] / G[a][a];
        // Within the face the gradients lose their part along its normal grad B_a.
        typename FootCoordinates<n - 1>::Gram in_face;
        for (unsigned int j = 0; j < n; ++j)
          for (unsigned int k = 0; k < n; ++k)
            in_face[j][k] = G[j + (j >= a)][k + (k >= a)] - G[j + (j >= a)][a] * G[a][k + (k >= a)] / G[a][a];
        face[a].reinit(in_face);
      }
    }
  };
  template <>
  struct FootCoordinates<1>
  {
    using Gram = std::array<std::array<double, 2>, 2>;
    void reinit(const Gram &) {}
  };

  /** Those of all cells of a mesh. */
  template <int dim>
  std::vector<FootCoordinates<dim>> foot_coordinates(const Mesh<dim> &mesh);

  /** Shares of a simplex's vertices that add up to 1, and slope[i][c] = d eta_i/d B_c. */
  template <int n>
  struct C1Shares
  {
    double eta[n + 1], slope[n + 1][n + 1];
  };

  /**
   * A partition of unity on simplices that is continuously differentiable across faces. On an edge
   * @f$ \eta_0 = f(B_0) @f$, @f$ \eta_1 = 1 - \eta_0 @f$, @f$ f(t) = t^2(3 - 2t) @f$ with t clipped to [0, 1]. In a
   * triangle or tetrahedron it blends those of the feet on its faces,
   * @f[ \eta = \sum_a W_a\,\eta^{(a)}(\hat B^{(a)}) , \quad W_a = B_a^{-2} / \sum_c B_c^{-2} , @f]
   * so that near a face value and slope are those of the face alone, extended along its normal.
   *
   * Where two coordinates vanish (edges of tetrahedra, vertices of triangles) W is 0/0, while the feet on both faces,
   * and with them what is blended, agree to second order: the face that is nearest counts alone. Test:
   * tests/mesh/partition.cc.
   */
  template <int n>
  C1Shares<n> c1_shares(const FootCoordinates<n> &feet, const std::array<double, n + 1> &B);

  template <>
  inline C1Shares<1> c1_shares<1>(const FootCoordinates<1> &, const std::array<double, 2> &B)
  {
    const double t     = std::min(std::max(B[0], 0.), 1.);
    const double f     = t * t * (3 - 2 * t);
    const double slope = 6 * t * (1 - t);
    return {{f, 1 - f}, {{slope, 0}, {-slope, 0}}};
  }

  /** Adds the shares of the foot on face a, `factor` times; returns their values there. */
  template <int n>
  std::array<double, n + 1> add_face(const unsigned int a, const double factor, const FootCoordinates<n> &feet,
                                     const std::array<double, n + 1> &B, C1Shares<n> &shares)
  {
    const auto            outer  = [a](const unsigned int j) { return j + (j >= a); };
    const auto           &lambda = feet.lambda[a];
    std::array<double, n> foot;
    for (unsigned int j = 0; j < n; ++j)
      foot[j] = B[outer(j)] + lambda[outer(j)] * B[a];
    const auto                on_face = c1_shares<n - 1>(feet.face[a], foot);
    std::array<double, n + 1> values{};
    for (unsigned int i = 0; i < n; ++i)
    {
      values[outer(i)] = on_face.eta[i];
      shares.eta[outer(i)] += factor * on_face.eta[i];
      for (unsigned int j = 0; j < n; ++j)
      {
        shares.slope[outer(i)][outer(j)] += factor * on_face.slope[i][j];
        shares.slope[outer(i)][a] += factor * on_face.slope[i][j] * lambda[outer(j)];
      }
    }
    return values;
  }

  template <int n>
  C1Shares<n> c1_shares(const FootCoordinates<n> &feet, const std::array<double, n + 1> &B)
  {
    C1Shares<n>  shares{};
    unsigned int nearest = 0;
    for (unsigned int a = 1; a <= n; ++a)
      if (std::abs(B[a]) < std::abs(B[nearest]))
        nearest = a;
    double second = 1;
    for (unsigned int a = 0; a <= n; ++a)
      if (a != nearest)
        second = std::min(second, std::abs(B[a]));
    // Blending here would divide round-off by this distance; without it slopes are wrong by as much.
    if (second < 1e-8)
    {
      add_face<n>(nearest, 1., feet, B, shares);
      return shares;
    }

    double ratio[n + 1], sum = 0; // B_nearest/B_a: W without division by 0
    for (unsigned int a = 0; a <= n; ++a)
    {
      ratio[a] = a == nearest ? 1. : B[nearest] / B[a];
      sum += ratio[a] * ratio[a];
    }
    std::array<double, n + 1> values[n + 1];
    for (unsigned int a = 0; a <= n; ++a)
      values[a] = add_face<n>(a, ratio[a] * ratio[a] / sum, feet, B, shares);

    // d W_a/d B_c = 2 W_a W_c/B_c for a != c; the rows of all a add up to 0.
    for (unsigned int c = 0; c <= n; ++c)
      for (unsigned int a = 0; a <= n; ++a)
        if (a != c)
        {
          const double by_B_c = c == nearest ? ratio[a] / B[a] : ratio[a] * ratio[a] * ratio[c] * ratio[c] / B[c];
          for (unsigned int i = 0; i <= n; ++i)
            shares.slope[i][c] += 2 * by_B_c / (sum * sum) * (values[a][i] - values[c][i]);
        }
    return shares;
  }
} // namespace Talus

#pragma once

#include <talus/core/simd.h>

#include <array>

namespace Talus
{
  /**
   * How the barycentric coordinates of a point and of its feet on the faces of its cell go together: the foot on face a
   * (opposite to vertex a) has @f$ \hat B_j = B_j + \lambda_j^a B_a @f$ for the vertices j of the face, with
   * @f$ \lambda_j^a = -\nabla B_j\cdot\nabla B_a/|\nabla B_a|^2 @f$; likewise for the edges of the faces of a
   * tetrahedron.
   */
  template <int dim, class Number>
  struct Feet;

  template <class Number>
  struct Feet<1, Number>
  {
  };

  template <class Number>
  struct Feet<2, Number>
  {
    Number lambda[3][3]; // [a][j]
  };

  /** Vertex j of face a is vertex (a + 1 + j) % 4 of the cell. */
  template <class Number>
  struct Feet<3, Number>
  {
    Number lambda[4][3];         // [a][j]
    Number face_lambda[4][3][3]; // [a][b][j], of the edge opposite to vertex b of face a
  };

  namespace internal
  {
    /** G_jk = grad B_j . grad B_k, of n vertices. */
    template <int n, class Number>
    using Gram = std::array<std::array<Number, n>, n>;

    template <class Number>
    [[gnu::always_inline]] inline void set_feet(const Gram<2, Number> &, Feet<1, Number> &)
    {
    }

    template <class Number>
    [[gnu::always_inline]] inline void set_lambda(const Gram<3, Number> &G, Number (&lambda)[3][3])
    {
      for (int a = 0; a < 3; ++a)
      {
        const Number scale = -1. / G[a][a];
        for (int j = 0; j < 3; ++j)
          lambda[a][j] = scale * G[j][a];
      }
    }

    template <class Number>
    [[gnu::always_inline]] inline void set_feet(const Gram<3, Number> &G, Feet<2, Number> &feet)
    {
      set_lambda(G, feet.lambda);
    }

    template <class Number>
    [[gnu::always_inline]] inline void set_feet(const Gram<4, Number> &G, Feet<3, Number> &feet)
    {
      for (int a = 0; a < 4; ++a)
      {
        const auto      outer = [a](const int j) { return (a + 1 + j) % 4; };
        const Number    scale = -1. / G[a][a];
        Gram<3, Number> in_face; // there the gradients have no part along its normal grad B_a
        for (int j = 0; j < 3; ++j)
          feet.lambda[a][j] = scale * G[outer(j)][a];
        for (int j = 0; j < 3; ++j)
          for (int k = 0; k <= j; ++k)
            in_face[j][k] = in_face[k][j] = G[outer(j)][outer(k)] + feet.lambda[a][j] * G[a][outer(k)];
        set_lambda(in_face, feet.face_lambda[a]);
      }
    }
  } // namespace internal

  /**
   * Those of a cell with these gradients of B. They are found for each point: reading them from memory takes as long,
   * and there are 48 of a tetrahedron.
   */
  template <int dim, class Number>
  [[gnu::always_inline]] inline Feet<dim, Number> feet_of(const std::array<std::array<Number, dim>, dim + 1> &grad_B)
  {
    internal::Gram<dim + 1, Number> G;
    for (int j = 0; j <= dim; ++j)
      for (int k = 0; k <= j; ++k)
      {
        Number sum = 0.;
        for (int d = 0; d < dim; ++d)
          sum += grad_B[j][d] * grad_B[k][d];
        G[j][k] = G[k][j] = sum;
      }
    Feet<dim, Number> feet;
    internal::set_feet(G, feet);
    return feet;
  }

  /** Shares of a simplex's n vertices that add up to 1, and slope[i][c] = d eta_i/d B_c, all B_c taken as independent.
   */
  template <int n, class Number = double>
  struct C1Shares
  {
    Number eta[n], slope[n][n];
  };

  namespace internal
  {
    /**
     * f(t) = t^2 (3 - 2t) and its slope, t clipped to [0, 1], and f(u) = 1 - f(t) for u = 1 - t: each with all its
     * digits where it is small, so that value and slope vanish together.
     */
    template <class Number>
    void ramp(Number t, Number u, Number &value, Number &rest, Number &slope)
    {
      t     = min(max(t, Number(0.)), Number(1.));
      u     = min(max(u, Number(0.)), Number(1.));
      value = t * t * (3. - 2. * t);
      rest  = u * u * (3. - 2. * u);
      slope = 6. * t * u;
    }

    /**
     * W_a = B_a^-2 / sum_c B_c^-2, and by[a][c] = W_a W_c/B_c for a != c, so that d W_a/d B_c = 2 by[a][c] and
     * d W_c/d B_c = - 2 sum_a by[a][c]. Formed from products of the B, so that nothing is divided by 0 on a face.
     *
     * Where two coordinates vanish, within 1e-8, the face of the least counts alone: both feet, and with them what is
     * blended, agree to second order there, while round-off would be divided by that distance.
     */
    template <int n, class Number>
    void blend(const Number (&B)[n], Number (&W)[n], Number (&by)[n][n])
    {
      const Number tiny = 1e-8;
      Number       square[n], product[n], sum = 0.;
      for (int a = 0; a < n; ++a)
        square[a] = B[a] * B[a];
      for (int a = 0; a < n; ++a)
      {
        product[a] = 1.;
        for (int b = 0; b < n; ++b)
          if (b != a)
            product[a] *= square[b];
        sum += product[a];
      }
      Number least = abs(B[0]), second = 1.;
      for (int a = 1; a < n; ++a)
      {
        const Number next = abs(B[a]);
        second            = min(second, max(least, next));
        least             = min(least, next);
      }
      const auto   is_edge = second < tiny;
      const Number scale   = 1. / select(is_edge, Number(1.), sum);
      Number       left    = 1.; // for the first of the least alone
      for (int a = 0; a < n; ++a)
      {
        const Number alone = select(abs(B[a]) <= least, left, Number(0.));
        left -= alone;
        W[a] = select(is_edge, alone, product[a] * scale);
      }
      for (int a = 0; a < n; ++a)
        for (int c = 0; c < n; ++c)
          if (a != c)
          {
            Number rest = B[c];
            for (int b = 0; b < n; ++b)
              if (b != a && b != c)
                rest *= square[b];
            by[a][c] = select(is_edge, Number(0.), W[c] * rest * scale);
          }
    }

    /** Adds what the change of the weights W brings: values[a][i] is what face a has for vertex i. */
    template <int n, class Number>
    void add_slopes_of_weights(const Number (&by)[n][n], const Number (&values)[n][n], C1Shares<n, Number> &shares)
    {
      for (int a = 0; a < n; ++a)
        for (int c = 0; c < a; ++c)
          for (int i = 0; i < n; ++i)
          {
            const Number difference = 2. * (values[a][i] - values[c][i]);
            shares.slope[i][c] += by[a][c] * difference;
            shares.slope[i][a] -= by[c][a] * difference;
          }
    }

    /** The shares of a triangle's vertices, lane by lane. */
    template <class Number>
    C1Shares<3, Number> triangle_shares(const Number (&lambda)[3][3], const Number (&B)[3])
    {
      Number W[3], by[3][3], values[3][3];
      blend<3, Number>(B, W, by);
      C1Shares<3, Number> shares;
      for (int i = 0; i < 3; ++i)
      {
        shares.eta[i] = 0.;
        for (Number &slope : shares.slope[i])
          slope = 0.;
      }
      for (int a = 0; a < 3; ++a)
      {
        const int j = (a + 1) % 3, k = (a + 2) % 3;
        Number    slope;
        values[a][a] = 0.;
        ramp<Number>(B[j] + lambda[a][j] * B[a], B[k] + lambda[a][k] * B[a], values[a][j], values[a][k], slope);
        shares.eta[j] += W[a] * values[a][j];
        shares.eta[k] += W[a] * values[a][k];
        slope *= W[a];
        shares.slope[j][j] += slope;
        shares.slope[k][j] -= slope;
        shares.slope[j][a] += slope * lambda[a][j];
        shares.slope[k][a] -= slope * lambda[a][j];
      }
      add_slopes_of_weights<3, Number>(by, values, shares);
      return shares;
    }
  } // namespace internal

  /**
   * A partition of unity on simplices that is continuously differentiable across faces. On an edge
   * @f$ \eta_0 = f(B_0) @f$, @f$ \eta_1 = 1 - \eta_0 @f$, @f$ f(t) = t^2(3 - 2t) @f$ with t clipped to [0, 1]. In a
   * triangle or tetrahedron it blends those of the feet on its faces,
   * @f[ \eta = \sum_a W_a\,\eta^{(a)}(\hat B^{(a)}) , \quad W_a = B_a^{-2} / \sum_c B_c^{-2} , @f]
   * so that near a face value and slope are those of the face alone, extended along its normal.
   * Test: tests/mesh/partition.cc.
   */
  template <class Number>
  [[gnu::always_inline]] inline C1Shares<2, Number> c1_shares(const Feet<1, Number> &, const std::array<Number, 2> &B)
  {
    Number f, rest, slope;
    internal::ramp<Number>(B[0], B[1], f, rest, slope);
    return {{f, rest}, {{slope, 0.}, {-slope, 0.}}};
  }

  template <class Number>
  [[gnu::always_inline]] inline C1Shares<3, Number> c1_shares(const Feet<2, Number>       &feet,
                                                              const std::array<Number, 3> &B)
  {
    return internal::triangle_shares<Number>(feet.lambda, {B[0], B[1], B[2]});
  }

  template <class Number>
  [[gnu::always_inline]] inline C1Shares<4, Number> c1_shares(const Feet<3, Number>       &feet,
                                                              const std::array<Number, 4> &B)
  {
    Number W[4], by[4][4], values[4][4];
    internal::blend<4, Number>({B[0], B[1], B[2], B[3]}, W, by);
    C1Shares<4, Number> shares;
    for (int i = 0; i < 4; ++i)
    {
      shares.eta[i] = 0.;
      for (Number &slope : shares.slope[i])
        slope = 0.;
    }
    for (int a = 0; a < 4; ++a)
    {
      Number foot[3];
      for (int j = 0; j < 3; ++j)
        foot[j] = B[(a + 1 + j) % 4] + feet.lambda[a][j] * B[a];
      const auto on_face = internal::triangle_shares<Number>(feet.face_lambda[a], foot);
      values[a][a]       = 0.;
      for (int i = 0; i < 3; ++i)
      {
        const int outer  = (a + 1 + i) % 4;
        values[a][outer] = on_face.eta[i];
        shares.eta[outer] += W[a] * values[a][outer];
        for (int j = 0; j < 3; ++j)
        {
          const Number slope = W[a] * on_face.slope[i][j];
          shares.slope[outer][(a + 1 + j) % 4] += slope;
          shares.slope[outer][a] += slope * feet.lambda[a][j];
        }
      }
    }
    internal::add_slopes_of_weights<4, Number>(by, values, shares);
    return shares;
  }
} // namespace Talus

#pragma once

#include <talus/kernels/stencil.h>

#include <array>

namespace Talus
{
  /**
   * The moment matrix of the linear basis P = [1, (x_i - x_p)/h], Eq. (55), and
   * its inverse; offsets are scaled so that it is well conditioned.
   */
  template <int dim>
  struct MomentMatrix
  {
    static constexpr unsigned int n = dim + 1;
    using Matrix                    = std::array<std::array<double, n>, n>;
    using Vector                    = std::array<double, n>;

    /** P at node k of the stencil. */
    static Vector basis(const Stencil<dim> &stencil, const unsigned int k, const std::array<double, dim> &inverse_h)
    {
      Vector P;
      P[0] = 1;
      for (unsigned int d = 0; d < dim; ++d)
        P[d + 1] = stencil.offset[d][k] * inverse_h[d];
      return P;
    }

    /** sum_i w_i P_i P_i^T. */
    static Matrix moments(const Stencil<dim> &stencil, const double *weight, const std::array<double, dim> &inverse_h)
    {
      Matrix M{};
      for (unsigned int k = 0; k < stencil.size; ++k)
      {
        const Vector P = basis(stencil, k, inverse_h);
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int j = 0; j <= i; ++j)
            M[i][j] += weight[k] * P[i] * P[j];
      }
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < i; ++j)
          M[j][i] = M[i][j];
      return M;
    }

    /** Inverse of a symmetric positive definite matrix by Gauss-Jordan without pivoting. */
    static Matrix inverse(Matrix M)
    {
      for (unsigned int k = 0; k < n; ++k)
      {
        const double pivot = 1 / M[k][k];
        M[k][k]            = 1;
        for (unsigned int j = 0; j < n; ++j)
          M[k][j] *= pivot;
        for (unsigned int i = 0; i < n; ++i)
          if (i != k)
          {
            const double factor = M[i][k];
            M[i][k]             = 0;
            for (unsigned int j = 0; j < n; ++j)
              M[i][j] -= factor * M[k][j];
          }
      }
      return M;
    }
  };
} // namespace Talus

#pragma once

#include <talus/core/simd.h>

#include <array>

namespace Talus
{
  /** M = sum_v w_v p_v p_v^T of the linear basis p = [1, d], added up register by register. */
  template <int dim, int width>
  class MomentSums
  {
  public:
    static constexpr unsigned int n = dim + 1;
    using Lanes                     = Simd<width>;
    using Matrix                    = std::array<std::array<double, n>, n>;

    MomentSums()
    {
      for (auto &lanes : sums)
        lanes = 0.;
    }

    void add(const Lanes &weight, const Lanes (&d)[dim])
    {
      sums[0] += weight;
      unsigned int k = 1;
      for (unsigned int i = 0; i < dim; ++i)
      {
        const Lanes first = weight * d[i];
        sums[k++] += first;
        for (unsigned int j = 0; j <= i; ++j)
          sums[k++] += first * d[j];
      }
    }

    /** M^-1, of a positive definite M, by Gauss-Jordan elimination without pivoting. */
    Matrix inverse() const
    {
      Matrix M;
      for (unsigned int i = 0, k = 0; i < n; ++i)
        for (unsigned int j = 0; j <= i; ++j)
          M[i][j] = M[j][i] = sum(sums[k++]);
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

    /** Sum of all lanes, in a fixed order. */
    static double sum(const Lanes &lanes)
    {
      double result = 0;
      for (int l = 0; l < width; ++l)
        result += lanes[l];
      return result;
    }

  private:
    Lanes sums[(dim + 1) * (dim + 2) / 2]; // lower triangle of M, row by row
  };
} // namespace Talus

#pragma once

#include <talus/core/simd.h>
#include <talus/grid/simplex.h>

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

    /**
     * M^-1 of a positive definite M, by its block of the second moments about the mean c of d,
     * @f[ S = \sum w\,d d^T - m\,c c^T , \quad M^{-1} =
     *     \begin{pmatrix} 1/m + c^T S^{-1} c & -c^T S^{-1} \\ -S^{-1} c & S^{-1} \end{pmatrix} , \quad m = \sum w . @f]
     */
    Matrix inverse() const
    {
      const double m = sum(sums[0]), inverse_m = 1 / m;
      double       c[dim];
      Edges<dim>   S;
      for (unsigned int i = 0, k = 1; i < dim; ++i)
      {
        c[i] = inverse_m * sum(sums[k++]);
        for (unsigned int j = 0; j <= i; ++j)
          S[i][j] = S[j][i] = sum(sums[k++]) - m * c[i] * c[j];
      }
      const auto inverse_S = dual(S);
      Matrix     result;
      result[0][0] = inverse_m;
      for (unsigned int i = 0; i < dim; ++i)
      {
        double shift = 0;
        for (unsigned int j = 0; j < dim; ++j)
        {
          result[i + 1][j + 1] = inverse_S[i][j];
          shift += inverse_S[i][j] * c[j];
        }
        result[i + 1][0] = result[0][i + 1] = -shift;
        result[0][0] += c[i] * shift;
      }
      return result;
    }

    /** Sum of all lanes: the upper half is added to the lower until one is left. */
    static double sum(const Lanes &lanes)
    {
      static_assert(width == 8, "three halves");
      const double *x    = lanes.data();
      const auto    four = Simd<4>::load(x) + Simd<4>::load(x + 4);
      const auto    two  = Simd<2>::load(four.data()) + Simd<2>::load(four.data() + 2);
      return two[0] + two[1];
    }

  private:
    Lanes sums[(dim + 1) * (dim + 2) / 2]; // lower triangle of M, row by row
  };
} // namespace Talus

#pragma once

#include <algorithm>
#include <vector>

namespace Talus
{
  /**
   * A small symmetric matrix, positive semidefinite: M x = b by Cholesky's method. An unknown whose pivot is `floor` at
   * most, or nothing but round-off of its diagonal entry, is left out: it stays 0. An unknown may be fixed as well:
   * then it keeps its value, and the others feel it. Test: tests/grid/walls.cc.
   */
  class BlockFactor
  {
  public:
    void reinit(const unsigned int size)
    {
      n = size;
      matrix.assign(n * n, 0.);
      right.assign(n, 0.);
      x.assign(n, 0.);
      state.assign(n, free);
    }

    unsigned int size() const { return n; }

    double &operator()(const unsigned int i, const unsigned int j) { return matrix[i * n + j]; }
    double  operator()(const unsigned int i, const unsigned int j) const { return matrix[i * n + j]; }
    double &b(const unsigned int i) { return right[i]; }
    void    fix(const unsigned int i, const double value) { x[i] = value, state[i] = fixed; }
    double  value(const unsigned int i) const { return x[i]; }
    bool    is_left_out(const unsigned int i) const { return state[i] == left_out; }

    /** b - M x in one row. */
    double residual(const unsigned int i) const
    {
      double sum = right[i];
      for (unsigned int j = 0; j < n; ++j)
        sum -= matrix[i * n + j] * x[j];
      return sum;
    }

    void solve(const double floor)
    {
      factor.resize(n * n);
      for (unsigned int i = 0; i < n; ++i)
      {
        if (state[i] == fixed)
          continue;
        double sum = right[i];
        for (unsigned int j = 0; j < n; ++j)
          if (state[j] == fixed)
            sum -= matrix[i * n + j] * x[j];
        // The row of L, and forward substitution on the way.
        double pivot = matrix[i * n + i];
        for (unsigned int j = 0; j < i; ++j)
        {
          if (state[j] != free)
            continue;
          double l = matrix[i * n + j];
          for (unsigned int k = 0; k < j; ++k)
            if (state[k] == free)
              l -= factor[i * n + k] * factor[j * n + k] * factor[k * n + k];
          l /= factor[j * n + j];
          factor[i * n + j] = l;
          pivot -= l * l * factor[j * n + j];
          sum -= l * x[j];
        }
        x[i]              = sum; // L D L^T: D is on the diagonal
        factor[i * n + i] = pivot;
        if (!(pivot > std::max(floor, 1e-12 * matrix[i * n + i])))
        {
          state[i] = left_out;
          x[i]     = 0;
        }
      }
      for (unsigned int i = n; i-- > 0;)
        if (state[i] == free)
        {
          x[i] /= factor[i * n + i];
          for (unsigned int j = i + 1; j < n; ++j)
            if (state[j] == free)
              x[i] -= factor[j * n + i] * x[j];
        }
    }

  private:
    enum State : unsigned char
    {
      free,
      fixed,
      left_out
    };

    unsigned int        n = 0;
    std::vector<double> matrix, factor, right, x;
    std::vector<State>  state;
  };
} // namespace Talus

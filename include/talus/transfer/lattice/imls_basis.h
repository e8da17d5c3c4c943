#pragma once

#include <algorithm>
#include <array>

namespace Talus
{
  /**
   * The basis of improved moving least squares about a node: all monomials up to `order` of z = (x - x_i) / h, the
   * constant first; and what a node must sum of its data for a fit,
   * @f[ M_{jk} = \sum_q w_q p_j(z_q) p_k(z_q) , \qquad R_j = \sum_q w_q p_j(z_q) v_q , @f]
   * M by its different monomials. Test: tests/transfer/imls.cc.
   */
  template <int dim, unsigned int order>
  class ImlsBasis
  {
  public:
    using Exponents = std::array<unsigned int, dim>;

    /** Number of monomials up to a degree. */
    static constexpr unsigned int n_up_to(const unsigned int degree)
    {
      unsigned int n = 1;
      for (unsigned int d = 1; d <= dim; ++d)
        n = n * (degree + d) / d;
      return n;
    }

    static constexpr unsigned int n         = n_up_to(order);     // functions
    static constexpr unsigned int n_moments = n_up_to(2 * order); // different entries of M

    /** All monomials up to degree 2 order, by degree; the first n are the basis. */
    static constexpr std::array<Exponents, n_moments> make_monomials()
    {
      std::array<Exponents, n_moments> result{};
      unsigned int                     next = 0;
      for (unsigned int degree = 0; degree <= 2 * order; ++degree)
        for (unsigned int a = degree + 1; a-- > 0;)
        {
          if constexpr (dim == 1)
          {
            if (a == degree)
              result[next++] = {{a}};
          }
          else if constexpr (dim == 2)
            result[next++] = {{a, degree - a}};
          else
            for (unsigned int b = degree - a + 1; b-- > 0;)
              result[next++] = {{a, b, degree - a - b}};
        }
      return result;
    }
    static constexpr std::array<Exponents, n_moments> monomials = make_monomials();

    using Places = std::array<std::array<unsigned int, n>, n>;

    static constexpr Places make_products()
    {
      Places places{};
      for (unsigned int j = 0; j < n; ++j)
        for (unsigned int k = 0; k < n; ++k)
          for (unsigned int m = 0; m < n_moments; ++m)
          {
            bool is_it = true;
            for (unsigned int d = 0; d < dim; ++d)
              is_it = is_it && monomials[m][d] == monomials[j][d] + monomials[k][d];
            if (is_it)
              places[j][k] = m;
          }
      return places;
    }

    /** The place among the moments of p_j p_k. */
    static constexpr Places products = make_products();

    /**
     * Weights c with v_i = sum_j c_j R_j, the fit's value at the node. Gram-Schmidt in the order of the monomials: with
     * q_j = p_j - sum_{k<j} L_jk q_k and D_j = <q_j, q_j>, a function that the data do not tell from those before it,
     * D_j <= 1e-8 <p_j, p_j>, is left out. Everything is zero where there are no data.
     */
    static std::array<double, n> value_weights(const double *moments)
    {
      // M = L D L^T without the dropped functions, and then M c = e_0: only q_0 = 1 and what follows from it count.
      constexpr double      smallest = 1e-8;
      double                L[n][n], D[n], y[n];
      std::array<double, n> c{};
      for (unsigned int j = 0; j < n; ++j)
      {
        const double square = moments[products[j][j]];
        D[j]                = square;
        y[j]                = j == 0 ? 1 : 0; // p_j at the node
        for (unsigned int k = 0; k < j; ++k)
        {
          L[j][k] = 0;
          if (D[k] == 0)
            continue;
          double sum = moments[products[j][k]];
          for (unsigned int m = 0; m < k; ++m)
            sum -= L[j][m] * D[m] * L[k][m];
          L[j][k] = sum / D[k];
          D[j] -= L[j][k] * sum;
          y[j] -= L[j][k] * y[k];
        }
        if (!(D[j] > smallest * square))
          D[j] = 0;
      }
      // v_i = sum_j q_j(x_i) <q_j, v> / D_j, from the last to the first: c = L^-T D^-1 y.
      for (unsigned int j = n; j-- > 0;)
      {
        if (D[j] == 0)
          continue;
        c[j] = y[j] / D[j];
        for (unsigned int i = j + 1; i < n; ++i)
          if (D[i] != 0)
            c[j] -= L[i][j] * c[i];
      }
      return c;
    }
  };
} // namespace Talus

#pragma once

#include <talus/core/tensors.h>

namespace Talus
{
  /**
   * Eigenvalues of a symmetric tensor, in no order, and its eigenvectors as the columns of an orthogonal one: cyclic
   * Jacobi rotations (Golub & Van Loan, section 8.5), which need no cases and are as accurate for tensors of double
   * eigenvalues. Rows that hold nothing off the diagonal, as in plane strain, cost nothing. Test: tests/core/eigen.cc.
   */
  template <typename Number>
  struct EigenSystem
  {
    explicit EigenSystem(const dealii::SymmetricTensor<2, 3, Number> &A)
    {
      for (unsigned int a = 0; a < 3; ++a)
      {
        value[a] = A[a][a];
        for (unsigned int i = 0; i < 3; ++i)
          vector[i][a] = i == a ? 1. : 0.;
      }
      off[0] = A[1][2], off[1] = A[0][2], off[2] = A[0][1];
      const Number size = value[0] * value[0] + value[1] * value[1] + value[2] * value[2] + 2. * rest();
      // Three or four sweeps do: the rest falls with its square.
      for (unsigned int sweep = 0; sweep < 12 && any(rest() > 1e-34 * size); ++sweep)
        for (unsigned int r = 0; r < 3; ++r)
          rotate(r);
    }

    /** sum_a f_a n_a (x) n_a */
    dealii::SymmetricTensor<2, 3, Number> assemble(const Number (&f)[3]) const
    {
      dealii::SymmetricTensor<2, 3, Number> result;
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j <= i; ++j)
          result[i][j] = f[0] * vector[i][0] * vector[j][0] + f[1] * vector[i][1] * vector[j][1] +
                         f[2] * vector[i][2] * vector[j][2];
      return result;
    }

    Number                       value[3];
    dealii::Tensor<2, 3, Number> vector; // vector[i][a]: component i of eigenvector a

  private:
    Number rest() const { return off[0] * off[0] + off[1] * off[1] + off[2] * off[2]; }

    /** Turns in the plane across axis r so that its entry off the diagonal vanishes. */
    void rotate(const unsigned int r)
    {
      const unsigned int p = (r + 1) % 3, q = (r + 2) % 3;
      if (!any(abs(off[r]) > Number(0.)))
        return;
      const Number difference = value[q] - value[p], twice = 2. * off[r];
      const Number length = abs(difference) + sqrt(difference * difference + twice * twice);
      const Number t      = select(length > Number(0.), select(difference < Number(0.), -twice, twice), Number(0.)) /
                       select(length > Number(0.), length, Number(1.));
      const Number c = 1. / sqrt(1. + t * t), s = t * c;
      value[p] -= t * off[r];
      value[q] += t * off[r];
      off[r] = 0.;
      // off[q] couples r and p, off[p] couples r and q.
      const Number r_p = off[q], r_q = off[p];
      off[q] = c * r_p - s * r_q;
      off[p] = s * r_p + c * r_q;
      for (unsigned int i = 0; i < 3; ++i)
      {
        const Number x = vector[i][p], y = vector[i][q];
        vector[i][p] = c * x - s * y;
        vector[i][q] = s * x + c * y;
      }
    }

    Number off[3]; // off[r]: the entry of the other two axes
  };

  /**
   * That of a tensor in space, or in the plane: then the third eigenvector is across it and has the eigenvalue 0. In
   * place of deal.II's eigenvectors(), which end with an exception where an iteration does not converge.
   */
  template <int dim>
  EigenSystem<double> eigen_system(const dealii::SymmetricTensor<2, dim> &A)
  {
    dealii::SymmetricTensor<2, 3> in_space;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j <= i; ++j)
        in_space[i][j] = A[i][j];
    return EigenSystem<double>(in_space);
  }
} // namespace Talus

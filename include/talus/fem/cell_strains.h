#pragma once

#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/lac/full_matrix.h>

#include <vector>

namespace Talus
{
  /**
   * The strains of a cell's shape functions at its quadrature points, 3x3 also in 2D (plane strain),
   * @f[ \bar\varepsilon_i = \nabla^s N_i + \frac{1}{3} (\pi\,\nabla\cdot N_i - \nabla\cdot N_i) I , @f]
   * where @f$ \pi @f$ is the L2 projection on the cell onto the polynomials {1, x, y (, z)}: Q2 displacements whose
   * volume changes like a discontinuous linear pressure, which do not lock (Hughes 1980). Without projection
   * @f$ \pi @f$ is the identity.
   *
   * Throws nothing. Test: tests/fem/cell_strains.cc.
   */
  template <int dim>
  class CellStrains
  {
  public:
    CellStrains(const dealii::Mapping<dim> &mapping, const dealii::FiniteElement<dim> &fe,
                const dealii::Quadrature<dim> &quadrature, const bool is_projected);

    void reinit(const typename dealii::DoFHandler<dim>::active_cell_iterator &cell);

    /** Of the shape function i at the quadrature point q [1/length]. */
    const dealii::SymmetricTensor<2, 3> &operator()(const unsigned int i, const unsigned int q) const
    {
      return strains[q * n_dofs + i];
    }

    /** Weight of the quadrature point q [volume]. */
    double JxW(const unsigned int q) const { return fe_values.JxW(q); }

    const unsigned int n_dofs, n_points;

  private:
    void project_divergences();

    dealii::FEValues<dim>                      fe_values;
    const bool                                 is_projected;
    std::vector<dealii::SymmetricTensor<2, 3>> strains;
    dealii::FullMatrix<double>                 polynomials, gram, inverse_gram;
  };
} // namespace Talus

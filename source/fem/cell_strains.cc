#include <talus/fem/cell_strains.h>

namespace Talus
{
  using namespace dealii;

  template <int dim>
  CellStrains<dim>::CellStrains(const Mapping<dim> &mapping, const FiniteElement<dim> &fe,
                                const Quadrature<dim> &quadrature, const bool is_projected) :
    n_dofs(fe.n_dofs_per_cell()),
    n_points(quadrature.size()),
    fe_values(mapping, fe, quadrature, update_gradients | update_quadrature_points | update_JxW_values),
    is_projected(is_projected), strains(n_dofs * n_points), polynomials(dim + 1, n_points), gram(dim + 1, dim + 1),
    inverse_gram(dim + 1, dim + 1)
  {
  }

  template <int dim>
  void CellStrains<dim>::reinit(const typename DoFHandler<dim>::active_cell_iterator &cell)
  {
    const FEValuesExtractors::Vector u(0);
    fe_values.reinit(cell);
    for (unsigned int q = 0; q < n_points; ++q)
      for (unsigned int i = 0; i < n_dofs; ++i)
      {
        const SymmetricTensor<2, dim> strain = fe_values[u].symmetric_gradient(i, q);
        for (unsigned int a = 0; a < dim; ++a)
          for (unsigned int b = a; b < dim; ++b)
            strains[q * n_dofs + i][a][b] = strain[a][b];
        for (unsigned int a = dim; a < 3; ++a)
          strains[q * n_dofs + i][a][a] = 0.; // left from the cell before
      }
    if (is_projected)
      project_divergences();
  }

  template <int dim>
  void CellStrains<dim>::project_divergences()
  {
    // Coordinates of order one, so that the Gram matrix is well conditioned.
    const auto  &cell   = fe_values.get_cell();
    const auto   centre = cell->center();
    const double size   = cell->diameter();
    for (unsigned int q = 0; q < n_points; ++q)
    {
      polynomials(0, q) = 1.;
      for (unsigned int a = 0; a < dim; ++a)
        polynomials(a + 1, q) = (fe_values.quadrature_point(q)[a] - centre[a]) / size;
    }
    gram = 0.;
    for (unsigned int a = 0; a <= dim; ++a)
      for (unsigned int b = 0; b <= dim; ++b)
        for (unsigned int q = 0; q < n_points; ++q)
          gram(a, b) += polynomials(a, q) * polynomials(b, q) * JxW(q);
    inverse_gram.invert(gram);

    for (unsigned int i = 0; i < n_dofs; ++i)
    {
      std::array<double, dim + 1> moments{}, coefficients{};
      for (unsigned int a = 0; a <= dim; ++a)
        for (unsigned int q = 0; q < n_points; ++q)
          moments[a] += polynomials(a, q) * trace((*this)(i, q)) * JxW(q);
      for (unsigned int a = 0; a <= dim; ++a)
        for (unsigned int b = 0; b <= dim; ++b)
          coefficients[a] += inverse_gram(a, b) * moments[b];
      for (unsigned int q = 0; q < n_points; ++q)
      {
        double projected = 0.;
        for (unsigned int a = 0; a <= dim; ++a)
          projected += polynomials(a, q) * coefficients[a];
        auto &strain = strains[q * n_dofs + i];
        strain += (projected - trace(strain)) / 3. * unit_symmetric_tensor<3>();
      }
    }
  }

  template class CellStrains<2>;
  template class CellStrains<3>;
} // namespace Talus

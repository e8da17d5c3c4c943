#include <talus/fem/neo_hookean_cells.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/lac/lapack_full_matrix.h>

#include <cmath>

namespace Talus
{
  using namespace dealii;

  template <int dim>
  void NeoHookeanCells<dim>::reinit(const Mapping<dim>                                   &mapping,
                                    const typename DoFHandler<dim>::active_cell_iterator &cell, const double lambda,
                                    const double mu)
  {
    this->lambda   = lambda;
    this->mu       = mu;
    const auto &fe = cell->get_dof_handler().get_fe();
    n_nodes        = fe.n_dofs_per_cell() / dim;
    dofs.resize(n_nodes);
    for (unsigned int i = 0; i < fe.n_dofs_per_cell(); ++i)
    {
      const auto [component, node] = fe.system_to_component_index(i);
      dofs[node][component]        = i;
    }

    FEValues<dim> at_gauss(mapping, fe, QGauss<dim>(fe.degree + 1), update_gradients | update_JxW_values);
    at_gauss.reinit(cell);
    gradients.clear();
    weights.clear();
    for (const unsigned int q : at_gauss.quadrature_point_indices())
    {
      weights.push_back(at_gauss.JxW(q));
      for (unsigned int node = 0; node < n_nodes; ++node)
        gradients.push_back(at_gauss.shape_grad(dofs[node][0], q));
    }

    FEValues<dim> at_nodes(mapping, fe, QGaussLobatto<dim>(fe.degree + 1), update_values | update_JxW_values);
    at_nodes.reinit(cell);
    mass.assign(fe.n_dofs_per_cell(), 0.);
    for (const unsigned int q : at_nodes.quadrature_point_indices())
      for (unsigned int i = 0; i < mass.size(); ++i)
        mass[i] += at_nodes.shape_value(i, q) * at_nodes.JxW(q);
  }

  template <int dim>
  Tensor<2, dim> NeoHookeanCells<dim>::stress(const Tensor<2, dim> &F, const double lambda, const double mu)
  {
    const Tensor<2, dim> inverse_transpose = transpose(invert(F));
    return mu * F + (lambda * std::log(determinant(F)) - mu) * inverse_transpose;
  }

  template <int dim>
  double NeoHookeanCells<dim>::add_forces(const double *u, double *force) const
  {
    double energy = 0.;
    for (unsigned int q = 0; q < weights.size(); ++q)
    {
      const Tensor<1, dim> *gradient = &gradients[q * n_nodes];
      Tensor<2, dim>        F;
      for (unsigned int d = 0; d < dim; ++d)
      {
        for (unsigned int node = 0; node < n_nodes; ++node)
          F[d] += u[dofs[node][d]] * gradient[node];
        F[d][d] += 1.;
      }
      const Tensor<2, dim> inverse = invert(F);
      const double         log_J   = std::log(determinant(F));
      const Tensor<2, dim> P       = weights[q] * (mu * F + (lambda * log_J - mu) * transpose(inverse));
      energy += weights[q] * (.5 * mu * (scalar_product(F, F) - dim - 2. * log_J) + .5 * lambda * log_J * log_J);
      for (unsigned int node = 0; node < n_nodes; ++node)
        for (unsigned int d = 0; d < dim; ++d)
          force[dofs[node][d]] += P[d] * gradient[node];
    }
    return energy;
  }

  template <int dim>
  double NeoHookeanCells<dim>::greatest_frequency(const double density) const
  {
    // At rest P changes by mu (grad u + grad u^T) + lambda div u I.
    const unsigned int       n = mass.size();
    LAPACKFullMatrix<double> matrix(n);
    for (unsigned int q = 0; q < weights.size(); ++q)
      for (unsigned int a = 0; a < n_nodes; ++a)
        for (unsigned int b = 0; b < n_nodes; ++b)
        {
          const auto &grad_a = gradients[q * n_nodes + a], &grad_b = gradients[q * n_nodes + b];
          for (unsigned int i = 0; i < dim; ++i)
            for (unsigned int j = 0; j < dim; ++j)
            {
              const unsigned int row = dofs[a][i], column = dofs[b][j];
              matrix(row, column) +=
                weights[q] *
                (lambda * grad_a[i] * grad_b[j] + mu * grad_a[j] * grad_b[i] + (i == j ? mu * (grad_a * grad_b) : 0.)) /
                (density * std::sqrt(mass[row] * mass[column]));
            }
        }
    dealii::Vector<double>     eigenvalues;
    dealii::FullMatrix<double> eigenvectors;
    const double               greatest = matrix.l1_norm();
    matrix.compute_eigenvalues_symmetric(-greatest, 2. * greatest, 1e-12 * greatest, eigenvalues, eigenvectors);
    return std::sqrt(*std::max_element(eigenvalues.begin(), eigenvalues.end()));
  }

  template class NeoHookeanCells<2>;
  template class NeoHookeanCells<3>;
} // namespace Talus

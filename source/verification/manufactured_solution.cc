#include <talus/verification/manufactured_solution.h>

namespace Talus
{
  using namespace dealii;

  template <int dim>
  Tensor<2, dim> ManufacturedSolution<dim>::stress(const Point &X, const double t) const
  {
    const Matrix F = deformation_gradient(X, t);
    const double J = determinant(F);
    Matrix       stress;
    for (unsigned int d = 0; d < dim; ++d)
      stress[d][d] = material.lambda * std::log(J) - material.mu;
    return (stress + material.mu * F * transpose(F)) / J;
  }

  template class ManufacturedSolution<2>;
  template class ManufacturedSolution<3>;
} // namespace Talus

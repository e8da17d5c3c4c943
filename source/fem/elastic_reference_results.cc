#include <talus/fem/elastic_reference.h>

#include <deal.II/base/mpi_remote_point_evaluation.h>
#include <deal.II/numerics/vector_tools_evaluate.h>

#include <algorithm>
#include <sstream>

namespace Talus
{
  using namespace dealii;

  template <int dim>
  std::vector<Tensor<1, dim>> ElasticReference<dim>::displacement(const std::vector<Point<dim>> &points) const
  {
    Utilities::MPI::RemotePointEvaluation<dim> cache;
    return VectorTools::point_values<dim>(mapping, dof_handler, solution, checked(points), cache);
  }

  template <int dim>
  std::vector<SymmetricTensor<2, 3>> ElasticReference<dim>::stress(const std::vector<Point<dim>> &points) const
  {
    Utilities::MPI::RemotePointEvaluation<dim> cache;
    const auto gradients = VectorTools::point_gradients<dim>(mapping, dof_handler, solution, checked(points), cache);

    std::vector<SymmetricTensor<2, 3>> stresses;
    for (const Tensor<2, dim> &grad_u : gradients)
    {
      SymmetricTensor<2, 3> strain; // plane strain in 2D: the third row stays zero
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = i; j < dim; ++j)
          strain[i][j] = (grad_u[i][j] + grad_u[j][i]) / 2.;
      stresses.push_back(K * trace(strain) * unit_symmetric_tensor<3>() + 2. * G * deviator(strain));
    }
    return stresses;
  }

  template <int dim>
  bool ElasticReference<dim>::has_condition(const std::string &condition) const
  {
    return conditions.has(condition);
  }

  template <int dim>
  Tensor<1, dim> ElasticReference<dim>::force(const std::string &condition) const
  {
    Assert(residual.size() > 0, ExcMessage("Call solve() first."));
    return conditions.force(condition, residual);
  }

  template <int dim>
  std::vector<Point<dim>> ElasticReference<dim>::checked(const std::vector<Point<dim>> &points) const
  {
    Assert(solution.size() > 0, ExcMessage("Call solve() first."));
    const double tolerance = 1e-10 * (box.upper - box.lower).norm();
    std::string  problem;
    auto         moved = points;
    for (auto &point : moved)
    {
      const Point<dim> given = point;
      for (unsigned int i = 0; i < dim; ++i)
        point[i] = std::min(std::max(given[i], box.lower[i]), box.upper[i]);
      if (problem.empty() && !((point - given).norm() <= tolerance))
      {
        std::ostringstream text;
        text << "The point (" << given << ") lies outside the box of the elastic reference, from (" << box.lower
             << ") to (" << box.upper << "). Enlarge the box in section '" << get_section_name() << "'.";
        problem = text.str();
      }
    }
    // The rank that found it tells the others: all must throw.
    for (const auto &found : Utilities::MPI::all_gather(communicator, problem))
      AssertThrow(found.empty(), InputError(found));
    return moved;
  }

  template class ElasticReference<2>;
  template class ElasticReference<3>;
} // namespace Talus

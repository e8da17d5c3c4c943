#pragma once

#include <deal.II/base/tensor.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/mapping.h>

#include <array>
#include <vector>

namespace Talus
{
  /**
   * Forces and energy of a compressible neo-Hookean solid in equal cells of a uniform mesh, total Lagrangian,
   * @f[ P = \mu (F - F^{-T}) + \lambda \ln J\, F^{-T} , \quad F = I + \nabla_X u , \quad
   *     W = \tfrac{\mu}{2} (F:F - 3 - 2 \ln J) + \tfrac{\lambda}{2} (\ln J)^2 , @f]
   * plane strain in 2D; degree + 1 Gauss points in each direction. A cell turned inside out has an energy that is not a
   * number. Test: tests/fem/dynamic.cc.
   */
  template <int dim>
  class NeoHookeanCells
  {
  public:
    /** Gradients and weights are those of `cell`, and hold for all. */
    void reinit(const dealii::Mapping<dim> &mapping, const typename dealii::DoFHandler<dim>::active_cell_iterator &cell,
                const double lambda, const double mu);

    /** Adds the integral of P : grad N_i to `force` from the cell's displacements; returns its strain energy. */
    double add_forces(const double *u, double *force) const;

    /** The mass of each degree of freedom for the density 1, by Gauss-Lobatto points, which are the nodes. */
    const std::vector<double> &masses() const { return mass; }

    /** The greatest frequency of a cell of density `density` at rest: no mesh of such cells has a greater one. */
    double greatest_frequency(const double density) const;

    static dealii::Tensor<2, dim> stress(const dealii::Tensor<2, dim> &F, const double lambda, const double mu);

  private:
    double                                     lambda = 0., mu = 0.;
    unsigned int                               n_nodes = 0;
    std::vector<dealii::Tensor<1, dim>>        gradients; // of the node functions, by point and node
    std::vector<double>                        weights;   // of the Gauss points [volume]
    std::vector<double>                        mass;
    std::vector<std::array<unsigned int, dim>> dofs; // of a cell, by node and component
  };
} // namespace Talus

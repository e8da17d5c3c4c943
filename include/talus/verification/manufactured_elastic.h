#pragma once

#include <deal.II/base/function.h>
#include <deal.II/base/symmetric_tensor.h>

#include <array>
#include <string>

namespace Talus
{
  /**
   * A smooth static displacement field of an isotropic linear elastic body,
   * @f[ u_i(x) = a \prod_j \sin(k_{ij} x_j + \varphi_{ij}) , @f]
   * with the stress and the body force that belong to it (small strains, plane
   * strain in 2D).
   *
   * Not a polynomial, without symmetry, and with a volumetric and a deviatoric
   * part everywhere, so that no term of a discretisation can hide. The wave
   * numbers k [1/length] are fixed and lie between 1 and 2.2: on a unit box a
   * coarse grid is already in the asymptotic range. Moduli K, G [stress].
   * Theory: doc/fem_reference.md. Test: tests/fem/manufactured.cc.
   */
  template <int dim>
  class ManufacturedElastic : public dealii::Function<dim>
  {
  public:
    /** `amplitude` is the a of the formula [length]. */
    ManufacturedElastic(const double bulk_modulus, const double shear_modulus, const double amplitude = 1.);

    double value(const dealii::Point<dim> &x, const unsigned int component = 0) const override;

    dealii::Tensor<1, dim> gradient(const dealii::Point<dim> &x, const unsigned int component = 0) const override;

    /** @f$ \sigma = \lambda\, (\nabla\cdot u) I + 2 G\, \nabla^s u @f$ with @f$ \lambda = K - 2G/3 @f$ [stress]. */
    dealii::SymmetricTensor<2, 3> stress(const dealii::Point<dim> &x) const;

    /** @f$ f = -\nabla\cdot\sigma = -(\lambda + G)\, \nabla(\nabla\cdot u) - G\, \nabla^2 u @f$ [force/volume]. */
    dealii::Tensor<1, dim> body_force(const dealii::Point<dim> &x) const;

    /** u as muParser formulas of x, y, z, separated by ';', exact to the last bit of the constants. */
    std::string formulas() const;

  private:
    /** The derivative of u_i of order `orders[j]` in direction j. */
    double derivative(const unsigned int i, const dealii::Point<dim> &x,
                      const std::array<unsigned int, dim> &orders) const;

    const double lambda, G, amplitude;
  };

  /** The body force of a manufactured field as a function with `dim` components [force/volume]. */
  template <int dim>
  class ManufacturedBodyForce : public dealii::Function<dim>
  {
  public:
    explicit ManufacturedBodyForce(const ManufacturedElastic<dim> &field) : dealii::Function<dim>(dim), field(field) {}

    double value(const dealii::Point<dim> &x, const unsigned int component = 0) const override
    {
      return field.body_force(x)[component];
    }

  private:
    const ManufacturedElastic<dim> field;
  };
} // namespace Talus

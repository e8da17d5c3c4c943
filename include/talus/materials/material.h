#pragma once

#include <deal.II/base/parameter_acceptor.h>
#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <string>
#include <vector>

namespace Talus
{
  /**
   * The particles begin .. end - 1 as a material sees them: one array per tensor
   * component, always of 3x3 tensors. Components that plane strain does not store
   * are null; they are 0 (and 1 for F_zz).
   */
  struct MaterialRange
  {
    unsigned int begin, end;
    double       dt; // [time]

    std::array<const double *, 9> grad_v; // row by row [1/time]
    std::array<const double *, 9> F;      // row by row [1]
    std::array<double *, 6>       stress; // Cauchy: xx, yy, zz, xy, xz, yz [stress]
    const double                 *mass, *volume;
    std::vector<double *>         state; // the material's own fields, in the order of state_names()
  };

  /**
   * A constitutive law. It sees 3x3 tensors and neither the dimension nor the
   * grid. A law is written once as a function of the tensors of one point;
   * materials/update.h runs it over a range.
   */
  class Material : public dealii::ParameterAcceptor
  {
  public:
    explicit Material(const std::string &section);

    /** Names of the state fields that each particle carries for this material. */
    virtual std::vector<std::string> state_names() const { return {}; }

    /** Advances stress and state by the step; F and volume are those at its end. */
    virtual void update(const MaterialRange &range) const = 0;

    /** Speed of pressure waves at a point of density `rho` [length/time]. */
    virtual double wave_speed(const double rho) const = 0;

    /** Elastic energy per volume of a stress [stress]. */
    virtual double strain_energy_density(const dealii::SymmetricTensor<2, 3> &stress) const = 0;

    /** Ratio of horizontal to vertical stress of a layer at rest: nu / (1 - nu). */
    virtual double rest_stress_ratio() const = 0;

    double density = 1000; // [mass/volume]

    void parse_parameters(dealii::ParameterHandler &prm) override;
  };
} // namespace Talus

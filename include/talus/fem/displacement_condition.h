#pragma once

#include <talus/core/function.h>
#include <talus/core/parameters.h>

#include <deal.II/base/parameter_acceptor.h>

#include <string>
#include <vector>

namespace Talus
{
  /**
   * A prescribed displacement on some faces of a box: @f$ u_c = \bar u_c(x, t) @f$
   * for the chosen components c. The other components are free of traction.
   *
   * Throws EntryError for formulas that muParser cannot read or that are not
   * `dim`, and when no boundary is given. Test: tests/fem/errors.cc.
   */
  template <int dim>
  class DisplacementCondition : public dealii::ParameterAcceptor
  {
  public:
    DisplacementCondition(const std::string &section, const std::string &name);

    void parse_parameters(dealii::ParameterHandler &prm) override;

    const std::string name;

    /** Faces of the box: 2 d is the lower, 2 d + 1 the upper face in direction d. */
    std::vector<unsigned int> boundary_ids;

    /** Directions, 0 to dim - 1. */
    std::vector<unsigned int> components;

    /** @f$ \bar u @f$ [length]. */
    ParsedVector<dim> displacement;

  private:
    std::string component_names, formulas;
  };
} // namespace Talus

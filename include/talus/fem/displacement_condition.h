#pragma once

#include <talus/core/function.h>
#include <talus/core/parameters.h>

#include <deal.II/base/parameter_acceptor.h>

#include <string>
#include <vector>

namespace Talus
{
  /**
   * A prescribed displacement @f$ u_c = \bar u_c(x, t) @f$ for the chosen components c, on some faces of the body or
   * at all nodes in a box. The other components are free of traction.
   *
   * Throws EntryError for formulas that muParser cannot read or that are not
   * `dim`, when neither boundary nor box is given, and for half a box. Test: tests/fem/errors.cc.
   */
  template <int dim>
  class DisplacementCondition : public dealii::ParameterAcceptor
  {
  public:
    DisplacementCondition(const std::string &section, const std::string &name);

    void parse_parameters(dealii::ParameterHandler &prm) override;

    /** Whether the component is prescribed. */
    bool holds_for(const unsigned int component) const;

    bool has_box() const { return !lower.empty(); }

    bool depends_on_time() const { return uses_variable(formulas, "t"); }

    /** Whether the box holds the point; a margin of `tolerance` [length] belongs to it. */
    bool is_in_box(const dealii::Point<dim> &x, const double tolerance) const;

    const std::string name;

    /** Faces of the box: 2 d is the lower, 2 d + 1 the upper face in direction d. */
    std::vector<unsigned int> boundary_ids;

    /** Directions, 0 to dim - 1. */
    std::vector<unsigned int> components;

    /** @f$ \bar u @f$ [length]. */
    ParsedVector<dim> displacement;

  private:
    std::vector<double> lower, upper; // of the box, or empty
    std::string         component_names, formulas;
  };
} // namespace Talus

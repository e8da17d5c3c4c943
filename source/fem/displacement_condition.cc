#include <talus/fem/displacement_condition.h>

#include <deal.II/base/patterns.h>
#include <deal.II/base/utilities.h>

#include <algorithm>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    const std::string axes = "xyz";
  }

  template <int dim>
  DisplacementCondition<dim>::DisplacementCondition(const std::string &section, const std::string &name) :
    ParameterAcceptor(section), name(name), component_names(dim == 2 ? "x, y" : "x, y, z"),
    formulas(dim == 2 ? "0; 0" : "0; 0; 0")
  {
    add_parameter("Boundary ids", boundary_ids,
                  "Faces of the box where this condition holds: 0 and 1 are the lower and upper face in x, 2 and 3 in "
                  "y, 4 and 5 in z.",
                  this->prm, Patterns::List(Patterns::Integer(0, 2 * dim - 1)));
    add_parameter("Lower corner", lower, "With 'Upper corner': also at all nodes in this box [length].", this->prm,
                  Patterns::List(Patterns::Double(), 0, dim));
    add_parameter("Upper corner", upper, "With 'Lower corner': also at all nodes in this box [length].", this->prm,
                  Patterns::List(Patterns::Double(), 0, dim));
    add_parameter("Components", component_names, "Components of the displacement that are prescribed.", this->prm,
                  Patterns::List(Patterns::Selection(dim == 2 ? "x|y" : "x|y|z"), 1));
    add_parameter("Displacement", formulas,
                  "Prescribed displacement [length]: one formula of x, y, z (3D) and the time t for each "
                  "direction, separated by ';'.",
                  this->prm);
  }

  template <int dim>
  void DisplacementCondition<dim>::parse_parameters(ParameterHandler &)
  {
    const std::string section = get_section_name();
    if (lower.size() != upper.size() || (!lower.empty() && lower.size() != dim))
      throw EntryError(section, "Lower corner",
                       "give both corners of the box with " + std::to_string(dim) + " numbers each.");
    for (unsigned int i = 0; i < lower.size(); ++i)
      if (!(upper[i] >= lower[i]))
        throw EntryError(section, "Upper corner",
                         "the box is upside down: this corner must not lie below the lower corner, as it does along " +
                           std::string(1, axes[i]) + ". Exchange the two numbers.");
    if (boundary_ids.empty() && lower.empty())
      throw EntryError(section, "Boundary ids",
                       "the condition '" + name + "' holds nowhere. Give it one or more of the ids 0 to " +
                         std::to_string(2 * dim - 1) + ", or the corners of a box of nodes.");

    components.clear();
    for (const auto &axis : Utilities::split_string_list(component_names))
      components.push_back(axes.find(axis));

    displacement.initialize(formulas, section, "Displacement");
  }

  template <int dim>
  bool DisplacementCondition<dim>::holds_for(const unsigned int component) const
  {
    return std::find(components.begin(), components.end(), component) != components.end();
  }

  template <int dim>
  bool DisplacementCondition<dim>::is_in_box(const Point<dim> &x, const double tolerance) const
  {
    for (unsigned int i = 0; i < dim; ++i)
      if (x[i] < lower[i] - tolerance || x[i] > upper[i] + tolerance)
        return false;
    return true;
  }

  template class DisplacementCondition<2>;
  template class DisplacementCondition<3>;
} // namespace Talus

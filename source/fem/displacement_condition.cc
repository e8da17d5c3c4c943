#include <talus/fem/displacement_condition.h>

#include <talus/core/function.h>

#include <deal.II/base/numbers.h>
#include <deal.II/base/patterns.h>
#include <deal.II/base/utilities.h>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    const std::string axes = "xyz";
  }

  template <int dim>
  DisplacementCondition<dim>::DisplacementCondition(const std::string &section, const std::string &name) :
    ParameterAcceptor(section), name(name), displacement(dim), component_names(dim == 2 ? "x, y" : "x, y, z"),
    formulas(dim == 2 ? "0; 0" : "0; 0; 0")
  {
    add_parameter("Boundary ids", boundary_ids,
                  "Faces of the box where this condition holds: 0 and 1 are the lower and upper face in x, 2 and 3 in "
                  "y, 4 and 5 in z.",
                  this->prm, Patterns::List(Patterns::Integer(0, 2 * dim - 1)));
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
    if (boundary_ids.empty())
      throw EntryError(section, "Boundary ids",
                       "the condition '" + name + "' holds nowhere. Give it one or more of the ids 0 to " +
                         std::to_string(2 * dim - 1) + ".");

    components.clear();
    for (const auto &axis : Utilities::split_string_list(component_names))
      components.push_back(axes.find(axis));

    const auto list = Utilities::split_string_list(formulas, ';');
    if (list.size() != dim)
      throw EntryError(section, "Displacement",
                       "'" + formulas + "' has " + std::to_string(list.size()) + " formulas, expected " +
                         std::to_string(dim) + " separated by ';', one for each direction.");
    const std::string reason = formula_error(
      [&]
      {
        displacement.initialize(dim == 2 ? "x,y,t" : "x,y,z,t", list, {{"pi", numbers::PI}}, true);
        for (unsigned int component = 0; component < dim; ++component)
          displacement.value(Point<dim>(), component); // a formula is only read when it is first evaluated
      });
    if (!reason.empty())
      throw EntryError(section, "Displacement",
                       "cannot understand '" + formulas + "': " + reason + ". Write formulas of " +
                         (dim == 2 ? "x, y, t" : "x, y, z, t") + " in muParser's syntax, for example 0.1*t*sin(pi*x).");
  }

  template class DisplacementCondition<2>;
  template class DisplacementCondition<3>;
} // namespace Talus

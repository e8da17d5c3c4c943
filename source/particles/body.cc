#include <talus/particles/body.h>
#include <talus/particles/column_names.h>

#include <algorithm>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    std::string choice(const std::vector<std::string> &names)
    {
      std::string selection;
      for (const auto &name : names)
        selection += (selection.empty() ? "" : "|") + name;
      return selection;
    }
  } // namespace

  template <int dim>
  Body<dim>::Body(Parameters &parameters, const std::string &name, const std::vector<std::string> &material_names) :
    ParameterAcceptor("/Bodies/" + name), name(name), velocity_text(dim == 2 ? "0; 0" : "0; 0; 0")
  {
    const std::string section = get_section_name();
    const std::string chosen  = parameters.choose_from(section, "Material", material_names.front(),
                                                       choice(material_names), "Name of the body's material.");
    material = std::find(material_names.begin(), material_names.end(), chosen) - material_names.begin();
    shape    = parameters.make<Shape<dim>>(section, "Shape", "box", "Region that the body fills.");

    add_parameter(
      "Clip to grid", is_clipped,
      "Leave out what lies outside the grid, and half of the particles on its faces: half and quarter models.");
    add_parameter("Velocity", velocity_text, "Initial velocity [length/time]: functions of x, y, z, separated by ';'.");
    add_parameter("Velocity gradient", velocity_gradient,
                  "Initial velocity gradient dv_i/dx_j row by row [1/time], for the affine transfers; empty: zero.",
                  prm, Patterns::List(Patterns::Double(), 0, dim * dim));
    add_parameter(
      "Deformation gradient", deformation_gradient,
      "Of the body as it lies at the start, dx_i/dX_j row by row [1], for laws whose stress is a function of "
      "it: neo-Hookean, Hooke; empty: the unit matrix.",
      prm, Patterns::List(Patterns::Double(), 0, dim * dim));
    stress_kind =
      parameters.choose_from(section, "Initial stress", "none", "none|uniform|geostatic|hydrostatic",
                             "Stress before the first step: none, uniform, that of a layer or of a liquid at rest.");
    if (stress_kind == "uniform")
    {
      uniform_stress.assign(6, 0.);
      add_parameter("Stress", uniform_stress,
                    "Uniform initial stress xx, yy, zz, xy, xz, yz, tension positive [stress].", prm,
                    Patterns::List(Patterns::Double(), 6, 6));
    }
    else if (is_layered())
    {
      add_parameter("Unit weight", unit_weight, "Density times gravity [force/volume].", prm, Patterns::Double());
      add_parameter("Surface level", surface_level, "Height of the free surface on the vertical axis [length].", prm,
                    Patterns::Double());
      if (stress_kind == "geostatic")
        add_parameter("Rest stress ratio", rest_stress_ratio,
                      "K0, horizontal over vertical stress [1]; negative: that of the material, nu / (1 - nu).", prm,
                      Patterns::Double());
      add_parameter("Vertical axis", vertical_axis, "Axis along which the weight acts, downwards.", prm,
                    Patterns::Selection(dim == 2 ? "x|y" : "x|y|z"));
    }
    if (stress_kind == "none")
      for (const char *entry : {"Stress", "Unit weight", "Surface level", "Rest stress ratio", "Vertical axis"})
        parameters.allow(section, entry, "'Initial stress' is 'none'.");
  }

  template <int dim>
  void Body<dim>::parse_parameters(ParameterHandler &)
  {
    velocity.initialize(velocity_text, get_section_name(), "Velocity");
    if (!velocity_gradient.empty() && velocity_gradient.size() != dim * dim)
      throw EntryError(get_section_name(), "Velocity gradient",
                       "give " + std::to_string(dim * dim) + " numbers, row by row, or none.");
    if (!deformation_gradient.empty() && deformation_gradient.size() != dim * dim)
      throw EntryError(get_section_name(), "Deformation gradient",
                       "give " + std::to_string(dim * dim) + " numbers, row by row, or none.");
    if (!deformation_gradient.empty() && !(determinant(initial_F()) > 0))
      throw EntryError(get_section_name(), "Deformation gradient", "its determinant must be positive.");
    if (dim == 2 && stress_kind == "uniform" && (uniform_stress[4] != 0 || uniform_stress[5] != 0))
      throw EntryError(get_section_name(), "Stress", "plane strain has no shear stresses xz, yz. Set them to 0.");
    if (is_layered() && !(unit_weight > 0))
      throw EntryError(get_section_name(), "Unit weight", "it must be positive: give density times gravity.");
  }

  template <int dim>
  void Body<dim>::initialize(const std::uint64_t index, const Point<dim> &x, const double volume,
                             const Material &material, const WorkingSet<dim> &set,
                             std::vector<double> &properties) const
  {
    for (const auto &field : set.fields)
      std::copy(field.initial.begin(), field.initial.end(), properties.begin() + field.first);
    const auto value = [&](const unsigned int field, const unsigned int c) -> double & {
      return properties[set.fields[field].first + c];
    };

    const Tensor<1, dim> v = velocity.evaluate(x, 0.);
    for (unsigned int d = 0; d < dim; ++d)
    {
      value(set.position, d) = value(set.initial_position, d) = x[d];
      value(set.velocity, d)                                  = v[d];
      if (!std::isfinite(v[d]))
        throw EntryError(get_section_name(), "Velocity",
                         "it has no finite value at the particle at " + to_text<dim>(x) +
                           ". Correct the function, or move the body.");
    }
    for (unsigned int c = 0; c < velocity_gradient.size(); ++c)
      value(set.grad_v, c) = velocity_gradient[c];
    const auto        stress  = initial_stress(x, material);
    const std::string refusal = material.refusal(stress);
    if (!refusal.empty())
      throw EntryError(get_section_name(), "Initial stress", refusal);
    for (unsigned int c = 0; c < set.n_stress; ++c)
      value(set.stress, c) = stress[c];
    double J = 1;
    if (!deformation_gradient.empty())
    {
      if (!material.starts_deformed())
        throw EntryError(
          get_section_name(), "Deformation gradient",
          "the stress of the body's material is no function of it. Use 'neo-Hookean', or 'Initial stress'.");
      J = determinant(initial_F());
      for (unsigned int c = 0; c < dim * dim; ++c)
        value(set.F, c) = deformation_gradient[c];
    }
    const auto states = material.initial_states(stress);
    for (unsigned int k = 0; k < states.size(); ++k)
      value(set.state_fields[this->material][k], 0) = states[k];
    value(set.volume, 0) = volume;
    value(set.mass, 0)   = volume / J * material.initial_density(-(stress[0] + stress[1] + stress[2]) / 3);
    if (!given.empty())
      take_given(index, x, volume, material, set, properties);
    if (const auto field = set.find_field(set.half_edges_name))
    {
      const auto edges = shape->half_edges(x, volume);
      for (unsigned int c = 0; c < dim * dim; ++c)
        value(*field, c) = edges[c / dim][c % dim];
    }
    if (material.carries_volume_only())
      value(set.F, 0) = material.density * volume / value(set.mass, 0);
  }

  template <int dim>
  void Body<dim>::find_given_columns(const WorkingSet<dim> &set)
  {
    given.clear();
    const auto names = column_names(set);
    for (const std::string &wanted : shape->given_columns())
    {
      const auto found =
        std::find_if(names.begin(), names.end(), [&](const auto &name) { return name.first == wanted; });
      if (found == names.end())
      {
        std::string choices;
        for (const auto &name : names)
          choices += (choices.empty() ? "" : ", ") + name.first;
        throw EntryError(get_section_name(), "File",
                         "particles of this run have no '" + shortened(wanted) + "'. They have " + choices +
                           ". What is not to be read goes into 'Ignore columns'.");
      }
      given.push_back(found->second);
    }
    const auto gives = [&](const unsigned int field) {
      const unsigned int n     = set.fields[field].n_components;
      unsigned int       there = 0;
      for (const unsigned int c : given)
        there += c >= set.fields[field].first && c < set.fields[field].first + n;
      if (there > 0 && there < n)
        throw EntryError(get_section_name(), "File",
                         "of " + set.fields[field].name + " the table has " + std::to_string(there) + " of " +
                           std::to_string(n) + " components. Give all, or none.");
      return there > 0;
    };
    for (unsigned int field = 0; field < set.fields.size(); ++field)
      gives(field);
    gives_F      = gives(set.F);
    gives_stress = gives(set.stress);
    gives_mass   = gives(set.mass);
    if (gives_stress && has_initial_stress())
      throw EntryError(get_section_name(), "Initial stress",
                       "the table gives the stress. Leave this out, or name its columns in 'Ignore columns'.");
    if (gives_F && !deformation_gradient.empty())
      throw EntryError(get_section_name(), "Deformation gradient",
                       "the table gives it. Leave this out, or name its columns in 'Ignore columns'.");
  }

  template <int dim>
  void Body<dim>::take_given(const std::uint64_t index, const Point<dim> &x, const double volume,
                             const Material &material, const WorkingSet<dim> &set,
                             std::vector<double> &properties) const
  {
    const double *values = shape->given_values(index);
    const auto    refuse = [&](const std::string &why) {
      throw EntryError(get_section_name(), "File", "the point at " + to_text<dim>(x) + ": " + why);
    };
    for (unsigned int k = 0; k < given.size(); ++k)
      properties[given[k]] = values[k];
    std::array<double, 6> stress{};
    for (unsigned int c = 0; c < set.n_stress; ++c)
      stress[c] = properties[set.fields[set.stress].first + c];
    if (gives_stress)
    {
      if (const std::string refusal = material.refusal(stress); !refusal.empty() && !gives_F)
        refuse(refusal);
      const auto states = material.initial_states(stress);
      for (unsigned int k = 0; k < states.size(); ++k)
        properties[set.fields[set.state_fields[this->material][k]].first] = states[k];
      // What the table says of them counts.
      for (unsigned int k = 0; k < given.size(); ++k)
        properties[given[k]] = values[k];
    }
    double J = 1;
    if (gives_F && !material.carries_volume_only())
    {
      Tensor<2, dim> F;
      for (unsigned int c = 0; c < dim * dim; ++c)
        F[c / dim][c % dim] = properties[set.fields[set.F].first + c];
      J = determinant(F);
      if (!(J > 0))
        refuse("the determinant of its deformation gradient must be positive.");
    }
    double &mass = properties[set.fields[set.mass].first];
    if (!gives_mass)
      mass = volume / J * material.initial_density(-(stress[0] + stress[1] + stress[2]) / 3);
    if (!(mass > 0))
      refuse("its mass must be positive.");
  }

  template <int dim>
  Tensor<2, dim> Body<dim>::initial_F() const
  {
    Tensor<2, dim> F;
    for (unsigned int c = 0; c < dim * dim; ++c)
      F[c / dim][c % dim] = deformation_gradient[c];
    return F;
  }

  template <int dim>
  std::array<double, 6> Body<dim>::initial_stress(const Point<dim> &x, const Material &material) const
  {
    std::array<double, 6> stress{};
    if (stress_kind == "uniform")
      std::copy(uniform_stress.begin(), uniform_stress.end(), stress.begin());
    else if (is_layered())
    {
      const unsigned int vertical = vertical_axis[0] - 'x';
      const double       sigma_v  = -unit_weight * std::max(0., surface_level - x[vertical]);
      // In a liquid at rest the pressure is the same in all directions.
      const double K0 = stress_kind == "hydrostatic" ? 1 :
                        rest_stress_ratio < 0        ? material.rest_stress_ratio() :
                                                       rest_stress_ratio;
      for (unsigned int d = 0; d < 3; ++d)
        stress[d] = d == vertical ? sigma_v : K0 * sigma_v;
    }
    return stress;
  }

  template class Body<2>;
  template class Body<3>;
} // namespace Talus

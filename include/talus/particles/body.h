#pragma once

#include <talus/core/function.h>
#include <talus/materials/material.h>
#include <talus/particles/shape.h>
#include <talus/particles/working_set.h>

#include <optional>

namespace Talus
{
  /** One body: its shape, its material and the state in which it starts. */
  template <int dim>
  class Body : public dealii::ParameterAcceptor
  {
  public:
    Body(Parameters &parameters, const std::string &name, const std::vector<std::string> &material_names);

    void parse_parameters(dealii::ParameterHandler &prm) override;

    /** Finds the columns that the shape's points have with them. Throws EntryError for one that particles do not have.
     */
    void find_given_columns(const WorkingSet<dim> &set);

    /** Writes the initial state of point `index`, at `x`, into its properties, one for each column of `set`. */
    void initialize(const std::uint64_t index, const dealii::Point<dim> &x, const double volume,
                    const Material &material, const WorkingSet<dim> &set, std::vector<double> &properties) const;

    /** An initial stress that grows with the depth below a surface. */
    struct Layer
    {
      double       unit_weight;   // [force/volume]
      double       surface_level; // [length]
      unsigned int axis;
    };

    /** That of this body, if it has one. */
    std::optional<Layer> layer() const
    {
      if (!is_layered())
        return {};
      return Layer{unit_weight, surface_level, static_cast<unsigned int>(vertical_axis[0] - 'x')};
    }

    bool has_initial_stress() const { return stress_kind != "none"; }

    /** Whether it starts with a deformation gradient, from which its material has the stress. */
    bool starts_deformed() const { return !deformation_gradient.empty() || gives_F; }

    std::string                 name;
    unsigned int                material; // index
    std::unique_ptr<Shape<dim>> shape;
    std::uint64_t               first_id   = 0;
    bool                        is_clipped = false; // what lies outside the grid is left out

  private:
    /** Takes over what the shape has of a point, with what follows from it. */
    void take_given(const std::uint64_t index, const dealii::Point<dim> &x, const double volume,
                    const Material &material, const WorkingSet<dim> &set, std::vector<double> &properties) const;

    /** Components xx, yy, zz, xy, xz, yz of the stress at `x` before the first step. */
    std::array<double, 6> initial_stress(const dealii::Point<dim> &x, const Material &material) const;

    /** The deformation gradient at the start, if there is one. */
    dealii::Tensor<2, dim> initial_F() const;

    /** True when the stress grows with the depth below a surface. */
    bool is_layered() const { return stress_kind == "geostatic" || stress_kind == "hydrostatic"; }

    std::vector<unsigned int> given; // columns that the points have with them
    bool                      gives_F = false, gives_stress = false, gives_mass = false;

    ParsedVector<dim>   velocity;
    std::string         velocity_text;
    std::vector<double> velocity_gradient, deformation_gradient;

    std::string         stress_kind;
    std::vector<double> uniform_stress;
    double              unit_weight = 0, surface_level = 0, rest_stress_ratio = -1;
    std::string         vertical_axis = dim == 2 ? "y" : "z";
  };
} // namespace Talus

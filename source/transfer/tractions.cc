#include <talus/core/exceptions.h>
#include <talus/transfer/tractions.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    /** The names as Patterns::Selection reads them: "a|b|c". */
    std::string choice(const std::vector<std::string> &names)
    {
      std::string selection;
      for (const auto &name : names)
        selection += (selection.empty() ? "" : "|") + name;
      return selection;
    }

    /** `text` once for each component. */
    std::string repeated(const std::string &text, const unsigned int n)
    {
      std::string list = text;
      for (unsigned int d = 1; d < n; ++d)
        list += "; " + text;
      return list;
    }
  } // namespace

  template <int dim>
  Traction<dim>::Traction(Parameters &parameters, const std::string &name, const std::vector<std::string> &body_names) :
    ParameterAcceptor("/Tractions/" + name), function_text(repeated("0", dim))
  {
    const std::string section = get_section_name();
    AssertThrow(!body_names.empty(), EntryError("/Bodies", "Names", "give at least one body."));
    kind = parameters.choose_from(section, "Type", "traction", "traction|pressure|force",
                                  "Force per initial area, pressure on the deformed one, or force at a point.");
    body_name =
      parameters.choose_from(section, "Body", body_names.front(), choice(body_names), "Name of the loaded body.");
    const std::string load = kind == "traction" ? "Traction" : kind == "force" ? "Force" : "Pressure";
    for (const std::string &entry :
         kind == "force" ? std::vector<std::string>{load, "Position"} : std::vector<std::string>{load})
      if (!parameters.is_set(section, entry))
        parameters.warn(EntryError(section, entry,
                                   entry == "Position" ? "the force has been given no place and acts at the origin." :
                                                         "the load is zero: it has no effect."));
    if (kind == "traction")
      add_parameter("Traction", function_text,
                    "Force per initial area [stress]: functions of x, y, z, t, separated by ';'.");
    else if (kind == "force")
    {
      add_parameter("Force", function_text, "Force [force]: functions of x, y, z, t, separated by ';'.");
      add_parameter("Position", position, "Where the force acts at the start [length]; it moves with the body.", prm,
                    Patterns::List(Patterns::Double(), dim, dim));
    }
    else
    {
      function_text = "0";
      add_parameter("Pressure", function_text, "Pressure, positive in compression [stress]: function of x, y, z, t.");
    }
    if (kind == "force")
      return;
    n_layers = 4;
    add_parameter("Layers", n_layers,
                  "Number of layers of particles that take up the load: more make the stress below it more even.", prm,
                  Patterns::Integer(1, 64));
    add_parameter("Faces", faces, "Parts of the body's surface: 'all', or names that depend on its shape.", prm,
                  Patterns::List(Patterns::Anything(), 1));
    add_parameter("Lower corner", lower, "With 'Upper corner': only what lies in this box at the start [length].", prm,
                  Patterns::List(Patterns::Double(), 0, dim));
    add_parameter("Upper corner", upper, "With 'Lower corner': only what lies in this box at the start [length].", prm,
                  Patterns::List(Patterns::Double(), 0, dim));
    add_parameter("Points per cell edge", points_per_cell, "Number of surface points along the edge of a cell.", prm,
                  Patterns::Integer(1, 16));
  }

  template <int dim>
  void Traction<dim>::parse_parameters(ParameterHandler &)
  {
    const std::string entry = kind == "traction" ? "Traction" : kind == "force" ? "Force" : "Pressure";
    if (kind == "pressure" && function_text.find(';') != std::string::npos)
      throw EntryError(get_section_name(), entry,
                       "expected one expression, found '" + function_text + "'. It acts along the surface's normal.");
    function.initialize(kind == "pressure" ? repeated(function_text, dim) : function_text, get_section_name(), entry);
    if (lower.size() != upper.size() || (!lower.empty() && lower.size() != dim))
      throw EntryError(get_section_name(), "Lower corner",
                       "give both corners of the box with " + std::to_string(dim) + " numbers each.");
    for (unsigned int d = 0; d < lower.size(); ++d)
      if (!(upper[d] >= lower[d]))
        throw EntryError(get_section_name(), "Upper corner",
                         "the box is upside down: this corner must not lie below the lower corner, as it does along " +
                           std::string(1, "xyz"[d]) + ". Exchange the two numbers.");
  }

  template <int dim>
  void Traction<dim>::attach(const Grid<dim> &grid, const std::vector<std::unique_ptr<Body<dim>>> &bodies,
                             const Particles<dim> &particles)
  {
    for (unsigned int b = 0; b < bodies.size(); ++b)
      if (bodies[b]->name == body_name)
        find_anchors(surface(grid, *bodies[b]), grid, b, particles);
    arrangement = 0;
  }

  template <int dim>
  Surface<dim> Traction<dim>::surface(const Grid<dim> &grid, const Body<dim> &body) const
  {
    Surface<dim> surface;
    if (kind == "force")
    {
      surface.resize(1);
      for (unsigned int d = 0; d < dim; ++d)
        surface[0].x[d] = position[d];
      return surface;
    }
    // What a mesh cuts off a surface no rank can say alone.
    if (body.is_clipped && grid.keeps_places())
      throw EntryError(get_section_name(), "Body",
                       "'" + body.name +
                         "' is clipped, and loads on clipped bodies need a box grid. Let the body end at the boundary "
                         "of the mesh, with 'Clip to grid = false'.");
    SurfaceSpacing<dim> spacing;
    for (unsigned int d = 0; d < dim; ++d)
      spacing[d] = grid.spacing[d] / points_per_cell;
    const auto names = body.shape->face_names();
    if (names.empty())
      throw EntryError(get_section_name(), "Body",
                       "the shape of '" + body.name +
                         "' has no surface that carries a load. Use a point force, or "
                         "another shape.");
    for (const auto &face : faces)
      if (face != "all" && std::find(names.begin(), names.end(), face) == names.end())
        throw EntryError(get_section_name(), "Faces",
                         "'" + body.name + "' has no face '" + face + "'. Choices: all, " +
                           Patterns::Tools::to_string(names) + ".");
    for (const auto &name : names)
      if (std::find(faces.begin(), faces.end(), "all") != faces.end() ||
          std::find(faces.begin(), faces.end(), name) != faces.end())
        for (const auto &point : body.shape->face(name, spacing))
        {
          bool is_inside = true;
          for (unsigned int d = 0; d < lower.size(); ++d)
            is_inside = is_inside && grid.is_between(point.x[d], lower[d], upper[d], d);
          if (!is_inside)
            continue;
          surface.push_back(point);
          if (!body.is_clipped)
            continue;
          surface.back().area *= grid.share_inside(surface.back().x);
          if (surface.back().area.norm() == 0)
            surface.pop_back();
        }
    if (surface.empty() && lower.empty())
      throw EntryError(get_section_name(), "Faces",
                       "'" + body.name + "' is clipped by the grid, and nothing of these faces is left. Name others.");
    if (surface.empty())
      throw EntryError(
        get_section_name(), "Lower corner",
        "no point of the surface lies in this box. Make it larger, or ask for more points per cell edge.");
    return surface;
  }

  template <int dim>
  Tensor<1, dim> Traction<dim>::point_force(const Anchor &anchor, const Host &host, const double time) const
  {
    const dealii::Point<dim> x(host.x + host.F * anchor.offset);
    const Tensor<1, dim>     value = function.value(x, time);
    if (kind == "force")
      return value;
    if (kind == "traction")
      return value * anchor.area.norm();
    // Nanson: da = J F^-T dA
    return -value[0] * determinant(host.F) * (transpose(invert(host.F)) * anchor.area);
  }

  template <int dim>
  void Traction<dim>::apply(const Particles<dim> &particles, const Kernel<dim> &kernel, const double time,
                            Grid<dim> &grid)
  {
    using Fields = NodalFields<dim>;
    if (arrangement != particles.arrangement)
      find_local_hosts(particles);
    force = 0;
    Stencil<dim> stencil;
    for (Host &host : hosts)
    {
      host.x      = particles.vector(particles.position, host.p);
      host.F      = particles.matrix(particles.F, host.p);
      host.force  = 0;
      host.moment = 0;
      for (unsigned int s = host.begin; s < host.end; ++s)
      {
        const Tensor<1, dim> f = point_force(anchors[s], host, time);
        host.force += f / n_layers;
        host.moment += outer_product(f, anchors[s].arm);
      }
      force += host.force;
      const Tensor<2, dim> flux = host.moment * transpose(host.F);
      kernel.evaluate(particles, host.p, host.p + 1, &stencil);
      for (unsigned int k = 0; k < stencil.size; ++k)
      {
        double numbers[Fields::stride] = {};
        for (unsigned int d = 0; d < dim; ++d)
        {
          numbers[Fields::force + d] = stencil.weight[k] * host.force[d];
          for (unsigned int e = 0; e < dim; ++e)
            numbers[Fields::force + d] += flux[d][e] * stencil.gradient[e][k];
        }
        const unsigned int beyond = stencil.has_images ? stencil.beyond[k] : 0;
        grid.fields.count_mirrored(numbers, beyond);
        for (unsigned int lane = Fields::force; lane < Fields::force + dim; ++lane)
          grid.fields.at_place(stencil.place[k])[lane] += Fields::mirror(beyond)[lane] * numbers[lane];
      }
    }
  }

  template <int dim>
  void Traction<dim>::finish(const Particles<dim> &particles)
  {
    work = 0;
    for (const Host &host : hosts)
      work += host.force * (particles.vector(particles.position, host.p) - host.x) +
              scalar_product(host.moment, particles.matrix(particles.F, host.p) - host.F);
  }

  template class Traction<2>;
  template class Traction<3>;
} // namespace Talus

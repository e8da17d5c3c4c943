#include <talus/boundary/condition.h>
#include <talus/core/exceptions.h>
#include <talus/core/half_space.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace Talus
{
  using namespace dealii;

  template <int dim>
  Condition<dim>::Condition(const std::string &section) : ParameterAcceptor(section)
  {
    add_parameter("Boundary ids", boundary_ids,
                  "Faces of the grid's box: 0, 1 are the lower and upper face in x, 2, 3 in y, 4, 5 in z.", prm,
                  Patterns::List(Patterns::Integer(0, 2 * dim - 1), 0, 2 * dim));
    add_parameter(
      "Boundaries", boundaries,
      "Parts of a mesh's boundary by name or number: its groups of faces ('Type = mesh' in section 'Grid').", prm,
      Patterns::List(Patterns::Anything()));
    add_parameter("Half spaces", half_spaces,
                  "All nodes at and beyond walls inside the grid, for instance 'x <= 0.1, y >= 2' [length].", prm,
                  Patterns::List(Patterns::Anything()));
    add_parameter("Lower corner", lower, "With 'Upper corner': all nodes in this box [length].", prm,
                  Patterns::List(Patterns::Double(), 0, dim));
    add_parameter("Upper corner", upper, "With 'Lower corner': all nodes in this box [length].", prm,
                  Patterns::List(Patterns::Double(), 0, dim));
    add_parameter("Where", where_text,
                  "A formula of x, y, z: of these nodes, or of all where nothing else is given, the condition acts on "
                  "those where it is not 0, 'x > 1 && y < 0.5 * x' [length]; empty: on all of these.");
    add_parameter("Start time", start_time,
                  "The condition acts in steps that end after this time [time]; empty: from the start of the run.", prm,
                  Patterns::List(Patterns::Double(), 0, 1));
    add_parameter("End time", end_time, "It acts in steps that end by this time [time]; empty: to the end of the run.",
                  prm, Patterns::List(Patterns::Double(), 0, 1));
  }

  template <int dim>
  void Condition<dim>::parse_parameters(ParameterHandler &)
  {
    if (lower.size() != upper.size() || (!lower.empty() && lower.size() != dim))
      throw EntryError(get_section_name(), "Lower corner",
                       "give both corners of the box with " + std::to_string(dim) + " numbers each.");
    for (unsigned int d = 0; d < lower.size(); ++d)
      if (!(upper[d] >= lower[d]))
        throw EntryError(get_section_name(), "Upper corner",
                         "the box is upside down: this corner must not lie below the lower corner, as it does along " +
                           std::string(1, "xyz"[d]) + ". Exchange the two numbers.");
    faces = boundary_ids;
    positions.clear();
    for (const std::string &half_space : half_spaces)
      read_half_space(half_space);
    where.initialize(where_text, get_section_name(), "Where");
    if (faces.empty() && lower.empty() && boundaries.empty() && !where.is_given())
      throw EntryError(
        get_section_name(), "Boundary ids",
        "the condition acts nowhere. Give boundary ids, half spaces, the corners of a box of nodes, or a "
        "formula 'Where'.");
    if (!start_time.empty() && !end_time.empty() && !(end_time[0] > start_time[0]))
      throw EntryError(get_section_name(), "End time",
                       "the condition never acts. Give a time after the start time, or nothing for no end.");
  }

  template <int dim>
  void Condition<dim>::read_half_space(const std::string &text)
  {
    const auto half_space = Talus::read_half_space(text, dim);
    if (!half_space)
      throw EntryError(get_section_name(), "Half spaces",
                       "cannot understand '" + text + "'. Write an axis, <= or >=, and a number: x <= 0.1");
    faces.push_back(2 * half_space->axis + (half_space->is_upper ? 1 : 0));
    positions.push_back(half_space->position);
  }

  template <int dim>
  std::vector<typename Condition<dim>::Edge> Condition<dim>::edges() const
  {
    std::vector<Edge> edges;
    for (unsigned int s = 0; s < positions.size(); ++s)
    {
      const unsigned int face = faces[boundary_ids.size() + s];
      edges.push_back({face / 2, face % 2 == 0, positions[s], "Half spaces"});
    }
    for (unsigned int d = 0; d < lower.size(); ++d)
    {
      edges.push_back({d, false, lower[d], "Lower corner"});
      edges.push_back({d, true, upper[d], "Upper corner"});
    }
    return edges;
  }

  template <int dim>
  bool Condition<dim>::hold(const unsigned int i, const Tensor<1, dim> &n)
  {
    bool was_free = true;
    for (unsigned int d = 0; d < dim; ++d)
      if (std::abs(n[d]) > 1e-9)
        was_free = held->hold(i, d) && was_free;
    return was_free;
  }

  template <int dim>
  void Condition<dim>::set(const unsigned int i, const Tensor<1, dim> &n, const double velocity)
  {
    using Fields = NodalFields<dim>;
    double *node = grid->fields[i];
    double  v = 0, increment = 0;
    for (unsigned int d = 0; d < dim; ++d)
    {
      v += n[d] * node[Fields::velocity + d];
      increment += n[d] * node[Fields::increment + d];
    }
    const double change  = velocity - v;
    const double impulse = -node[Fields::mass] * change;
    reaction += impulse / dt * n;
    if (hold(i, n))
      nodal_force += node[Fields::mass] * increment / dt * n;
    work -= impulse * velocity;
    for (unsigned int d = 0; d < dim; ++d)
    {
      node[Fields::velocity + d] += change * n[d];
      node[Fields::increment + d] += change * n[d];
    }
  }

  template <int dim>
  void Condition<dim>::take_mirrored(const unsigned int face, Grid<dim> &grid)
  {
    const double force = std::exchange(grid.fields.mirrored_force[face], 0.);
    reaction[face / 2] += force;
    nodal_force[face / 2] += force;
  }

  template <int dim>
  void Condition<dim>::take_mirrored(Grid<dim> &grid)
  {
    for (const auto &part : parts)
      for (unsigned int face = 0; face < 2 * dim; ++face)
        if (part.mirrored_faces >> face & 1)
          take_mirrored(face, grid);
    // Planes inside a box mirror nothing.
    for (unsigned int f = boundary_ids.size(); !is_box && f < faces.size(); ++f)
      for (unsigned int d = 0; d < dim; ++d)
        if (d == faces[f] / 2 || !is_slip())
          take_mirrored(2 * d + faces[f] % 2, grid);
  }

  template <int dim>
  void Condition<dim>::arrest(const unsigned int i, const Tensor<1, dim> &n)
  {
    using Fields = NodalFields<dim>;
    double *node = grid->fields[i];
    double  v = 0, increment = 0;
    for (unsigned int d = 0; d < dim; ++d)
    {
      v += n[d] * node[Fields::velocity + d];
      increment += n[d] * node[Fields::increment + d];
    }
    const double impulse = node[Fields::mass] * increment;
    reaction += impulse / dt * n;
    if (hold(i, n))
      nodal_force += impulse / dt * n;
    for (unsigned int d = 0; d < dim; ++d)
    {
      node[Fields::velocity + d] -= v * n[d];
      node[Fields::increment + d] -= increment * n[d];
    }
  }

  template <int dim>
  void Condition<dim>::apply(const double time, const double dt, Grid<dim> &grid, HeldComponents<dim> &held)
  {
    this->dt    = dt;
    this->grid  = &grid;
    this->held  = &held;
    reaction    = 0;
    nodal_force = 0;
    work        = 0;
    if (acts(time))
      prescribe(time, grid);
  }

  template <int dim>
  void Condition<dim>::prescribe(const double time, Grid<dim> &grid, Prescribed<dim> &prescribed)
  {
    reaction    = 0;
    nodal_force = 0;
    work        = 0;
    if (!acts(time))
      return forget();
    this->prescribed = &prescribed;
    prescribe(time, grid);
    this->prescribed = nullptr;
  }

  template <int dim>
  bool Condition<dim>::acts(const double time) const
  {
    // A step belongs to the interval in which it ends: intervals that follow each other do not overlap.
    return (start_time.empty() || time > start_time[0]) && (end_time.empty() || time <= end_time[0]);
  }

  template <int dim>
  void Condition<dim>::mark_slip(std::vector<BoxFaces> &faces) const
  {
    for (unsigned int list = 0; list < all_nodes.size(); ++list)
    {
      // Nodes in a box or beyond a plane are held whatever the face.
      const unsigned int own = list < boundary_ids.size() ? 1u << boundary_ids[list] : (is_slip() ? 0u : ~0u);
      for (const unsigned int i : all_nodes[list])
        faces[i] = is_slip() ? faces[i] | own : faces[i] & ~own;
    }
  }

  template class Condition<2>;
  template class Condition<3>;
} // namespace Talus

#include <talus/boundary/condition.h>
#include <talus/core/exceptions.h>

#include <algorithm>
#include <utility>

namespace Talus
{
  using namespace dealii;

  template <int dim>
  void Condition<dim>::attach(const Grid<dim> &grid)
  {
    attach_parts(grid);
    all_nodes.clear();
    for (const unsigned int id : boundary_ids)
      all_nodes.push_back(grid.boundary(std::to_string(id)).nodes);
    for (unsigned int s = 0; s < positions.size(); ++s)
    {
      const unsigned int face = faces[boundary_ids.size() + s], axis = face / 2;
      // A node on the plane belongs to it, whatever round-off makes of its place.
      const double margin = 1e-9 * grid.spacing[axis];
      Point<dim>   a = grid.lower, b = grid.upper;
      for (unsigned int d = 0; d < dim; ++d)
      {
        a[d] -= grid.spacing[d];
        b[d] += grid.spacing[d];
      }
      (face % 2 == 0 ? b : a)[axis] = positions[s] + (face % 2 == 0 ? margin : -margin);
      all_nodes.push_back(grid.nodes_in_box(a, b));
      if (Utilities::MPI::sum<unsigned int>(all_nodes.back().size(), grid.communicator) == 0)
        throw EntryError(get_section_name(), "Half spaces",
                         "no node of the grid lies in '" + half_spaces[s] + "'. Move the plane into the grid.");
    }
    if (!lower.empty())
    {
      Point<dim> a, b;
      for (unsigned int d = 0; d < dim; ++d)
      {
        a[d] = lower[d];
        b[d] = upper[d];
      }
      all_nodes.push_back(grid.nodes_in_box(a, b));
      if (Utilities::MPI::sum<unsigned int>(all_nodes.back().size(), grid.communicator) == 0)
        throw EntryError(get_section_name(), "Lower corner",
                         "no node of the grid lies in this box. Make it at least a spacing wide, "
                         "or move it so that it holds the nodes meant.");
    }
    if (where.is_given())
      keep_where(grid);
    select(grid);
  }

  template <int dim>
  void Condition<dim>::keep_where(const Grid<dim> &grid)
  {
    if (faces.empty() && lower.empty() && boundaries.empty())
    {
      Point<dim> a = grid.lower, b = grid.upper;
      for (unsigned int d = 0; d < dim; ++d)
      {
        a[d] -= grid.spacing[d];
        b[d] += grid.spacing[d];
      }
      all_nodes.push_back(grid.nodes_in_box(a, b));
    }
    std::size_t n = 0;
    for (auto &list : all_nodes)
    {
      list.erase(std::remove_if(list.begin(), list.end(),
                                [&](const unsigned int i) { return !where.holds(grid.node_position(i)); }),
                 list.end());
      n += list.size();
    }
    for (auto &part : all_parts)
    {
      BoundaryPart<dim> kept;
      kept.mirrored_faces = part.mirrored_faces;
      for (unsigned int k = 0; k < part.nodes.size(); ++k)
        if (where.holds(grid.node_position(part.nodes[k])))
          kept.add(part.nodes[k], part.normals[k]);
      n += kept.nodes.size();
      part = std::move(kept);
    }
    if (Utilities::MPI::sum(n, grid.communicator) == 0)
      throw EntryError(get_section_name(), "Where", "the formula holds at no node that the condition acts on.");
  }

  template <int dim>
  void Condition<dim>::attach_parts(const Grid<dim> &grid)
  {
    is_box = dynamic_cast<const BoxGrid<dim> *>(&grid) != nullptr;
    if (is_box && !boundaries.empty())
      throw EntryError(get_section_name(), "Boundaries",
                       "the faces of a box grid have numbers and no names. Give 'Boundary ids'.");
    if (!is_box && !boundary_ids.empty())
      throw EntryError(get_section_name(), "Boundary ids",
                       "these are the faces of a box grid. Give 'Boundaries', names of the mesh's groups of faces.");
    all_parts.clear();
    for (const std::string &name : boundaries)
      try
      {
        all_parts.push_back(grid.boundary(name));
      }
      catch (const InputError &error)
      {
        throw EntryError(get_section_name(), "Boundaries", error.message);
      }
  }

  template <int dim>
  void Condition<dim>::select(const Grid<dim> &grid)
  {
    parts.assign(all_parts.size(), {});
    for (unsigned int list = 0; list < all_parts.size(); ++list)
    {
      parts[list].mirrored_faces = all_parts[list].mirrored_faces;
      for (unsigned int k = 0; k < all_parts[list].nodes.size(); ++k)
        if (grid.is_active[all_parts[list].nodes[k]])
          parts[list].add(all_parts[list].nodes[k], all_parts[list].normals[k]);
    }
    nodes.assign(all_nodes.size(), {});
    for (unsigned int list = 0; list < all_nodes.size(); ++list)
      for (const unsigned int i : all_nodes[list])
        if (grid.is_active[i])
          nodes[list].push_back(i);
  }

#define INSTANTIATE(dim)                                                                                               \
  template void Condition<dim>::attach(const Grid<dim> &);                                                             \
  template void Condition<dim>::keep_where(const Grid<dim> &);                                                         \
  template void Condition<dim>::attach_parts(const Grid<dim> &);                                                       \
  template void Condition<dim>::select(const Grid<dim> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Talus

#pragma once

#include <talus/grid/mesh.h>

#include <string>
#include <vector>

namespace Talus
{
  /** A mesh as it was read or made, before it is checked: vertices, simplices and named groups of boundary faces. */
  template <int dim>
  struct MeshInput
  {
    using Vector  = typename Mesh<dim>::Vector;
    using Corners = typename Mesh<dim>::Corners;

    /** A face of the boundary; one in several groups is listed for each of them. */
    struct Face
    {
      std::array<unsigned int, dim> vertices;
      unsigned int                  group;
    };

    /** A physical group of faces. */
    struct Group
    {
      unsigned int number;
      std::string  name; // may be empty
    };

    std::string          name; // the file, for messages
    std::vector<Vector>  positions;
    std::vector<Corners> cells;
    std::vector<Face>    faces;
    std::vector<Group>   groups;

    // Numbers by which messages name vertices and cells; empty: their places in the lists.
    std::vector<unsigned int> node_numbers, cell_numbers;

    unsigned int node_number(const unsigned int v) const { return node_numbers.empty() ? v : node_numbers[v]; }
    unsigned int cell_number(const unsigned int c) const { return cell_numbers.empty() ? c : cell_numbers[c]; }

    /** The place in `groups` of the one with this name or number. Throws InputError with those there are. */
    unsigned int find_group(const std::string &name_or_number) const;
  };

  /** "triangle", "tetrahedron". */
  template <int dim>
  const char *cell_word()
  {
    return dim == 1 ? "segment" : dim == 2 ? "triangle" : "tetrahedron";
  }
} // namespace Talus

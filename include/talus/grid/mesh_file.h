#pragma once

#include <talus/grid/mesh_input.h>

namespace Talus
{
  /**
   * Reads a gmsh file (MSH 4.1, ASCII) with cells of this dimension. Physical groups of faces become groups of the
   * mesh; faces in none of them do not count. deal.II's own reader would drop nodes that belong to no cell and names
   * of groups in silence, and cells could not be named by their numbers in the file.
   *
   * Throws InputError: no such file, another format, cells of another shape or dimension. Test: tests/mesh/file.cc.
   */
  template <int dim>
  MeshInput<dim> read_msh(const std::string &path);
} // namespace Talus

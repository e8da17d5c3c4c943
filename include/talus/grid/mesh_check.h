#pragma once

#include <talus/grid/mesh_input.h>

namespace Talus
{
  /**
   * Refuses meshes on which no kernel can work. Throws InputError that names file and cell or node: a node that belongs
   * to no cell; a cell that is flat (its height below 1e-6 of its longest edge); one that is inverted, so that it
   * overlaps a neighbour (the order of its vertices does not matter); more than two cells at a face; a node that hangs
   * on a face of which it is no vertex, or lies where another does. Test: tests/mesh/check.cc.
   */
  template <int dim>
  void check_mesh(const MeshInput<dim> &input);
} // namespace Talus

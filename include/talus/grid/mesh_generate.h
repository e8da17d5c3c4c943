#pragma once

#include <talus/grid/mesh_input.h>

namespace Talus
{
  /**
   * A box of boxes, each cut into dim! simplices around its diagonal (Kuhn). Along the first axis the boxes may be long
   * and short in turn, by this `ratio`. The faces of the whole are groups: 0 "lower x", 1 "upper x", 2 "lower y", ...
   * Test: tests/mesh/simplex_grid.cc.
   */
  template <int dim>
  MeshInput<dim> generate_mesh(const std::array<double, dim> &lower, const std::array<double, dim> &upper,
                               const std::array<unsigned int, dim> &n_cells, const double ratio);
} // namespace Talus

#pragma once

#include <talus/grid/grid.h>
#include <talus/kernels/kernel.h>

namespace Talus
{
  /**
   * The greatest omega / c [1/length] of a body that fills all cells of a mesh: by power iteration of
   * @f[ m_i^{-1} \sum_q V_q\, g_{iq} \cdot \sum_j g_{jq}\, u_j , \qquad m_i = \sum_q V_q \phi_{iq} , @f]
   * with one point q near each vertex of each cell. Heights of cells say little about it: nodes of UMLS move what lies
   * in all cells around them, a flat cell among others does no harm, and in a mesh one cell decides. From a start that
   * hangs on the nodes' places alone, so that it is the same on any number of ranks. Collective.
   * Test: tests/growth/meshes.cc.
   */
  template <int dim>
  double fastest_vibration(const Kernel<dim> &kernel, const Grid<dim> &grid);
} // namespace Talus

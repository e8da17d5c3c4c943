#pragma once

#include <talus/grid/mesh.h>
#include <talus/kernels/stencil.h>

namespace Talus
{
  /** Linear functions on simplices: the weights are the barycentric coordinates of x. Test: tests/mesh/kernels.cc. */
  template <int dim>
  void p1(const Mesh<dim> &mesh, const unsigned int cell, const double *x, Stencil<dim> &list)
  {
    const auto B = mesh.barycentric(cell, x);
    const auto g = mesh.gradients(cell);
    list.resize(dim + 1);
    for (unsigned int k = 0; k <= dim; ++k)
    {
      list.place[k]  = mesh.nodes[cell][k];
      list.weight[k] = B[k];
      for (unsigned int d = 0; d < dim; ++d)
      {
        list.offset[d][k]   = mesh.position[list.place[k]][d] - x[d];
        list.gradient[d][k] = g[k][d];
      }
    }
  }
} // namespace Talus

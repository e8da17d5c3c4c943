#pragma once

#include <talus/grid/mesh_input.h>

#include <deal.II/grid/tria.h>

namespace Talus
{
  /**
   * Fills an empty triangulation of simplices; on those in parts, on every rank alike. Faces get the number of the
   * first group that lists them as their boundary id, others 0.
   */
  template <int dim>
  void create_triangulation(const MeshInput<dim> &input, dealii::Triangulation<dim> &triangulation);
} // namespace Talus

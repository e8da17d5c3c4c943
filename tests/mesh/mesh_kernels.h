#pragma once

#include "meshes.h"

#include <talus/kernels/mesh/c1_umls.h>
#include <talus/kernels/mesh/p1.h>

namespace Test
{
  /** A kernel on a mesh. */
  template <int dim>
  struct MeshKernel
  {
    std::string                                                                                 name;
    std::function<void(const unsigned int cell, const Coordinates<dim> &x, Stencil<dim> &list)> evaluate;
  };

  template <class Weight, int dim>
  MeshKernel<dim> umls_kernel(const std::string &name, const Mesh<dim> &mesh, const UmlsOptions options)
  {
    return {name, [&mesh, options](const unsigned int c, const Coordinates<dim> &x, Stencil<dim> &list) {
              const MeshPoint<dim> point{c, x};
              umls<Weight>(mesh, 1, &point, options, &list);
            }};
  }

  template <class Weight, int dim>
  MeshKernel<dim> c1_kernel(const std::string &name, const Mesh<dim> &mesh, const UmlsOptions options)
  {
    return {name, [&mesh, options](const unsigned int c, const Coordinates<dim> &x, Stencil<dim> &list) {
              const MeshPoint<dim> point{c, x};
              c1_umls<Weight>(mesh, 1, &point, options, &list);
            }};
  }

  template <int dim>
  MeshKernel<dim> p1_kernel(const Mesh<dim> &mesh)
  {
    return {"P1", [&mesh](const unsigned int c, const Coordinates<dim> &x, Stencil<dim> &list) {
              p1(mesh, c, x.data(), list);
            }};
  }

  inline constexpr auto global = UmlsOptions::Support::global, local = UmlsOptions::Support::local;

  template <int dim>
  std::vector<MeshKernel<dim>> paper_kernels(const Mesh<dim> &mesh)
  {
    return {umls_kernel<CubicWeight>("cubic, local", mesh, {local, true}),
            umls_kernel<CubicWeight>("cubic, global", mesh, {global, true}),
            umls_kernel<QuadraticWeight>("quadratic, local", mesh, {local, true}),
            umls_kernel<QuadraticWeight>("quadratic, global", mesh, {global, true})};
  }

  template <int dim>
  std::vector<MeshKernel<dim>> c1_kernels(const Mesh<dim> &mesh)
  {
    return {c1_kernel<CubicWeight>("C1, cubic, local", mesh, {local, true}),
            c1_kernel<CubicWeight>("C1, cubic, global", mesh, {global, true}),
            c1_kernel<QuadraticWeight>("C1, quadratic, local", mesh, {local, true})};
  }

  /** A stencil by node. */
  template <int dim>
  struct NodeValues
  {
    NodeValues(const Mesh<dim> &mesh, const MeshKernel<dim> &kernel, const unsigned int cell,
               const Coordinates<dim> &x) :
      weight(mesh.n_nodes(), 0.),
      gradient(mesh.n_nodes(), Coordinates<dim>{})
    {
      static Stencil<dim> list;
      kernel.evaluate(cell, x, list);
      for (unsigned int k = 0; k < list.size; ++k)
      {
        weight[list.place[k]] += list.weight[k];
        for (unsigned int d = 0; d < dim; ++d)
        {
          gradient[list.place[k]][d] += list.gradient[d][k];
          raise(offset_error, list.offset[d][k] - (mesh.position[list.place[k]][d] - x[d]));
        }
      }
    }
    std::vector<double>           weight;
    std::vector<Coordinates<dim>> gradient;
    double                        offset_error = 0;
  };
} // namespace Test

#pragma once

#include <talus/grid/mesh.h>
#include <talus/kernels/mesh/moment_sums.h>
#include <talus/kernels/stencil.h>
#include <talus/kernels/mesh/weights.h>

#include <algorithm>

namespace Talus
{
  /** What can be chosen of kernels by moving least squares on meshes. */
  struct UmlsOptions
  {
    /** The length s: the longest edge of the mesh, or that at each vertex, interpolated. */
    enum class Support
    {
      global,
      local
    };
    Support support   = Support::local;
    bool    has_gamma = true; // without it the kernel jumps at faces: for comparison only
  };

  /** The sums of `share` over all subsets of a cell's vertices; bit u of the index stands for vertex u. All are 1. */
  template <int dim>
  std::array<double, 2 << dim> subset_sums(const std::array<double, dim + 1> &share)
  {
    std::array<double, 2 << dim> sums{};
    for (unsigned int u = 0; u <= dim; ++u)
      for (unsigned int set = 0; set < 1u << u; ++set)
        sums[set | 1 << u] = sums[set] + share[u];
    sums.back() = 1;
    return sums;
  }

  /** The shares of a cell's vertices, none of them zero where nodes are held: their moments would be singular. */
  template <int dim>
  std::array<double, dim + 1> at_least_shares(const Mesh<dim> &mesh, const unsigned int cell,
                                              std::array<double, dim + 1> share)
  {
    if (mesh.has_held(cell))
      for (double &s : share)
        s = std::max(s, mesh.least_share);
    return share;
  }

  /**
   * Lists the ring of a cell: nodes and offsets; calls `body(lists, k, touches)` for each entry,
   * touches = 0 for the filling.
   */
  template <int dim, class Body>
  typename Stencil<dim>::Arrays list_ring(const Mesh<dim> &mesh, const unsigned int cell, const double *x,
                                           Stencil<dim> &list, const Body &body)
  {
    const std::size_t    begin    = mesh.rings.begin[cell];
    const unsigned int  *ring     = &mesh.rings.node[begin];
    const unsigned char *touches  = &mesh.rings.touches[begin];
    const auto          *position = mesh.position.data();
    const auto           to       = list.resize(mesh.rings.size(cell));
    const auto           set      = [&](const unsigned int k, const unsigned int v) {
      to.place[k] = v;
      for (unsigned int d = 0; d < dim; ++d)
        to.offset[d][k] = position[v][d] - x[d];
    };
    for (unsigned int k = 0; k < list.size; ++k)
    {
      set(k, ring[k]);
      body(to, k, touches[k]);
    }
    for (unsigned int k = list.size; k < to.padded_size; ++k)
    {
      set(k, ring[0]);
      body(to, k, 0);
    }
    return to;
  }

  /** s at a point where the vertices of its cell have these shares. */
  template <int dim>
  double support_length(const Mesh<dim> &mesh, const unsigned int cell, const std::array<double, dim + 1> &share,
                        const UmlsOptions &options)
  {
    if (options.support == UmlsOptions::Support::global)
      return mesh.longest_edge;
    double s = 0;
    for (unsigned int u = 0; u <= dim; ++u)
      s += share[u] * mesh.size[mesh.nodes[cell][u]];
    return s;
  }

  /**
   * Unstructured moving least squares (Cao et al.): with d_v = (x_v - x)/s, p_v = [1, d_v],
   * @f[ w_v = b(|d_v|)\,\gamma_v , \quad \gamma_v = \sum_{u \in K} A_{uv} B_u , \quad
   *     [\phi_v,\; s\,g_v] = M^{-1} p_v w_v , \quad M = \sum_v w_v p_v p_v^T . @f]
   * Weights and the coefficients g_v, which serve as gradients, are continuous across faces; g_v is not the derivative
   * of phi_v. Own vertices have gamma = 1. Test: tests/mesh/kernels.cc.
   */
  template <class Weight, int dim>
  void umls(const Mesh<dim> &mesh, const unsigned int cell, const double *x, const UmlsOptions &options,
            Stencil<dim> &list)
  {
    using Lanes               = typename Stencil<dim>::Lanes;
    constexpr unsigned int w8 = Stencil<dim>::width;

    const auto   B         = at_least_shares(mesh, cell, mesh.barycentric(cell, x));
    const double inverse_s = 1 / support_length(mesh, cell, B, options);
    const auto   gamma     = subset_sums<dim>(B);
    const auto   to =
      list_ring(mesh, cell, x, list, [&](const auto &to, const unsigned int k, const unsigned int touches) {
        to.weight[k] = options.has_gamma || touches == 0 ? gamma[touches] : 1.;
      });

    MomentSums<dim, w8> M;
    Lanes               d[dim];
    for (unsigned int k = 0; k < to.padded_size; k += w8)
    {
      Lanes square = 0.;
      for (unsigned int e = 0; e < dim; ++e)
      {
        d[e] = inverse_s * Lanes::load(to.offset[e] + k);
        square += d[e] * d[e];
      }
      const Lanes weight = Lanes::load(to.weight + k) * Weight::value(sqrt(square));
      weight.store(to.weight + k);
      M.add(weight, d);
    }

    const auto inverse = M.inverse();
    for (unsigned int k = 0; k < to.padded_size; k += w8)
    {
      const Lanes weight = Lanes::load(to.weight + k);
      for (unsigned int e = 0; e < dim; ++e)
        d[e] = inverse_s * Lanes::load(to.offset[e] + k);
      for (unsigned int i = 0; i <= dim; ++i)
      {
        Lanes sum = inverse[i][0];
        for (unsigned int e = 0; e < dim; ++e)
          sum += inverse[i][e + 1] * d[e];
        if (i == 0)
          (weight * sum).store(to.weight + k);
        else
          (weight * sum * inverse_s).store(to.gradient[i - 1] + k);
      }
    }
  }
} // namespace Talus

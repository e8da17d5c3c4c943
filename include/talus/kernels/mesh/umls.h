#pragma once

#include <talus/grid/mesh.h>
#include <talus/kernels/mesh/moment_sums.h>
#include <talus/kernels/stencil.h>
#include <talus/kernels/mesh/weights.h>

#include <algorithm>
#include <cstring>

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
  template <int dim, class Number>
  [[gnu::always_inline]] inline std::array<Number, 2 << dim> subset_sums(const std::array<Number, dim + 1> &share)
  {
    std::array<Number, 2 << dim> sums;
    sums[0] = 0.;
    for (unsigned int u = 0; u <= dim; ++u)
      for (unsigned int set = 0; set < 1u << u; ++set)
        sums[set | 1 << u] = sums[set] + share[u];
    sums.back() = 1.;
    return sums;
  }

  /** gamma of a node by the set of vertices that it touches; of none 0. */
  template <int dim, class Number>
  [[gnu::always_inline]] inline std::array<Number, 2 << dim> gamma_of_sets(const std::array<Number, dim + 1> &share,
                                                                           const UmlsOptions                 &options)
  {
    auto gamma = subset_sums<dim, Number>(share);
    if (!options.has_gamma)
      std::fill(gamma.begin() + 1, gamma.end(), 1.);
    return gamma;
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

  /** A number of mesh_width particles for each set of a cell's vertices: what nodes get by the set that they touch. */
  template <int dim>
  class SetTable
  {
  public:
    using Lanes = Simd<mesh_width>;

    [[gnu::always_inline]] void set(const std::array<Lanes, 2 << dim> &values)
    {
      for (unsigned int s = 0; s < values.size(); ++s)
        values[s].store(value[s]);
    }

    /** Those of particle l for the nodes of a register. */
    [[gnu::always_inline]] Lanes operator()(const unsigned char *touches, const unsigned int l) const
    {
      Lanes result;
      for (unsigned int k = 0; k < mesh_width; ++k)
        result.set(k, value[touches[k]][l]);
      return result;
    }

  private:
    alignas(64) double value[2 << dim][mesh_width];
  };

  /** Nodes beyond mirrors: what they carry is that of their images. */
  template <int dim>
  void list_images(const Mesh<dim> &mesh, Stencil<dim> &list)
  {
    const unsigned int n = mesh.n_nodes();
    list.has_images      = true;
    for (unsigned int k = 0; k < list.size; ++k)
    {
      const unsigned int v = list.place[k];
      list.place[k]        = mesh.real(v);
      list.beyond[k]       = v < n ? 0 : mesh.images[v - n].beyond;
    }
  }

  /** Lists the ring of a cell: nodes and offsets; calls `body(k, offset, touches)` for each register of nodes k, ... */
  template <int dim, class Body>
  [[gnu::always_inline]] inline typename Stencil<dim>::Arrays list_ring(const Mesh<dim> &mesh, const unsigned int cell,
                                                                        const double *x, Stencil<dim> &list,
                                                                        const Body &body)
  {
    using Lanes             = Simd<mesh_width>;
    const auto       &rings = mesh.ring_lanes;
    const std::size_t begin = rings.begin[cell];
    const auto        to    = list.resize(mesh.rings.size(cell));
    for (unsigned int k = 0; k < list.size; k += mesh_width)
    {
      std::memcpy(to.place + k, &rings.node[begin + k], mesh_width * sizeof(unsigned int));
      Lanes offset[dim];
      for (unsigned int d = 0; d < dim; ++d)
      {
        offset[d] = Lanes::load(&rings.x[d][begin + k]) - Lanes(x[d]);
        offset[d].store(to.offset[d] + k);
      }
      body(to, k, offset, &rings.touches[begin + k]);
    }
    if (!mesh.images.empty())
      list_images(mesh, list);
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

  /** A point and its cell, where a kernel is wanted. */
  template <int dim>
  struct MeshPoint
  {
    unsigned int            cell;
    std::array<double, dim> x;
  };

  /** Of a point's list with weights w: [phi, g] = w (first column of M^-1 + the others . d), d = offset / s. */
  template <int dim>
  [[gnu::always_inline]] inline void solve_weights(const InverseMoments<dim> &inverse, const unsigned int l,
                                                   const double inverse_s, const typename Stencil<dim>::Arrays &to,
                                                   const unsigned int size)
  {
    using Lanes = Simd<mesh_width>;
    Lanes first[dim + 1], other[dim + 1][dim];
    for (unsigned int i = 0; i <= dim; ++i)
    {
      const double scale = i == 0 ? 1. : inverse_s;
      first[i]           = scale * inverse(i, 0, l);
      for (unsigned int e = 0; e < dim; ++e)
        other[i][e] = scale * inverse_s * inverse(i, e + 1, l);
    }
    for (unsigned int k = 0; k < size; k += mesh_width)
    {
      const Lanes weight = Lanes::load(to.weight + k);
      Lanes       offset[dim];
      for (unsigned int e = 0; e < dim; ++e)
        offset[e] = Lanes::load(to.offset[e] + k);
      for (unsigned int i = 0; i <= dim; ++i)
      {
        Lanes sum = first[i];
        for (unsigned int e = 0; e < dim; ++e)
          sum += other[i][e] * offset[e];
        (weight * sum).store((i == 0 ? to.weight : to.gradient[i - 1]) + k);
      }
    }
  }

  /**
   * Unstructured moving least squares (Cao et al.) at up to mesh_width points: with d_v = (x_v - x)/s, p_v = [1, d_v],
   * @f[ w_v = b(|d_v|)\,\gamma_v , \quad \gamma_v = \sum_{u \in K} A_{uv} B_u , \quad
   *     [\phi_v,\; s\,g_v] = M^{-1} p_v w_v , \quad M = \sum_v w_v p_v p_v^T . @f]
   * Weights and the coefficients g_v, which serve as gradients, are continuous across faces; g_v is not the derivative
   * of phi_v. Own vertices have gamma = 1. Test: tests/mesh/kernels.cc.
   */
  template <class Weight, int dim>
  [[gnu::flatten]] void umls(const Mesh<dim> &mesh, const unsigned int n, const MeshPoint<dim> *points,
                             const UmlsOptions &options, Stencil<dim> *lists)
  {
    using Lanes = Simd<mesh_width>;
    SumsOfParticles<MomentSums<dim>::n_sums> sums;
    double                                   inverse_s[mesh_width];
    typename Stencil<dim>::Arrays            to[mesh_width];
    std::array<Lanes, dim + 1>               B;
    for (unsigned int l = 0; l < mesh_width; ++l)
    {
      const auto &point = points[l < n ? l : 0];
      const auto  share = at_least_shares(mesh, point.cell, mesh.barycentric(point.cell, point.x.data()));
      for (unsigned int u = 0; u <= dim; ++u)
        B[u].set(l, share[u]);
      inverse_s[l] = 1 / support_length(mesh, point.cell, share, options);
    }
    SetTable<dim> gamma;
    gamma.set(gamma_of_sets<dim, Lanes>(B, options));
    for (unsigned int l = 0; l < n; ++l)
    {
      const unsigned int cell  = points[l].cell;
      const Lanes        scale = inverse_s[l];
      MomentSums<dim>    M;
      to[l] = list_ring(mesh, cell, points[l].x.data(), lists[l],
                        [&](const auto &list, const unsigned int k, const auto &offset, const unsigned char *touches) {
                          Lanes d[dim], square = 0.;
                          for (unsigned int e = 0; e < dim; ++e)
                          {
                            d[e] = scale * offset[e];
                            square += d[e] * d[e];
                          }
                          const Lanes weight = gamma(touches, l) * Weight::value(sqrt(square));
                          weight.store(list.weight + k);
                          M.add(weight, d);
                        });
      sums.set(l, M.rows);
    }
    sums.fill(n);
    const InverseMoments<dim> inverse(sums);
    for (unsigned int l = 0; l < n; ++l)
      solve_weights<dim>(inverse, l, inverse_s[l], to[l], lists[l].size);
  }
} // namespace Talus

#pragma once

#include <talus/core/transpose.h>
#include <talus/kernels/mesh/c1_partition.h>
#include <talus/kernels/mesh/umls.h>

namespace Talus
{
  /**
   * Unstructured moving least squares whose weights are continuously differentiable, with their true gradients: gamma
   * and s are interpolated by the C1 partition eta instead of barycentric coordinates,
   * @f[ \gamma_v = \sum_{u \in K} A_{uv}\eta_u , \quad s = \sum_u \eta_u h_u , \quad w_v = b(|x_v - x|/s)\,\gamma_v ,
   * @f]
   * @f[ \nabla w_v = b\,\nabla\gamma_v - \gamma_v \frac{b'}{s}
   *       \left[\frac{x_v - x}{|x_v - x|} + q \nabla s\right] , \quad q = |x_v - x|/s . @f]
   * With p_v = [1, (x_v - x)/s_0], s_0 = s held constant, a = M^{-1} e_1, phi_v = w_v a.p_v and the coefficient g_v of
   * umls(),
   * @f[ \nabla\phi_v = g_v + (a\cdot p_v)\nabla w_v - w_v Q^T p_v , \quad
   *     Q = M^{-1} \sum_u (a\cdot p_u)\,p_u \nabla w_u^T . @f]
   * As these are true gradients, the integral of grad phi_v is its boundary term, and refinement converges on meshes
   * that are not uniform. At up to mesh_width points. Theory: doc/umls.md. Test: tests/mesh/kernels.cc.
   */
  template <class Weight, int dim>
  void c1_umls(const Mesh<dim> &mesh, const unsigned int n, const MeshPoint<dim> *points, const UmlsOptions &options,
               Stencil<dim> *lists);

  namespace internal
  {
    /** What the weights of mesh_width particles share: gamma and its gradient by the sets of vertices, 1/s, grad s. */
    template <int dim>
    class C1Points
    {
    public:
      using Lanes = Simd<mesh_width>;

      [[gnu::always_inline]] C1Points(const Mesh<dim> &mesh, const unsigned int n, const MeshPoint<dim> *points,
                                      const UmlsOptions &options)
      {
        std::array<Lanes, dim + 1>                  B, eta, size;
        std::array<std::array<Lanes, dim>, dim + 1> grad_B, grad_eta;
        Lanes                                       is_held = 0.;
        for (unsigned int l = 0; l < mesh_width; ++l)
        {
          const auto        &point    = points[l < n ? l : 0];
          const unsigned int cell     = point.cell;
          const auto         share    = mesh.barycentric(cell, point.x.data());
          const auto         gradient = mesh.gradients(cell);
          for (unsigned int u = 0; u <= dim; ++u)
          {
            B[u].set(l, share[u]);
            size[u].set(l, mesh.size[mesh.nodes[cell][u]]);
            for (unsigned int d = 0; d < dim; ++d)
              grad_B[u][d].set(l, gradient[u][d]);
          }
          is_held.set(l, mesh.has_held(cell) ? 1. : 0.);
        }
        const auto shares = c1_shares(feet_of<dim>(grad_B), B);
        for (unsigned int u = 0; u <= dim; ++u)
        {
          eta[u] = select(is_held > 0., max(shares.eta[u], Lanes(mesh.least_share)), shares.eta[u]);
          for (unsigned int d = 0; d < dim; ++d)
          {
            grad_eta[u][d] = 0.;
            for (unsigned int c = 0; c <= dim; ++c)
              grad_eta[u][d] += shares.slope[u][c] * grad_B[c][d];
          }
        }
        set_sizes(mesh, size, eta, grad_eta, options);
        set_gamma(eta, grad_eta, options);
      }

      /** Those of particle l for the nodes of a register: gamma, and the components of its gradient. */
      [[gnu::always_inline]] void gamma(const unsigned char *touches, const unsigned int l, Lanes (&rows)[4]) const
      {
        Simd<4> of_node[mesh_width];
        for (unsigned int k = 0; k < mesh_width; ++k)
          of_node[k] = Simd<4>::load(of_set[l][touches[k]]);
        vectors_to_lanes<mesh_width, 4>(of_node, rows);
      }

      alignas(64) double inverse_s[mesh_width], grad_s[dim][mesh_width];

    private:
      using Shares    = std::array<Lanes, dim + 1>;
      using Gradients = std::array<std::array<Lanes, dim>, dim + 1>;

      [[gnu::always_inline]] void set_sizes(const Mesh<dim> &mesh, const Shares &size, const Shares &eta,
                                            const Gradients &grad_eta, const UmlsOptions &options)
      {
        const bool is_local = options.support == UmlsOptions::Support::local;
        Lanes      s        = is_local ? 0. : mesh.longest_edge;
        for (unsigned int u = 0; is_local && u <= dim; ++u)
          s += eta[u] * size[u];
        (1. / s).store(inverse_s);
        for (unsigned int d = 0; d < dim; ++d)
        {
          Lanes grad = 0.;
          for (unsigned int u = 0; is_local && u <= dim; ++u)
            grad += grad_eta[u][d] * size[u];
          grad.store(grad_s[d]);
        }
      }

      [[gnu::always_inline]] void set_gamma(const Shares &eta, const Gradients &grad_eta, const UmlsOptions &options)
      {
        std::array<Lanes, 2 << dim> rows[1 + dim];
        rows[0] = gamma_of_sets<dim, Lanes>(eta, options);
        for (unsigned int d = 0; d < dim; ++d)
        {
          Shares component;
          for (unsigned int u = 0; u <= dim; ++u)
            component[u] = grad_eta[u][d];
          rows[1 + d]        = subset_sums<dim, Lanes>(component);
          rows[1 + d].back() = 0.;
          if (!options.has_gamma)
            rows[1 + d].fill(0.);
        }
        for (unsigned int set = 0; set < 2 << dim; set += 2)
        {
          Lanes   of_two[8];
          Simd<8> of_particle[mesh_width];
          for (unsigned int i = 0; i < 8; ++i)
            of_two[i] = i % 4 <= dim ? rows[i % 4][set + i / 4] : Lanes(0.);
          lanes_to_vectors<mesh_width>(of_two, of_particle);
          for (unsigned int l = 0; l < mesh_width; ++l)
            of_particle[l].store(of_set[l][set]);
        }
      }

      alignas(64) double of_set[mesh_width][2 << dim][4]; // side by side, so that a node reads them at once
    };

    template <int dim, class Lanes>
    [[gnu::always_inline]] inline Lanes dot(const Lanes *row, const Lanes (&d)[dim])
    {
      Lanes sum = row[0];
      for (unsigned int e = 0; e < dim; ++e)
        sum += row[e + 1] * d[e];
      return sum;
    }

    template <int dim, class Lanes>
    [[gnu::always_inline]] inline void scaled_offset(const typename Stencil<dim>::Arrays &to, const unsigned int k,
                                                     const double inverse_s, Lanes (&d)[dim])
    {
      for (unsigned int e = 0; e < dim; ++e)
        d[e] = inverse_s * Lanes::load(to.offset[e] + k);
    }

    /** Of a list with grad w: sum (a . p_u) p_u grad w_u^T by rows, each the sums of a register's lanes. */
    template <int dim>
    [[gnu::always_inline]] inline void gradient_moments(const InverseMoments<dim> &inverse, const unsigned int l,
                                                        const double inverse_s, const typename Stencil<dim>::Arrays &to,
                                                        const unsigned int size,
                                                        Simd<mesh_width> (&rows)[(dim + 1) * dim])
    {
      using Lanes = Simd<mesh_width>;
      Lanes a[dim + 1], d[dim];
      for (auto &row : rows)
        row = 0.;
      for (unsigned int i = 0; i <= dim; ++i)
        a[i] = inverse(0, i, l);
      for (unsigned int k = 0; k < size; k += mesh_width)
      {
        scaled_offset<dim>(to, k, inverse_s, d);
        const Lanes correction = dot<dim>(a, d);
        for (unsigned int e = 0; e < dim; ++e)
        {
          const Lanes term = correction * Lanes::load(to.gradient[e] + k);
          rows[e] += term;
          for (unsigned int i = 0; i < dim; ++i)
            rows[(i + 1) * dim + e] += d[i] * term;
        }
      }
    }

    /** Makes w and grad w of a list phi and grad phi; `row` is the factor of p in g_v - w_v Q^T p_v. */
    template <int dim>
    [[gnu::always_inline]] inline void true_gradients(const InverseMoments<dim> &inverse,
                                                      const double (&row)[dim][dim + 1][mesh_width],
                                                      const unsigned int l, const double inverse_s,
                                                      const typename Stencil<dim>::Arrays &to, const unsigned int size)
    {
      using Lanes = Simd<mesh_width>;
      Lanes a[dim + 1], of_gradient[dim][dim + 1], d[dim];
      for (unsigned int i = 0; i <= dim; ++i)
      {
        a[i] = inverse(0, i, l);
        for (unsigned int e = 0; e < dim; ++e)
          of_gradient[e][i] = row[e][i][l];
      }
      for (unsigned int k = 0; k < size; k += mesh_width)
      {
        scaled_offset<dim>(to, k, inverse_s, d);
        const Lanes weight = Lanes::load(to.weight + k), correction = dot<dim>(a, d);
        for (unsigned int e = 0; e < dim; ++e)
          (weight * dot<dim>(of_gradient[e], d) + correction * Lanes::load(to.gradient[e] + k))
            .store(to.gradient[e] + k);
        (weight * correction).store(to.weight + k);
      }
    }
  } // namespace internal

  template <class Weight, int dim>
  [[gnu::flatten]] void c1_umls(const Mesh<dim> &mesh, const unsigned int n, const MeshPoint<dim> *points,
                                const UmlsOptions &options, Stencil<dim> *lists)
  {
    using Lanes = Simd<mesh_width>;
    const internal::C1Points<dim>            at(mesh, n, points, options);
    SumsOfParticles<MomentSums<dim>::n_sums> moments;
    typename Stencil<dim>::Arrays            to[mesh_width];
    // Until the last loop the lists hold w and grad w.
    for (unsigned int l = 0; l < n; ++l)
    {
      const Lanes     scale = at.inverse_s[l];
      MomentSums<dim> M;
      to[l] = list_ring(mesh, points[l].cell, points[l].x.data(), lists[l],
                        [&](const auto &list, const unsigned int k, const auto &offset, const unsigned char *touches) {
                          Lanes d[dim], square = 0.;
                          for (unsigned int e = 0; e < dim; ++e)
                          {
                            d[e] = scale * offset[e];
                            square += d[e] * d[e];
                          }
                          Lanes gamma[4];
                          at.gamma(touches, l, gamma);
                          const Lanes q = sqrt(square), b = Weight::value(q);
                          const Lanes weight = b * gamma[0], slope = scale * gamma[0] * Weight::slope_over_q(q);
                          weight.store(list.weight + k);
                          for (unsigned int e = 0; e < dim; ++e)
                            (b * gamma[1 + e] - slope * (d[e] + square * at.grad_s[e][l])).store(list.gradient[e] + k);
                          M.add(weight, d);
                        });
      moments.set(l, M.rows);
    }
    moments.fill(n);
    const InverseMoments<dim> inverse(moments);

    SumsOfParticles<(dim + 1) * dim> Q; // before M^-1
    for (unsigned int l = 0; l < n; ++l)
    {
      Lanes rows[(dim + 1) * dim];
      internal::gradient_moments<dim>(inverse, l, at.inverse_s[l], to[l], lists[l].size, rows);
      Q.set(l, rows);
    }
    Q.fill(n);
    // The row of p in g_v - w_v Q^T p_v, for each component.
    alignas(64) double row[dim][dim + 1][mesh_width];
    for (unsigned int e = 0; e < dim; ++e)
      for (unsigned int i = 0; i <= dim; ++i)
      {
        Lanes sum = Lanes::load(at.inverse_s) * inverse.lanes(e + 1, i);
        for (unsigned int j = 0; j <= dim; ++j)
          sum -= inverse.lanes(i, j) * Q[j * dim + e];
        sum.store(row[e][i]);
      }

    for (unsigned int l = 0; l < n; ++l)
      internal::true_gradients<dim>(inverse, row, l, at.inverse_s[l], to[l], lists[l].size);
  }
} // namespace Talus

#pragma once

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
   * that are not uniform. Theory: doc/umls.md. Test: tests/mesh/kernels.cc.
   */
  template <class Weight, int dim>
  void c1_umls(const Mesh<dim> &mesh, const FootCoordinates<dim> &feet, const unsigned int cell, const double *x,
               const UmlsOptions &options, Stencil<dim> &list);

  namespace internal
  {
    /** What the weights of a particle share: gamma and its gradient by the vertices that a node touches, s, grad s. */
    template <int dim>
    struct C1Point
    {
      using Gradient = std::array<double, dim>;

      C1Point(const Mesh<dim> &mesh, const FootCoordinates<dim> &feet, const unsigned int cell, const double *x,
              const UmlsOptions &options)
      {
        const auto                  shares = c1_shares(feet, mesh.barycentric(cell, x));
        const auto                  grad_B = mesh.gradients(cell);
        std::array<double, dim + 1> eta, grad_eta[dim];
        for (unsigned int u = 0; u <= dim; ++u)
        {
          eta[u] = shares.eta[u];
          for (unsigned int d = 0; d < dim; ++d)
          {
            grad_eta[d][u] = 0;
            for (unsigned int c = 0; c <= dim; ++c)
              grad_eta[d][u] += shares.slope[u][c] * grad_B[c][d];
          }
        }
        eta   = at_least_shares(mesh, cell, eta);
        gamma = subset_sums<dim>(eta);
        s     = support_length(mesh, cell, eta, options);
        for (unsigned int d = 0; d < dim; ++d)
        {
          grad_gamma[d]        = subset_sums<dim>(grad_eta[d]);
          grad_gamma[d].back() = 0;
          grad_s[d]            = 0;
          if (options.support == UmlsOptions::Support::local)
            for (unsigned int u = 0; u <= dim; ++u)
              grad_s[d] += grad_eta[d][u] * mesh.size[mesh.nodes[cell][u]];
        }
        if (!options.has_gamma)
          for (unsigned int set = 1; set < gamma.size(); ++set)
          {
            gamma[set] = 1;
            for (auto &component : grad_gamma)
              component[set] = 0;
          }
      }

      std::array<double, 2 << dim> gamma, grad_gamma[dim];
      double                       s;
      Gradient                     grad_s;
    };

    template <int dim, class Lanes>
    Lanes dot(const double *row, const Lanes (&d)[dim])
    {
      Lanes sum = row[0];
      for (unsigned int e = 0; e < dim; ++e)
        sum += row[e + 1] * d[e];
      return sum;
    }
  } // namespace internal

  template <class Weight, int dim>
  void c1_umls(const Mesh<dim> &mesh, const FootCoordinates<dim> &feet, const unsigned int cell, const double *x,
               const UmlsOptions &options, Stencil<dim> &list)
  {
    using Lanes               = typename Stencil<dim>::Lanes;
    constexpr unsigned int w8 = Stencil<dim>::width;
    using Sums                = MomentSums<dim, w8>;

    const internal::C1Point<dim> point(mesh, feet, cell, x, options);
    const double                 inverse_s = 1 / point.s;
    const auto                   to =
      list_ring(mesh, cell, x, list, [&](const auto &to, const unsigned int k, const unsigned int touches) {
        to.weight[k] = point.gamma[touches];
        for (unsigned int d = 0; d < dim; ++d)
          to.gradient[d][k] = point.grad_gamma[d][touches];
      });

    Sums  M;
    Lanes d[dim];
    for (unsigned int k = 0; k < to.padded_size; k += w8)
    {
      Lanes square = 0.;
      for (unsigned int e = 0; e < dim; ++e)
      {
        d[e] = inverse_s * Lanes::load(to.offset[e] + k);
        square += d[e] * d[e];
      }
      const Lanes q = sqrt(square), b = Weight::value(q), gamma = Lanes::load(to.weight + k);
      const Lanes weight = b * gamma, slope = inverse_s * gamma * Weight::slope_over_q(q);
      weight.store(to.weight + k);
      for (unsigned int e = 0; e < dim; ++e)
        (b * Lanes::load(to.gradient[e] + k) - slope * (d[e] + square * point.grad_s[e])).store(to.gradient[e] + k);
      M.add(weight, d);
    }
    const auto inverse = M.inverse();

    // Q, before M^-1; until here the lists hold w and grad w.
    Lanes sums[dim + 1][dim];
    for (auto &row : sums)
      for (auto &entry : row)
        entry = 0.;
    for (unsigned int k = 0; k < to.padded_size; k += w8)
    {
      for (unsigned int e = 0; e < dim; ++e)
        d[e] = inverse_s * Lanes::load(to.offset[e] + k);
      const Lanes correction = internal::dot<dim>(inverse[0].data(), d);
      for (unsigned int e = 0; e < dim; ++e)
      {
        const Lanes term = correction * Lanes::load(to.gradient[e] + k);
        sums[0][e] += term;
        for (unsigned int i = 0; i < dim; ++i)
          sums[i + 1][e] += d[i] * term;
      }
    }
    // The row of p in g_v - w_v Q^T p_v, for each component.
    double row[dim][dim + 1];
    for (unsigned int e = 0; e < dim; ++e)
    {
      double column[dim + 1];
      for (unsigned int i = 0; i <= dim; ++i)
        column[i] = Sums::sum(sums[i][e]);
      for (unsigned int i = 0; i <= dim; ++i)
      {
        row[e][i] = inverse_s * inverse[e + 1][i];
        for (unsigned int j = 0; j <= dim; ++j)
          row[e][i] -= inverse[i][j] * column[j];
      }
    }
    for (unsigned int k = 0; k < to.padded_size; k += w8)
    {
      for (unsigned int e = 0; e < dim; ++e)
        d[e] = inverse_s * Lanes::load(to.offset[e] + k);
      const Lanes weight = Lanes::load(to.weight + k), correction = internal::dot<dim>(inverse[0].data(), d);
      for (unsigned int e = 0; e < dim; ++e)
        (weight * internal::dot<dim>(row[e], d) + correction * Lanes::load(to.gradient[e] + k))
          .store(to.gradient[e] + k);
      (weight * correction).store(to.weight + k);
    }
  }
} // namespace Talus

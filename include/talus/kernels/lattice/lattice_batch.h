#pragma once

#include <talus/core/batch.h>
#include <talus/kernels/kernel.h>

namespace Talus
{
  /** Where the stencils of the particles of a batch begin on a lattice, one particle in each lane. */
  template <int dim>
  struct LatticePlaces
  {
    using Number = Simd<native_width>;

    Number first[dim];                           // lattice index of the stencil's first node
    Number distance[dim];                        // of the particle from it [h]
    alignas(64) int first_node[Number::n_lanes]; // place of the stencil's first node in the lattice's tables
    bool is_at_face;                             // one reaches a face of the domain, or beyond
  };

  /**
   * The stencils of the particles of a batch. Away from the domain's faces weights
   * and gradients are products of the axes' factors; at them they stand in lists, x
   * running fastest.
   */
  template <int dim, unsigned int n>
  struct LatticeBatch : LatticePlaces<dim>
  {
    using Number = Simd<native_width>;

    static constexpr unsigned int n_nodes = dim == 2 ? n * n : n * n * n;

    Number weight[dim][n], derivative[dim][n], offset[dim][n];

    // Where not a product.
    Number                value[n_nodes], gradient[dim][n_nodes];
    typename Number::Mask is_at_slip_wall[dim]; // nodes are missing along this axis, beyond a slip wall
    bool                  has_images;           // nodes beyond slip walls have weight: see Treatment::is_mirror()
  };

  /** The axes' weights times offsets, where they are needed. */
  template <int dim, unsigned int n, bool is_needed>
  struct LatticeMoments
  {
    explicit LatticeMoments(const LatticeBatch<dim, n> &stencil)
    {
      if constexpr (is_needed)
        for (unsigned int d = 0; d < dim; ++d)
          for (unsigned int k = 0; k < n; ++k)
            moment[d][k] = stencil.weight[d][k] * stencil.offset[d][k];
    }
    Simd<native_width> moment[dim][n];
  };

  /**
   * Calls `body(i, k, place, beyond)` for the existing nodes of a stencil that is a list; k is where along each axis.
   * The node at the place stands for its mirror image in the faces `beyond`, if there are any.
   */
  template <int dim, unsigned int n, class Body>
  [[gnu::always_inline]] inline void for_each_node(const Lattice<dim> &lattice, const LatticeBatch<dim, n> &stencil,
                                                   const unsigned int l, const Body &body)
  {
    for (unsigned int i = 0; i < stencil.n_nodes; ++i)
    {
      const unsigned int k[3]  = {i % n, i / n % n, i / (n * n)};
      unsigned int       place = stencil.first_node[l], beyond = 0;
      for (unsigned int d = 0; d < dim; ++d)
        place += k[d] * lattice.stride[d];
      if (lattice.node[place] == Lattice<dim>::missing)
      {
        if (!stencil.has_images || lattice.image[place] == Lattice<dim>::missing)
          continue;
        beyond = lattice.beyond[place];
        place  = lattice.image[place];
      }
      body(i, k, place, beyond);
    }
  }

  /** Lanes whose stencil meets a face of the domain as a slip wall. */
  template <int dim, unsigned int n>
  typename LatticeBatch<dim, n>::Number::Mask meets_slip_wall(const Lattice<dim>         &lattice,
                                                              const LatticeBatch<dim, n> &stencil,
                                                              const unsigned int          face)
  {
    using Number = typename LatticeBatch<dim, n>::Number;
    Number is_slip;
    for (unsigned int l = 0; l < Number::n_lanes; ++l)
      is_slip.set(l, lattice.slip_faces[stencil.first_node[l]] >> face & 1);
    return is_slip > Number(0.);
  }

  /** Fills the lists from the factors. */
  template <int dim, unsigned int n>
  void multiply(const LatticeFactors<dim> &factors, LatticeBatch<dim, n> &stencil)
  {
    using Number  = typename LatticeBatch<dim, n>::Number;
    const auto &w = factors.weight, &u = factors.coupling, &g = factors.derivative, &t = factors.cross;
    for (unsigned int i = 0; i < LatticeBatch<dim, n>::n_nodes; ++i)
    {
      const unsigned int k[3] = {i % n, i / n % n, i / (n * n)};
      // The product of the weights of the axes but two.
      const auto others = [&](const unsigned int d, const unsigned int e) {
        Number product = 1.;
        for (unsigned int f = 0; f < dim; ++f)
          if (f != d && f != e)
            product *= w[f][k[f]];
        return product;
      };
      stencil.value[i] = w[0][k[0]] * others(0, 0);
      for (unsigned int d = 0; d < dim; ++d)
      {
        if (factors.is_coupled)
          stencil.value[i] -= u[d][k[d]] * others(d, d);
        stencil.gradient[d][i] = g[d][k[d]] * others(d, d);
        if (factors.has_cross)
          for (unsigned int e = 0; e < dim; ++e)
            if (e != d)
              stencil.gradient[d][i] -= u[e][k[e]] * t[d][k[d]] * others(d, e);
      }
    }
  }

  /** What the treatment makes of a batch in which a stencil reaches beyond a face of the domain. */
  template <int dim, class Function>
  void correct_batch(const Function &function, const Lattice<dim> &lattice, const Treatment<dim> &treatment,
                     LatticeBatch<dim, Function::n> &stencil)
  {
    using Number             = Simd<native_width>;
    constexpr unsigned int n = Function::n;
    LatticeFactors<dim>    factors;
    factors.n              = n;
    factors.boundary_scale = Function::boundary_scale;
    // Round-off must not make a node at the very end of the support count as missing.
    const double reach     = function.support() - 1e-12;
    const bool   is_mirror = treatment.is_mirror();
    stencil.has_images     = is_mirror;
    for (unsigned int d = 0; d < dim; ++d)
    {
      factors.first[d]          = stencil.first[d];
      factors.last[d]           = lattice.n_cells[d];
      const Number coordinate   = stencil.first[d] + stencil.distance[d];
      const auto   misses_lower = coordinate + 1. < Number(reach);
      const auto   misses_upper = lattice.n_cells[d] + 1. - coordinate < Number(reach);
      const auto   slip_lower   = meets_slip_wall(lattice, stencil, 2 * d);
      const auto   slip_upper   = meets_slip_wall(lattice, stencil, 2 * d + 1);

      stencil.is_at_slip_wall[d] = (misses_lower & slip_lower) | (misses_upper & slip_upper);
      factors.is_truncated[d]    = misses_lower | misses_upper;
      if (is_mirror)
        factors.is_truncated[d] = (misses_lower & !slip_lower) | (misses_upper & !slip_upper);
      for (unsigned int k = 0; k < n; ++k)
      {
        const Number index    = stencil.first[d] + static_cast<double>(k);
        auto         is_there = (index >= Number(0.)) & (index <= Number(factors.last[d]));
        if (is_mirror)
          is_there = ((index >= Number(0.)) | slip_lower) & ((index <= Number(factors.last[d])) | slip_upper);
        factors.weight[d][k]     = select(is_there, stencil.weight[d][k], Number(0.));
        factors.derivative[d][k] = select(is_there, stencil.derivative[d][k], Number(0.));
        factors.offset[d][k]     = stencil.offset[d][k];
      }
    }
    treatment.correct_factors(factors);
    multiply(factors, stencil);
  }

  /** Finds the stencils of batches of particles and evaluates them; holds what all of them share. */
  template <int dim, class Function>
  class BatchEvaluator
  {
    using Number                    = Simd<native_width>;
    static constexpr unsigned int n = Function::n;

  public:
    BatchEvaluator(const Function &function, const Lattice<dim> &lattice, const Treatment<dim> &treatment) :
      function(function), lattice(lattice), treatment(treatment), least_squares(n > 2 && treatment.is_everywhere())
    {
      const bool needs_margin = treatment.needs_boundary_scale(); // Steffen changes complete stencils as well
      for (unsigned int d = 0; d < dim; ++d)
      {
        origin[d]    = lattice.origin[d];
        h[d]         = lattice.h[d];
        inverse_h[d] = lattice.inverse_h[d];
        stride[d]    = lattice.stride[d];
        // With ghosts every stencil in the domain is complete.
        lowest[d]  = treatment.has_ghosts() ? -2. : needs_margin ? 1. : 0.;
        highest[d] = lattice.n_cells[d] + (treatment.has_ghosts() ? 2. : needs_margin ? 0. - n : 1. - n);
        place_of_zero -= lattice.first[d] * stride[d];
      }
    }

    /** Where the stencils of the particles at `x` begin. */
    [[gnu::always_inline]] void locate(const dealii::Tensor<1, dim, Number> &x, LatticePlaces<dim> &places) const
    {
      auto   is_at_face = Number(1.) < Number(0.);
      Number place      = place_of_zero; // a whole number below 2^31
      for (unsigned int d = 0; d < dim; ++d)
      {
        const Number coordinate = (x[d] - origin[d]) * inverse_h[d];
        const Number first      = floor(coordinate - Number(Function::shift));
        places.first[d]         = first;
        places.distance[d]      = coordinate - first;
        place += first * stride[d];
        is_at_face = is_at_face | (first < Number(lowest[d])) | (first > Number(highest[d]));
      }
      store_integers(place, places.first_node);
      places.is_at_face = any(is_at_face);
    }

    /** Weights and gradients in stencils that are located. */
    [[gnu::always_inline]] void evaluate(LatticeBatch<dim, n> &stencil) const
    {
      for (unsigned int d = 0; d < dim; ++d)
      {
        const Number s = stencil.distance[d];
        function.evaluate(s, stencil.weight[d], stencil.derivative[d]);
        for (unsigned int k = 0; k < n; ++k)
          stencil.offset[d][k] = (static_cast<double>(k) - s) * h[d];
        if (least_squares)
        {
          // A complete B-spline has m0 = 1 and mean 0: see AxisMoments.
          Number variance = 0.;
          for (unsigned int k = 0; k < n; ++k)
            variance += stencil.weight[d][k] * stencil.offset[d][k] * stencil.offset[d][k];
          const Number inverse = 1. / variance;
          for (unsigned int k = 0; k < n; ++k)
            stencil.derivative[d][k] = stencil.weight[d][k] * stencil.offset[d][k] * inverse;
        }
        else
          for (unsigned int k = 0; k < n; ++k)
            stencil.derivative[d][k] *= inverse_h[d];
      }
      if (stencil.is_at_face)
        correct_batch<dim, Function>(function, lattice, treatment, stencil);
    }

    /** Whether complete stencils have the function's own values and derivatives. */
    bool leaves_complete_stencils() const { return !least_squares; }

  private:
    const Function       &function;
    const Lattice<dim>   &lattice;
    const Treatment<dim> &treatment;
    const bool            least_squares;

    // Of the lattice, as numbers: origin and spacing, table places, and the range of a complete stencil's first index.
    double origin[dim], h[dim], inverse_h[dim], stride[dim], lowest[dim], highest[dim], place_of_zero = 0;
  };
} // namespace Talus

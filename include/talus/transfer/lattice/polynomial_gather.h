#pragma once

#include <talus/grid/nodal_fields.h>
#include <talus/kernels/lattice/lattice_batch.h>
#include <talus/transfer/scheme.h>

namespace Talus
{
  /**
   * What the particles of a batch gather, Eqs. (23), (25), (26), where all stencils are
   * complete and the kernel is a B-spline: the field of a stencil is a polynomial then,
   * and particles with the same nodes evaluate the same one. Its coefficients are
   * found once for a run of particles, with the numbers of a node in the lanes; it
   * is evaluated with one particle in each lane, and weights are not needed.
   *
   * Round-off is that of the greatest velocity in the stencil, and not of its product
   * with the weight: of a nearly empty node, which the mass floor keeps below 1e6 times
   * the others, some ten digits are left of what it gives. The scatter has no such
   * choice: a small mass as a difference of large ones would have no digits at all.
   */
  template <int dim, class Scheme, class Function>
  class PolynomialGather
  {
    static constexpr unsigned int n       = Function::n;
    static constexpr unsigned int width   = native_width;
    static constexpr unsigned int n_nodes = LatticeBatch<dim, n>::n_nodes;

    // A batch mostly has three in 2D and two in 3D, with two particles per cell and axis; B takes the registers.
    static constexpr unsigned int n_runs = dim == 2 && !Scheme::gathers_B ? 3 : 2;

    using Fields = NodalFields<dim>;
    using Number = Simd<native_width>;

    // The lanes of a node that are read, from `first_lane` on.
    static constexpr bool         is_whole   = Scheme::gathers_increment && dim == 3;
    static constexpr unsigned int first_lane = is_whole ? 0 : Fields::velocity;
    using Node                               = Simd<is_whole ? 8 : 4>;

  public:
    PolynomialGather(const Lattice<dim> &lattice, const Fields &fields) : lattice(lattice), fields(fields)
    {
      for (Field &field : known)
        field.place = -1;
    }

    /** Lanes that repeat a particle are gathered as well. */
    [[gnu::always_inline]] Gathered<dim, Number> gather(const LatticePlaces<dim> &places)
    {
      const double          index[8] = {0, 1, 2, 3, 4, 5, 6, 7};
      const Number          lane     = Number::load(index);
      Gathered<dim, Number> sum;
      for (unsigned int l = 0; l < width;)
      {
        // Several runs at a time: their coefficients side by side, each in its own lanes.
        const Field          *of_run[n_runs];
        typename Number::Mask from_run[n_runs];
#pragma GCC unroll 4
        for (unsigned int r = 0; r < n_runs; ++r)
          if (r == 0 || l < width)
          {
            of_run[r]   = &field(places.first_node[l]);
            from_run[r] = lane >= Number(l);
            l           = end_of_run(places, l);
          }
          else
          {
            of_run[r]   = of_run[r - 1];
            from_run[r] = from_run[r - 1];
          }
        const auto coefficient = [&](const unsigned int i, const unsigned int c) {
          Number value = of_run[0]->coefficients[i].data()[c];
          for (unsigned int r = 1; r < n_runs; ++r)
            value = select(from_run[r], Number(of_run[r]->coefficients[i].data()[c]), value);
          return value;
        };
        merge(from_run[0], evaluate(places, coefficient), sum);
      }
      return sum;
    }

  private:
    /** The polynomial of a stencil: for each number of a node, coefficients as the nodes lie, x running fastest. */
    struct Field
    {
      int  place;
      Node coefficients[n_nodes];
    };

    /** What is needed of a polynomial in the axes up to some: derivatives and last coefficients in each. */
    struct Value
    {
      Number value, slope[dim], last[dim];
    };

    static unsigned int end_of_run(const LatticePlaces<dim> &places, unsigned int l)
    {
      const int place = places.first_node[l];
      do
        ++l;
      while (l < width && places.first_node[l] == place);
      return l;
    }

    /**
     * The polynomial of the stencil that begins at a place. It may be one of the last two found: neighbours along y and
     * z alternate where particles have drifted. Of what is asked for, the last `n_runs` stay.
     */
    [[gnu::always_inline]] const Field &field(const int place)
    {
      if (known[last].place == place)
        return known[last];
      const Field &before = known[last == 0 ? n_runs : last - 1];
      if (before.place == place)
        return before;
      last = last == n_runs ? 0 : last + 1;
      find(place, known[last]);
      return known[last];
    }

    [[gnu::always_inline]] void find(const int place, Field &found) const
    {
      found.place              = place;
      const double *const node = fields.at_place(place) + first_lane;
      if constexpr (dim == 2)
        find_plane(node, found.coefficients);
      else
      {
        for (unsigned int c = 0; c < n; ++c)
          find_plane(node + Fields::stride * (c * static_cast<std::ptrdiff_t>(lattice.stride[2])),
                     found.coefficients + c * n * n);
        for (unsigned int i = 0; i < n * n; ++i)
          find_line<n * n>(found.coefficients + i);
      }
    }

    [[gnu::always_inline]] void find_plane(const double *const node, Node *const u) const
    {
      const std::ptrdiff_t stride_y = Fields::stride * static_cast<std::ptrdiff_t>(lattice.stride[1]);
      Node                 plane[n * n];
#pragma GCC unroll 4
      for (unsigned int b = 0; b < n; ++b)
      {
#pragma GCC unroll 4
        for (unsigned int a = 0; a < n; ++a)
          plane[b * n + a] = Node::load(node + b * stride_y + a * Fields::stride);
        find_line<1>(plane + b * n);
      }
#pragma GCC unroll 4
      for (unsigned int a = 0; a < n; ++a)
        find_line<n>(plane + a);
#pragma GCC unroll 16
      for (unsigned int i = 0; i < n * n; ++i)
        u[i] = plane[i];
    }

    /** From values to coefficients along one axis. */
    template <unsigned int stride>
    [[gnu::always_inline]] static void find_line(Node *const u)
    {
      Node line[n];
#pragma GCC unroll 4
      for (unsigned int k = 0; k < n; ++k)
        line[k] = u[k * stride];
      Function::to_polynomial(line);
#pragma GCC unroll 4
      for (unsigned int k = 0; k < n; ++k)
        u[k * stride] = line[k];
    }

    template <class Coefficient>
    [[gnu::always_inline]] Gathered<dim, Number> evaluate(const LatticePlaces<dim> &places,
                                                          const Coefficient        &coefficient) const
    {
      Gathered<dim, Number> result;
      Number                t[dim], excess[dim];
      for (unsigned int d = 0; d < dim; ++d)
      {
        t[d] = places.distance[d] - Function::centre;
        if constexpr (Scheme::gathers_B)
          excess[d] = lattice.h[d] * Function::excess(t[d]);
      }
      for (unsigned int c = 0; c < dim; ++c)
      {
        const Value v =
          evaluate<dim>(t, 0, [&](const unsigned int i) { return coefficient(i, Fields::velocity - first_lane + c); });
        result.velocity[c] = v.value;
        for (unsigned int d = 0; d < dim; ++d)
        {
          result.grad_v[c][d] = lattice.inverse_h[d] * v.slope[d];
          if constexpr (Scheme::gathers_B)
            result.B[c][d] = (Function::second_moment * lattice.h[d]) * v.slope[d] + excess[d] * v.last[d];
        }
        if constexpr (Scheme::gathers_increment)
          result.increment[c] = evaluate<dim>(t, 0, [&](const unsigned int i) {
                                  return coefficient(i, Fields::increment - first_lane + c);
                                }).value;
      }
      return result;
    }

    /** The polynomial in the first `n_axes` axes whose coefficients begin with number `begin`, by Horner's rule. */
    template <unsigned int n_axes, class Coefficient>
    [[gnu::always_inline]] static Value evaluate(const Number *t, const unsigned int begin,
                                                 const Coefficient &coefficient)
    {
      Value result;
      if constexpr (n_axes == 0)
        result.value = coefficient(begin);
      else
      {
        constexpr unsigned int d = n_axes - 1, stride = d == 0 ? 1 : (d == 1 ? n : n * n);
        Value                  of[n];
        for (unsigned int k = 0; k < n; ++k)
          of[k] = evaluate<d>(t, begin + k * stride, coefficient);
        result         = of[n - 1];
        result.last[d] = result.slope[d] = of[n - 1].value;
        for (unsigned int k = n - 1; k-- > 0;)
        {
          result.value = result.value * t[d] + of[k].value;
          if (k > 0)
            result.slope[d] = result.slope[d] * t[d] + result.value;
          for (unsigned int e = 0; e < d; ++e)
          {
            result.slope[e] = result.slope[e] * t[d] + of[k].slope[e];
            result.last[e]  = result.last[e] * t[d] + of[k].last[e];
          }
        }
      }
      return result;
    }

    template <class Mask>
    [[gnu::always_inline]] static void merge(const Mask &is_new, const Gathered<dim, Number> &from,
                                             Gathered<dim, Number> &to)
    {
      for (unsigned int c = 0; c < dim; ++c)
      {
        to.velocity[c] = select(is_new, from.velocity[c], to.velocity[c]);
        if constexpr (Scheme::gathers_increment)
          to.increment[c] = select(is_new, from.increment[c], to.increment[c]);
        for (unsigned int d = 0; d < dim; ++d)
        {
          to.grad_v[c][d] = select(is_new, from.grad_v[c][d], to.grad_v[c][d]);
          if constexpr (Scheme::gathers_B)
            to.B[c][d] = select(is_new, from.B[c][d], to.B[c][d]);
        }
      }
    }

    const Lattice<dim> &lattice;
    const Fields       &fields;
    Field               known[n_runs + 1]; // a ring
    unsigned int        last = 0;
  };
} // namespace Talus

#pragma once

#include <talus/core/body_force.h>
#include <talus/grid/grid.h>
#include <talus/kernels/lattice/corner_hats.h>
#include <talus/kernels/kernel.h>
#include <talus/transfer/contribution.h>

namespace Talus
{
  /**
   * Both passes of a scheme for kernels that average hat functions over the corners of particle domains. What a
   * particle adds is affine over its domain, so it is found at the corners, by additions, and spread from each to the
   * nodes of its cell; the way back interpolates at the corners and takes mean and slopes. Nodes that several corners
   * see are visited by each. ListLoops are the reference. Test: tests/transfer.
   */
  template <int dim, class Scheme>
  class DomainLoops
  {
    using Fields = NodalFields<dim>;
    using Number = Simd<native_width>;
    using Vector = dealii::Tensor<1, dim, Number>;
    using Matrix = dealii::Tensor<2, dim, Number>;
    using Hats   = CornerHats<dim>;
    using Node   = Simd<8>;
    // The velocity lies in a node's first four numbers.
    using Gather = Simd<Scheme::gathers_increment ? 8 : 4>;

    static constexpr unsigned int n_corners = Hats::n_corners, n_nodes = Hats::n_nodes;
    static constexpr double       share = 1. / n_corners;

    static_assert(Fields::momentum + dim <= 4 && Fields::velocity + dim <= 4, "the layout of a node");

  public:
    /** Eqs. (11)-(19). */
    static void particle_to_grid(const Scheme &scheme, const TransferArrays<dim> &arrays,
                                 const WorkingSet<dim> &particles, const DomainForm<dim> &kernel,
                                 const BodyForce<dim> &acceleration, const double time, const unsigned int begin,
                                 const unsigned int end, const Grid<dim> &grid, Fields &fields)
    {
      const Corners<dim>          corners(particles, kernel.half_edges);
      const BodyForceOnBatch<dim> body_force(acceleration, arrays, time);
      Hats                        hats;
      Contribution<dim, Scheme>   add;
      Simd<4>                     moment[dim][native_width];
      for_each_batch(begin, end, [&](const auto batch) {
        hats.find(kernel.lattice, corners, batch);
        const Matrix stress = symmetric_matrix<dim>(batch, arrays.stress);
        Matrix       C;
        if constexpr (Scheme::is_affine)
        {
          C = scheme.affine(arrays, batch, Scheme::needs_D ? second_moments(hats, kernel.lattice) : Moment(),
                            grid.largest_spacing);
          set_moments(share * batch.load(arrays.mass), C, kernel.lattice, moment);
        }
        add.set(share * batch.load(arrays.mass), share * batch.load(arrays.volume),
                load_vector<dim>(batch, arrays.velocity), body_force(batch), C * transpose(hats.half_edges),
                stress * hats.dual);
        for (unsigned int l = 0; l < batch.size(); ++l)
          scatter(hats, add, moment, l, fields);
      });
    }

    /** Eqs. (22)-(26), (31); returns the largest displacement along an axis [spacing]. */
    static double grid_to_particle(const Scheme &scheme, const TransferArrays<dim> &arrays,
                                   const WorkingSet<dim> &particles, const DomainForm<dim> &kernel,
                                   const Fields &fields, const double dt, const unsigned int begin,
                                   const unsigned int end)
    {
      const Corners<dim> corners(particles, kernel.half_edges);
      Number             displacement = 0.;
      Hats               hats;
      Sums               sums;
      for_each_batch(begin, end, [&](const auto batch) {
        hats.find(kernel.lattice, corners, batch);
        for (unsigned int l = 0; l < batch.size(); ++l)
          sums.gather(hats, l, fields);
        for (unsigned int l = batch.size(); l < native_width; ++l)
          sums.repeat(batch.size() - 1, l);
        displacement = max(displacement, advance(scheme, arrays, batch, sums.gathered(hats, kernel.lattice), dt,
                                                 kernel.lattice.inverse_h.data()));
      });
      return *std::max_element(displacement.data(), displacement.data() + native_width);
    }

  private:
    using Moment = dealii::SymmetricTensor<2, dim, Number>;

    /** D, Eq. (18): of the corners about the particle, and of the nodes about each corner. */
    static Moment second_moments(const Hats &hats, const Lattice<dim> &lattice)
    {
      Moment D;
      for (unsigned int d = 0; d < dim; ++d)
        for (unsigned int a = 0; a <= d; ++a)
          for (unsigned int e = 0; e < dim; ++e)
            D[d][a] += hats.half_edges[e][d] * hats.half_edges[e][a];
      for (unsigned int d = 0; d < dim; ++d)
        for (unsigned int c = 0; c < n_corners; ++c)
          D[d][d] += hats.fraction[c][d] * (1. - hats.fraction[c][d]) * (share * lattice.h[d] * lattice.h[d]);
      return D;
    }

    /** What the momentum of a node gains over one spacing along each axis. */
    static void set_moments(const Number &m, const Matrix &C, const Lattice<dim> &lattice,
                            Simd<4> (&moment)[dim][native_width])
    {
      for (unsigned int a = 0; a < dim; ++a)
      {
        Number rows[8] = {0., 0., 0., 0., 0., 0., 0., 0.};
        for (unsigned int d = 0; d < dim; ++d)
          rows[Fields::momentum + d] = m * lattice.h[a] * C[d][a];
        Node columns[native_width];
        lanes_to_vectors<native_width>(rows, columns);
        for (unsigned int l = 0; l < native_width; ++l)
          moment[a][l] = columns[l].first_four();
      }
    }

    [[gnu::always_inline]] static void scatter(const Hats &hats, const Contribution<dim, Scheme>             &add,
                                               const Simd<4> (&moment)[dim][native_width], const unsigned int l,
                                               Fields &fields)
    {
      Node at_corner[n_corners];
      at_corner[0] = add.constant[l];
      for (unsigned int e = 0; e < dim; ++e)
        for (unsigned int c = 0; c < 1u << e; ++c)
        {
          at_corner[c + (1u << e)] = at_corner[c] + add.linear[e][l];
          at_corner[c] -= add.linear[e][l];
        }
      for (unsigned int c = 0; c < n_corners; ++c)
      {
        double *const first = fields.at_place(hats.place[c][l]);
        if constexpr (Scheme::is_affine)
        {
          // The momentum hangs on the node's place.
          Simd<4> value[n_nodes];
          value[0] = at_corner[c].first_four();
          for (unsigned int d = 0; d < dim; ++d)
            value[0] -= hats.fraction[c][d].data()[l] * moment[d][l];
          for (unsigned int d = 0; d < dim; ++d)
            for (unsigned int i = 0; i < 1u << d; ++i)
              value[i + (1u << d)] = value[i] + moment[d][l];
          for (unsigned int i = 0; i < n_nodes; ++i)
            add_to(first + std::size_t(Fields::stride) * hats.step[i],
                   hats.hat[c][i].data()[l] * at_corner[c].with_first_four(value[i]));
        }
        else
          for (unsigned int i = 0; i < n_nodes; ++i)
            add_to(first + std::size_t(Fields::stride) * hats.step[i], hats.hat[c][i].data()[l] * at_corner[c]);
      }
    }

    [[gnu::always_inline]] static void add_to(double *node, const Node &value)
    {
      (Node::load(node) + value).store(node);
    }

    /** What the particles of a batch gather: sums over the corners of a node's numbers there. */
    struct Sums
    {
      Gather value[native_width], slope[dim][native_width]; // the latter with the signs along a half edge
      Gather moment[dim][native_width]; // sums over a cell's nodes times their offsets from the corner

      [[gnu::always_inline]] void gather(const Hats &hats, const unsigned int l, const Fields &fields)
      {
        Gather at_corner[n_corners], of_cells[dim];
        for (Gather &sum : of_cells)
          sum = 0.;
        for (unsigned int c = 0; c < n_corners; ++c)
        {
          const double *const first = fields.at_place(hats.place[c][l]);
          Gather              at[n_nodes];
          for (unsigned int i = 0; i < n_nodes; ++i)
            at[i] = Gather::load(first + std::size_t(Fields::stride) * hats.step[i]);
          at_corner[c] = interpolate(hats, c, l, at, of_cells);
        }
        for (unsigned int e = dim; e-- > 0;)
        {
          Gather sum = 0.;
          for (unsigned int c = 0; c < 1u << e; ++c)
          {
            sum += at_corner[c + (1u << e)] - at_corner[c];
            at_corner[c] += at_corner[c + (1u << e)];
          }
          slope[e][l]  = sum;
          moment[e][l] = of_cells[e];
        }
        value[l] = at_corner[0];
      }

      /** One axis after the other; `moment` along an axis needs the differences along it. */
      [[gnu::always_inline]] static Gather interpolate(const Hats &hats, const unsigned int c, const unsigned int l,
                                                       Gather (&at)[n_nodes], Gather (&moment)[dim])
      {
        Gather difference[dim][n_nodes];
        for (unsigned int d = 0; d < dim; ++d)
        {
          const double f = hats.fraction[c][d].data()[l];
          for (unsigned int i = 0; i < n_nodes >> (d + 1); ++i)
          {
            difference[d][i] = at[2 * i + 1] - at[2 * i];
            at[i]            = at[2 * i] + f * difference[d][i];
            if constexpr (Scheme::gathers_B)
              for (unsigned int a = 0; a < d; ++a)
                difference[a][i] = difference[a][2 * i] + f * (difference[a][2 * i + 1] - difference[a][2 * i]);
          }
        }
        if constexpr (Scheme::gathers_B)
          for (unsigned int d = 0; d < dim; ++d)
          {
            const double f = hats.fraction[c][d].data()[l];
            moment[d] += (f * (1 - f)) * difference[d][0];
          }
        return at[0];
      }

      void repeat(const unsigned int from, const unsigned int to)
      {
        value[to] = value[from];
        for (unsigned int d = 0; d < dim; ++d)
        {
          slope[d][to]  = slope[d][from];
          moment[d][to] = moment[d][from];
        }
      }

      Gathered<dim, Number> gathered(const Hats &hats, const Lattice<dim> &lattice) const
      {
        Gathered<dim, Number> sum;
        Number                rows[Gather::n_lanes];
        vectors_to_lanes<native_width>(value, rows);
        for (unsigned int d = 0; d < dim; ++d)
        {
          sum.velocity[d] = share * rows[Fields::velocity + d];
          if constexpr (Scheme::gathers_increment)
            sum.increment[d] = share * rows[Fields::increment + d];
        }
        for (unsigned int e = 0; e < dim; ++e)
        {
          vectors_to_lanes<native_width>(slope[e], rows);
          for (unsigned int d = 0; d < dim; ++d)
            for (unsigned int a = 0; a < dim; ++a)
            {
              sum.grad_v[d][a] += share * rows[Fields::velocity + d] * hats.dual[a][e];
              if constexpr (Scheme::gathers_B)
                sum.B[d][a] += share * rows[Fields::velocity + d] * hats.half_edges[e][a];
            }
        }
        if constexpr (Scheme::gathers_B)
          for (unsigned int a = 0; a < dim; ++a)
          {
            vectors_to_lanes<native_width>(moment[a], rows);
            for (unsigned int d = 0; d < dim; ++d)
              sum.B[d][a] += share * lattice.h[a] * rows[Fields::velocity + d];
          }
        return sum;
      }
    };
  };
} // namespace Talus

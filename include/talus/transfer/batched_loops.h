#pragma once

#include <talus/core/function.h>
#include <talus/core/transpose.h>
#include <talus/grid/grid.h>
#include <talus/kernels/lattice_batch.h>
#include <talus/transfer/scheme.h>

namespace Talus
{
  /**
   * Both passes of a scheme for kernels that are products over the axes, a batch of
   * particles at a time. What depends on the particle alone is computed with one
   * particle in each lane; for its nodes, the lanes are the eight numbers of a node
   * (see NodalFields), and the registers are transposed in between. Missing nodes
   * occur at the domain's faces only, where stencils are lists.
   */
  template <int dim, class Scheme, class Function>
  class BatchedLoops
  {
  public:
    static void particle_to_grid(const Scheme &scheme, const Function &function, const TransferArrays<dim> &arrays,
                                 const unsigned int n_particles, const Kernel<dim> &kernel,
                                 const ParsedVector<dim> &acceleration, const double time, Grid<dim> &grid)
    {
      const Lattice<dim>  &lattice   = *kernel.lattice;
      Fields              &fields    = grid.fields;
      const auto           uniform_b = acceleration.value({}, time);
      LatticeBatch<dim, n> stencil;
      for_each_batch(0, n_particles, [&](const auto batch) {
        const auto x = load_vector<dim>(batch, arrays.position);
        evaluate_batch(function, lattice, *kernel.treatment, x, stencil);
        VectorNumber b;
        for (unsigned int d = 0; d < dim; ++d)
          b[d] = uniform_b[d];
        if (acceleration.depends_on_space())
          b = body_force(acceleration, x, time);

        Vectors add;
        contribution(scheme, arrays, batch, stencil, b, lattice, add);
        const Factors factors(stencil);
        if (!stencil.is_product)
          for (unsigned int l = 0; l < batch.size(); ++l)
            scatter_list(add, lattice, stencil, l, fields);
        else
          for (unsigned int l = 0; l < batch.size();)
            l = scatter_run(add, factors, lattice, stencil, l, batch.size(), fields);
      });
    }

    static double grid_to_particle(const Scheme &scheme, const Function &function, const TransferArrays<dim> &arrays,
                                   const Kernel<dim> &kernel, const Grid<dim> &grid, const double dt,
                                   const unsigned int begin, const unsigned int end)
    {
      const Lattice<dim>  &lattice      = *kernel.lattice;
      const Fields        &fields       = grid.fields;
      Number               displacement = 0.;
      LatticeBatch<dim, n> stencil;
      for_each_batch(begin, end, [&](const auto batch) {
        prefetch_gather(arrays, batch.p);
        const auto x = load_vector<dim>(batch, arrays.position);
        evaluate_batch(function, lattice, *kernel.treatment, x, stencil);
        const Factors factors(stencil);
        Sums          sums;
        for (unsigned int l = 0; l < batch.size(); ++l)
          if (stencil.is_product)
            gather_product(factors, lattice, stencil, l, fields, sums);
          else
            gather_list(lattice, stencil, l, fields, sums);
        for (unsigned int l = batch.size(); l < width; ++l)
          sums.repeat(l - 1, l);

        const Gathered<dim, Number> sum = sums.gathered();
        store_vector<dim>(batch, arrays.position, x + dt * sum.velocity); // Eq. (31), for FLIP as well
        store_matrix<dim>(batch, arrays.grad_v, sum.grad_v);
        scheme.update(arrays, batch, sum);
        for (unsigned int d = 0; d < dim; ++d)
          displacement = max(displacement, abs(sum.velocity[d]) * (dt * lattice.inverse_h[d]));
      });
      return *std::max_element(displacement.data(), displacement.data() + width);
    }

  private:
    static constexpr unsigned int n         = Function::n;
    static constexpr unsigned int width     = native_width;
    static constexpr bool         is_affine = Scheme::is_affine;

    using Fields       = NodalFields<dim>;
    using Number       = Simd<native_width>;
    using VectorNumber = dealii::Tensor<1, dim, Number>;
    using Node         = Simd<8>; // all numbers of a node
    using Motion       = Simd<4>; // the four from the velocity on

    static_assert(Fields::stride == 8 && Fields::velocity == 1 && Fields::increment == 1 + dim, "the layout of a node");

    /** What each particle adds to its nodes: phi constant + (phi offset or grad phi, by lane) . linear. */
    struct Vectors
    {
      Node constant[width], linear[dim][width];
    };

    /** Products of the axes' factors that both passes need. */
    struct Factors
    {
      explicit Factors(const LatticeBatch<dim, n> &stencil)
      {
        if constexpr (is_affine || Scheme::gathers_B)
          for (unsigned int d = 0; d < dim; ++d)
            for (unsigned int k = 0; k < n; ++k)
              moment[d][k] = stencil.weight[d][k] * stencil.offset[d][k];
      }
      Number moment[dim][n];
    };

    template <class Columns>
    [[gnu::always_inline]] static void prefetch(const Columns &columns, const unsigned int p)
    {
      for (const double *column : columns)
        __builtin_prefetch(column + p, 1);
    }

    /**
     * What the gather reads and writes a few batches later, and what the update of the stress after it will read.
     * Columns are many and taken in blocks, so that the processor does not foresee them. Beyond their ends nothing
     * happens. The scatter gains nothing by it.
     */
    [[gnu::always_inline]] static void prefetch_gather(const TransferArrays<dim> &arrays, const unsigned int p)
    {
      constexpr unsigned int ahead = 64;
      prefetch(arrays.position, p + ahead);
      prefetch(arrays.velocity, p + ahead);
      prefetch(arrays.grad_v, p + ahead);
      if constexpr (Scheme::gathers_B)
        prefetch(arrays.B, p + ahead);
      prefetch(arrays.F, p);
      prefetch(arrays.stress, p);
      prefetch(std::array<double *, 2>{{arrays.mass, arrays.volume}}, p);
    }

    static typename Node::Mask is_force()
    {
      double lane[8];
      for (unsigned int i = 0; i < 8; ++i)
        lane[i] = i;
      return Node::load(lane) >= Node(Fields::force);
    }

    /** The force lanes of a node take the gradient, those of the momentum the offset. */
    static Node blend(const double moment, const double gradient)
    {
      return is_affine ? select(is_force(), Node(gradient), Node(moment)) : Node(gradient);
    }

    static VectorNumber body_force(const ParsedVector<dim> &acceleration, const VectorNumber &x, const double time)
    {
      VectorNumber b;
      for (unsigned int l = 0; l < width; ++l)
      {
        dealii::Point<dim> x_p;
        for (unsigned int d = 0; d < dim; ++d)
          x_p[d] = x[d][l];
        const auto b_p = acceleration.value(x_p, time);
        for (unsigned int d = 0; d < dim; ++d)
          b[d].set(l, b_p[d]);
      }
      return b;
    }

    template <class Batch>
    [[gnu::always_inline]] static void contribution(const Scheme &scheme, const TransferArrays<dim> &arrays,
                                                    const Batch &batch, const LatticeBatch<dim, n> &stencil,
                                                    const VectorNumber &b, const Lattice<dim> &lattice, Vectors &add)
    {
      const Number m = batch.load(arrays.mass), V = batch.load(arrays.volume);
      Number       rows[8] = {0., 0., 0., 0., 0., 0., 0., 0.};
      rows[Fields::mass]   = m; // Eq. (13)
      for (unsigned int d = 0; d < dim; ++d)
      {
        rows[Fields::momentum + d] = m * batch.load(arrays.velocity[d]); // Eq. (15)
        rows[Fields::force + d]    = m * b[d];                           // Eq. (12)
      }
      lanes_to_vectors<width>(rows, add.constant);

      dealii::Tensor<2, dim, Number> C;
      if constexpr (is_affine)
      {
        if (stencil.is_product)
          C = scheme.affine(arrays, batch, diagonal_second_moment(stencil, lattice.h), lattice.largest_spacing());
        else
          C = scheme.affine(arrays, batch, second_moment(stencil), lattice.largest_spacing());
      }
      if (is_affine && !stencil.is_product && scheme.projects_slip)
        C = without_wall_shear(C, stencil.is_at_slip_wall);
      for (unsigned int e = 0; e < dim; ++e)
      {
        rows[Fields::mass] = 0.;
        for (unsigned int d = 0; d < dim; ++d)
        {
          rows[Fields::momentum + d] = m * C[d][e]; // Eqs. (17), (19)
          // Eq. (11); xy, xz, yz follow the three diagonal components.
          rows[Fields::force + d] = -V * batch.load(arrays.stress[d == e ? d : 2 + d + e]);
        }
        lanes_to_vectors<width>(rows, add.linear[e]);
      }
    }

    /** D, Eq. (18), of a stencil that is a list, if the scheme needs it. */
    static dealii::SymmetricTensor<2, dim, Number> second_moment(const LatticeBatch<dim, n> &stencil)
    {
      dealii::SymmetricTensor<2, dim, Number> D;
      if constexpr (Scheme::needs_D)
        for (unsigned int i = 0; i < stencil.n_nodes; ++i)
        {
          const unsigned int k[3] = {i % n, i / n % n, i / (n * n)};
          for (unsigned int d = 0; d < dim; ++d)
            for (unsigned int e = 0; e <= d; ++e)
              D[d][e] += stencil.value[i] * stencil.offset[d][k[d]] * stencil.offset[e][k[e]];
        }
      return D;
    }

    /** The diagonal of D of a product of factors: they reproduce linear functions, so that all else is zero. */
    [[gnu::always_inline]] static VectorNumber diagonal_second_moment(const LatticeBatch<dim, n>    &stencil,
                                                                      const std::array<double, dim> &h)
    {
      VectorNumber D;
      if constexpr (Scheme::needs_D)
        for (unsigned int d = 0; d < dim; ++d)
        {
          if constexpr (Function::second_moment > 0)
            D[d] = Function::second_moment * h[d] * h[d];
          else
            for (unsigned int k = 0; k < n; ++k)
              D[d] += stencil.weight[d][k] * stencil.offset[d][k] * stencil.offset[d][k];
        }
      return D;
    }

    [[gnu::always_inline]] static void add_to(double *node, const Node &value)
    {
      (Node::load(node) + value).store(node);
    }

    /** Eqs. (13)-(19) of particle l: calls `add(a, b, c, value)` for what it adds to each of its nodes. */
    template <class Add>
    [[gnu::always_inline]] static void scatter_product(const Vectors &vectors, const Factors &factors,
                                                       const LatticeBatch<dim, n> &stencil, const unsigned int l,
                                                       const Add &add)
    {
      const auto slope = [&](const unsigned int d, const unsigned int k) {
        return blend(is_affine ? factors.moment[d][k].data()[l] : 0., stencil.derivative[d][k].data()[l]);
      };
      // All is read before anything is stored, so that nothing is read twice.
      Node weight[dim][n], row[n], across[n]; // sums along x; what comes from y
      for (unsigned int d = 0; d < dim; ++d)
        for (unsigned int k = 0; k < n; ++k)
          weight[d][k] = stencil.weight[d][k].data()[l];
      for (unsigned int k = 0; k < n; ++k)
      {
        row[k]    = weight[0][k] * vectors.constant[l] + slope(0, k) * vectors.linear[0][l];
        across[k] = slope(1, k) * vectors.linear[1][l];
      }
      if constexpr (dim == 2)
        for (unsigned int b = 0; b < n; ++b)
          for (unsigned int a = 0; a < n; ++a)
            add(a, b, 0, weight[1][b] * row[a], weight[0][a] * across[b]);
      else
      {
        Node along[n]; // from z
        for (unsigned int k = 0; k < n; ++k)
          along[k] = slope(dim - 1, k) * vectors.linear[dim - 1][l];
        for (unsigned int b = 0; b < n; ++b)
          for (unsigned int a = 0; a < n; ++a)
          {
            const Node plane = weight[1][b] * row[a] + weight[0][a] * across[b];
            const Node both  = weight[0][a] * weight[1][b];
            for (unsigned int c = 0; c < n; ++c)
              add(a, b, c, weight[dim - 1][c] * plane, both * along[c]);
          }
      }
    }

    /**
     * Particle l, and those after it with the same nodes; returns the next one. Where the nodes fit into the
     * registers, what a run of particles adds is summed there.
     */
    [[gnu::always_inline]] static unsigned int scatter_run(const Vectors &vectors, const Factors &factors,
                                                           const Lattice<dim>         &lattice,
                                                           const LatticeBatch<dim, n> &stencil, unsigned int l,
                                                           const unsigned int size, Fields &fields)
    {
      const int            place    = stencil.first_node[l];
      const std::ptrdiff_t stride_y = Fields::stride * lattice.stride[1];
      double *const        first    = fields.at_place(place);
      if constexpr (dim == 2)
      {
        // From zero, so that no run waits for what the one before it has stored.
        Node sum[n][n];
        for (unsigned int b = 0; b < n; ++b)
          for (unsigned int a = 0; a < n; ++a)
            sum[b][a] = 0.;
        do
        {
          scatter_product(vectors, factors, stencil, l,
                          [&](const unsigned int a, const unsigned int b, unsigned int, const Node &x, const Node &y) {
                            sum[b][a] += x;
                            sum[b][a] += y;
                          });
          ++l;
        } while (l < size && stencil.first_node[l] == place);
        for (unsigned int b = 0; b < n; ++b)
          for (unsigned int a = 0; a < n; ++a)
            add_to(first + b * stride_y + a * Fields::stride, sum[b][a]);
      }
      else
      {
        const std::ptrdiff_t stride_z = Fields::stride * lattice.stride[dim - 1];
        scatter_product(
          vectors, factors, stencil, l,
          [&](const unsigned int a, const unsigned int b, const unsigned int c, const Node &x, const Node &y) {
            add_to(first + b * stride_y + a * Fields::stride + c * stride_z, x + y);
          });
        ++l;
      }
      return l;
    }

    /**
     * Calls `body(i, k, place, beyond)` for the existing nodes of a stencil that is a list; k is where along each axis.
     * The node at the place stands for its mirror image in the faces `beyond`, if there are any.
     */
    template <class Body>
    [[gnu::always_inline]] static void for_each_node(const Lattice<dim> &lattice, const LatticeBatch<dim, n> &stencil,
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

    static void scatter_list(const Vectors &add, const Lattice<dim> &lattice, const LatticeBatch<dim, n> &stencil,
                             const unsigned int l, Fields &fields)
    {
      for_each_node(lattice, stencil, l, [&](const unsigned int i, const auto *k, const auto place, const auto beyond) {
        const double phi   = stencil.value[i].data()[l];
        Node         value = phi * add.constant[l];
        for (unsigned int d = 0; d < dim; ++d)
          value += blend(phi * stencil.offset[d][k[d]].data()[l], stencil.gradient[d][i].data()[l]) * add.linear[d][l];
        if (beyond != 0)
        {
          fields.count_mirrored(value.data(), beyond);
          value *= Node::load(Fields::mirror(beyond));
        }
        add_to(fields.at_place(place), value);
      });
    }

    /** What each particle of a batch gathers. */
    struct Sums
    {
      static constexpr bool has_own_increment = Scheme::gathers_increment && dim == 3; // in 2D it fits into `value`

      Motion value[width], gradient[dim][width], moment[dim][width], increment[width];

      void repeat(const unsigned int from, const unsigned int to)
      {
        value[to] = value[from];
        for (unsigned int d = 0; d < dim; ++d)
        {
          gradient[d][to] = gradient[d][from];
          if constexpr (Scheme::gathers_B)
            moment[d][to] = moment[d][from];
        }
        if constexpr (has_own_increment)
          increment[to] = increment[from];
      }

      [[gnu::always_inline]] Gathered<dim, Number> gathered() const
      {
        Gathered<dim, Number> sum;
        Number                rows[4];
        vectors_to_lanes<width>(value, rows);
        for (unsigned int d = 0; d < dim; ++d)
        {
          sum.velocity[d] = rows[d];
          if constexpr (Scheme::gathers_increment && dim == 2)
            sum.increment[d] = rows[dim + d];
        }
        for (unsigned int e = 0; e < dim; ++e)
        {
          vectors_to_lanes<width>(gradient[e], rows);
          for (unsigned int d = 0; d < dim; ++d)
            sum.grad_v[d][e] = rows[d];
          if constexpr (Scheme::gathers_B)
          {
            vectors_to_lanes<width>(moment[e], rows);
            for (unsigned int d = 0; d < dim; ++d)
              sum.B[d][e] = rows[d];
          }
        }
        if constexpr (has_own_increment)
        {
          vectors_to_lanes<width>(increment, rows);
          for (unsigned int d = 0; d < dim; ++d)
            sum.increment[d] = rows[d];
        }
        return sum;
      }
    };

    [[gnu::always_inline]] static void gather_product(const Factors &factors, const Lattice<dim> &lattice,
                                                      const LatticeBatch<dim, n> &stencil, const unsigned int l,
                                                      const Fields &fields, Sums &sums)
    {
      const auto weight = [&](const unsigned int d, const unsigned int k) {
        return Motion(stencil.weight[d][k].data()[l]);
      };
      const auto slope = [&](const unsigned int d, const unsigned int k) {
        return Motion(stencil.derivative[d][k].data()[l]);
      };
      const auto lever = [&](const unsigned int d, const unsigned int k) {
        return Motion(factors.moment[d][k].data()[l]);
      };
      constexpr bool       gathers_B = Scheme::gathers_B;
      const std::ptrdiff_t stride_y  = Fields::stride * lattice.stride[1],
                           stride_z  = Fields::stride * lattice.stride[dim - 1];
      const double *const first      = fields.at_place(stencil.first_node[l]);

      Motion value = 0., gradient[3] = {0., 0., 0.}, moment[3] = {0., 0., 0.}, increment = 0.;
      for (unsigned int c = 0; c < (dim == 3 ? n : 1); ++c)
      {
        // Sums over a plane; in 2D there is one.
        Motion plane = 0., plane_gradient[2] = {0., 0.}, plane_moment[2] = {0., 0.}, plane_increment = 0.;
        for (unsigned int b = 0; b < n; ++b)
        {
          Motion              row = 0., row_gradient = 0., row_moment = 0., row_increment = 0.;
          const double *const node = first + b * stride_y + (dim == 3 ? c * stride_z : 0);
          for (unsigned int a = 0; a < n; ++a)
          {
            const double *values = node + a * Fields::stride;
            const Motion  v      = Motion::load(values + Fields::velocity);
            row += weight(0, a) * v;
            row_gradient += slope(0, a) * v;
            if constexpr (gathers_B)
              row_moment += lever(0, a) * v;
            if constexpr (Sums::has_own_increment)
              row_increment += weight(0, a) * Motion::load(values + Fields::increment);
          }
          plane += weight(1, b) * row;
          plane_gradient[0] += weight(1, b) * row_gradient;
          plane_gradient[1] += slope(1, b) * row;
          if constexpr (gathers_B)
          {
            plane_moment[0] += weight(1, b) * row_moment;
            plane_moment[1] += lever(1, b) * row;
          }
          if constexpr (Sums::has_own_increment)
            plane_increment += weight(1, b) * row_increment;
        }
        if constexpr (dim == 2)
        {
          value = plane;
          for (unsigned int d = 0; d < dim; ++d)
          {
            gradient[d] = plane_gradient[d];
            moment[d]   = plane_moment[d];
          }
        }
        else
        {
          value += weight(dim - 1, c) * plane;
          gradient[0] += weight(dim - 1, c) * plane_gradient[0];
          gradient[1] += weight(dim - 1, c) * plane_gradient[1];
          gradient[2] += slope(dim - 1, c) * plane;
          if constexpr (gathers_B)
          {
            moment[0] += weight(dim - 1, c) * plane_moment[0];
            moment[1] += weight(dim - 1, c) * plane_moment[1];
            moment[2] += lever(dim - 1, c) * plane;
          }
          if constexpr (Sums::has_own_increment)
            increment += weight(dim - 1, c) * plane_increment;
        }
      }
      sums.value[l] = value;
      for (unsigned int d = 0; d < dim; ++d)
      {
        sums.gradient[d][l] = gradient[d];
        if constexpr (gathers_B)
          sums.moment[d][l] = moment[d];
      }
      if constexpr (Sums::has_own_increment)
        sums.increment[l] = increment;
    }

    static void gather_list(const Lattice<dim> &lattice, const LatticeBatch<dim, n> &stencil, const unsigned int l,
                            const Fields &fields, Sums &sums)
    {
      Motion value = 0., gradient[3] = {0., 0., 0.}, moment[3] = {0., 0., 0.}, increment = 0.;
      for_each_node(lattice, stencil, l, [&](const unsigned int i, const auto *k, const auto place, const auto beyond) {
        const double *values = fields.at_place(place), *sign = Fields::mirror(beyond);
        Motion        v   = Motion::load(values + Fields::velocity);
        const double  phi = stencil.value[i].data()[l];
        if (beyond != 0)
          v *= Motion::load(sign + Fields::velocity);
        value += phi * v;
        for (unsigned int d = 0; d < dim; ++d)
        {
          gradient[d] += stencil.gradient[d][i].data()[l] * v;
          if constexpr (Scheme::gathers_B)
            moment[d] += (phi * stencil.offset[d][k[d]].data()[l]) * v;
        }
        if constexpr (Sums::has_own_increment)
          increment += phi * Motion::load(sign + Fields::increment) * Motion::load(values + Fields::increment);
      });
      sums.value[l] = value;
      for (unsigned int d = 0; d < dim; ++d)
      {
        sums.gradient[d][l] = gradient[d];
        if constexpr (Scheme::gathers_B)
          sums.moment[d][l] = moment[d];
      }
      if constexpr (Sums::has_own_increment)
        sums.increment[l] = increment;
    }
  };
} // namespace Talus

#include <talus/core/registry.h>
#include <talus/core/transpose.h>
#include <talus/grid/box_grid.h>
#include <talus/kernels/kernel.h>
#include <talus/particles/corners.h>

#include <algorithm>

namespace Talus
{
  namespace
  {
    /**
     * Convected particle domain interpolation, Sadeghirad, Brannon & Burghardt (2011): the hat functions N_i of the
     * grid are interpolated over a particle's domain from its 2^dim corners x_c, and averaged over it,
     * @f[ \phi_{ip} = 2^{-d} \sum_c N_i(x_c) , \qquad
     *     \nabla\phi_{ip} = 2^{-d} \sum_c N_i(x_c) \sum_e s_{ce} r^e . @f]
     * The domain is a parallelogram or parallelepiped with the half edges r_e = F r0_e, dual vectors r^e (r^e . r_f =
     * delta_ef) and signs s_ce = +-1; in 2D the gradient is the known one with 1 / V_p in front. Partition of unity,
     * sum phi x_i = x_p and sum x_i (x) grad phi = I hold for any half edges. Test: tests/kernels/cpdi.cc.
     */
    template <int dim>
    class Cpdi : public Kernel<dim>
    {
    public:
      explicit Cpdi(const std::string &section) : Kernel<dim>(section)
      {
        this->add_parameter("Layers", n_layers,
                            "Layers of cells beyond its own that a rank knows; a particle's domain may reach so far "
                            "into the cells of other ranks [1].",
                            this->prm, dealii::Patterns::Integer(1, 16));
      }

      void  add_fields(WorkingSet<dim> &particles) override { half_edges = Corners<dim>::add_field(particles); }
      void  attach(const Grid<dim> &grid) override { lattice = &box_grid(grid, "/Kernel", "Type").lattice; }
      Reach reach() const override { return {2, 0., /* at_corners = */ true, n_layers}; }

      void evaluate(const WorkingSet<dim> &particles, const unsigned int begin, const unsigned int end,
                    Stencil<dim> *stencils) const override
      {
        const Corners<dim> corners(particles, half_edges);
        Batch              found;
        for_each_batch(begin, end, [&](const auto batch) {
          find(corners.position(batch), corners.half_edges(batch), found);
          for (unsigned int l = 0; l < batch.size(); ++l)
            merge(found, l, stencils[batch.p - begin + l]);
        });
      }

    private:
      using Number = Simd<native_width>;
      using Four   = Simd<4>; // phi and its gradient

      static constexpr unsigned int n_corners  = Corners<dim>::n;
      static constexpr unsigned int n_hats     = 1u << dim; // that are not zero at a corner
      static constexpr int          max_extent = 5;         // of the nodes that are merged, per axis
      static constexpr unsigned int max_merged = dim == 2 ? 25 : 125;

      /** The corners of the domains of a batch. */
      struct Batch
      {
        Number  x[dim];                            // lattice coordinates of the particle
        Number  lowest[dim], extent[dim];          // the nodes of all corners: first index and number
        Number  hat[n_corners][n_hats];            // at each corner those of its cell
        Simd<8> share[n_corners / 2][native_width]; // of a particle, two corners: 2^-d (1, sum_e s_ce r^e, 0)
        alignas(64) int first[n_corners][dim][native_width]; // lattice index of the cell's lower node
      };

      void find(const dealii::Tensor<1, dim, Number> &x, const dealii::Tensor<2, dim, Number> &r, Batch &found) const
      {
        // Rows of r are half edges, so columns of its inverse the dual vectors.
        const auto dual = invert(r);
        for (unsigned int d = 0; d < dim; ++d)
        {
          found.x[d]      = (x[d] - lattice->origin[d]) * lattice->inverse_h[d];
          found.lowest[d] = 1e300;
          found.extent[d] = -1e300;
        }
        Number rows[8];
        for (unsigned int c = 0; c < n_corners; ++c)
        {
          const auto coordinate = Corners<dim>::coordinates(*lattice, x + Corners<dim>::arm(r, c));
          Number     weight[dim][2];
          Number    *share = rows + (c % 2) * 4;
          share[0]         = 1. / n_corners;
          share[3]         = 0.;
          for (unsigned int d = 0; d < dim; ++d)
          {
            const Number first = floor(coordinate[d]);
            store_integers(first, found.first[c][d]);
            weight[d][1]    = coordinate[d] - first;
            weight[d][0]    = 1. - weight[d][1];
            found.lowest[d] = min(found.lowest[d], first);
            found.extent[d] = max(found.extent[d], first);
            share[1 + d]    = 0.;
            for (unsigned int e = 0; e < dim; ++e)
              share[1 + d] += (c >> e & 1 ? 1. / n_corners : -1. / n_corners) * dual[d][e];
          }
          for (unsigned int i = 0; i < n_hats; ++i)
          {
            found.hat[c][i] = weight[0][i & 1];
            for (unsigned int d = 1; d < dim; ++d)
              found.hat[c][i] *= weight[d][i >> d & 1];
          }
          if (c % 2 == 1)
            lanes_to_vectors<native_width>(rows, found.share[c / 2]);
        }
        for (unsigned int d = 0; d < dim; ++d)
          found.extent[d] += 2. - found.lowest[d];
      }

      /** Lists the nodes of one particle; those of several corners once, if the domain is no larger than a few cells. */
      void merge(const Batch &found, const unsigned int l, Stencil<dim> &stencil) const
      {
        std::array<int, dim> lowest, extent;
        bool                 is_small = true;
        for (unsigned int d = 0; d < dim; ++d)
        {
          lowest[d] = static_cast<int>(found.lowest[d].data()[l]);
          extent[d] = static_cast<int>(found.extent[d].data()[l]);
          is_small  = is_small && extent[d] <= max_extent;
        }
        stencil.reserve(is_small ? max_merged : n_corners * n_hats);
        stencil.is_at_slip_wall.fill(false);
        Four sums[max_merged];
        if (is_small)
        {
          std::array<int, dim> stride;
          int                  size = 1;
          for (unsigned int d = 0; d < dim; ++d)
          {
            stride[d] = size;
            size *= extent[d];
          }
          for (int i = 0; i < size; ++i)
            sums[i] = 0.;
          for (unsigned int c = 0; c < n_corners; ++c)
          {
            int place = 0;
            for (unsigned int d = 0; d < dim; ++d)
              place += (found.first[c][d][l] - lowest[d]) * stride[d];
            add_hats(found, c, l, stride, sums + place);
          }
          list(found, l, lowest, extent, sums, stencil);
          return;
        }
        const auto cell = std::array<int, 3>{{2, 2, dim == 3 ? 2 : 1}};
        for (unsigned int c = 0; c < n_corners; ++c)
        {
          std::array<int, dim> first, stride, extents;
          for (unsigned int d = 0; d < dim; ++d)
          {
            first[d]   = found.first[c][d][l];
            stride[d]  = 1 << d;
            extents[d] = cell[d];
          }
          for (unsigned int i = 0; i < n_hats; ++i)
            sums[i] = 0.;
          add_hats(found, c, l, stride, sums);
          list(found, l, first, extents, sums, stencil);
        }
      }

      /** Adds what corner c gives to the nodes of its cell, the first of which is at `sums`. */
      [[gnu::always_inline]] static void add_hats(const Batch &found, const unsigned int c, const unsigned int l,
                                                  const std::array<int, dim> &stride, Four *sums)
      {
        const Four share = Four::load(found.share[c / 2][l].data() + c % 2 * 4);
        for (unsigned int i = 0; i < n_hats; ++i)
        {
          int place = 0;
          for (unsigned int d = 0; d < dim; ++d)
            place += (i >> d & 1) * stride[d];
          sums[place] += found.hat[c][i].data()[l] * share;
        }
      }

      /** Appends a box of nodes to the list, x running fastest. */
      [[gnu::always_inline]] void list(const Batch &found, const unsigned int l, const std::array<int, dim> &lowest,
                                       const std::array<int, dim> &extent, const Four *sums,
                                       Stencil<dim> &stencil) const
      {
        double offset[dim];
        for (unsigned int d = 0; d < dim; ++d)
          offset[d] = lowest[d] - found.x[d].data()[l];
        const int place = lattice->table_index(lowest);
        for (int c = 0; c < (dim == 3 ? extent[dim - 1] : 1); ++c)
          for (int b = 0; b < extent[1]; ++b)
            for (int a = 0; a < extent[0]; ++a)
            {
              const double *numbers = (sums++)->data();
              // Nodes of the box that no corner sees, among them those beyond the domain.
              if (numbers[0] == 0 && numbers[1] == 0 && numbers[2] == 0 && numbers[3] == 0)
                continue;
              const unsigned int k = stencil.size++;
              const int          index[3] = {a, b, c};
              stencil.place[k]  = place + a + b * lattice->stride[1] + (dim == 3 ? c * lattice->stride[dim - 1] : 0);
              stencil.weight[k] = numbers[0];
              for (unsigned int d = 0; d < dim; ++d)
              {
                stencil.offset[d][k]   = (offset[d] + index[d]) * lattice->h[d];
                stencil.gradient[d][k] = numbers[1 + d];
              }
            }
      }

      static dealii::Tensor<2, dim, Number> invert(const dealii::Tensor<2, dim, Number> &r)
      {
        dealii::Tensor<2, dim, Number> inverse;
        const Number                   factor = 1. / determinant(r);
        if constexpr (dim == 2)
        {
          inverse[0][0] = factor * r[1][1];
          inverse[1][1] = factor * r[0][0];
          inverse[0][1] = -factor * r[0][1];
          inverse[1][0] = -factor * r[1][0];
        }
        else
          for (unsigned int i = 0; i < 3; ++i)
            for (unsigned int j = 0; j < 3; ++j)
            {
              const unsigned int a = (j + 1) % 3, b = (j + 2) % 3, c = (i + 1) % 3, d = (i + 2) % 3;
              inverse[i][j] = factor * (r[a][c] * r[b][d] - r[a][d] * r[b][c]);
            }
        return inverse;
      }

      const Lattice<dim> *lattice    = nullptr;
      unsigned int        half_edges = 0, n_layers = 2;
    };

    const RegisterDimensions<Kernel, Cpdi> registration(
      "CPDI", "convected particle domain interpolation: hats averaged over deformed particle domains");
  } // namespace
} // namespace Talus

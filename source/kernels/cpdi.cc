#include <talus/core/registry.h>
#include <talus/grid/grid.h>
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
      void  attach(const Grid<dim> &grid) override { lattice = &grid.lattice; }
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
      static constexpr unsigned int n_hats     = 1u << dim;                // that are not zero at a corner
      static constexpr int          max_extent = 5;                        // of the nodes that are merged, per axis
      static constexpr unsigned int max_merged = dim == 2 ? 25 : 125;

      /** The corners of the domains of a batch. */
      struct Batch
      {
        Number x[dim];                       // lattice coordinates of the particle
        Number first[n_corners][dim];        // lattice index of the cell's lower node
        Number distance[n_corners][dim];     // from it [h]
        Number gradient[n_corners][dim];     // 2^-d sum_e s_ce r^e [1/length]
        Number lowest[dim], extent[dim];     // the nodes of all corners: first index and number
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
        for (unsigned int c = 0; c < n_corners; ++c)
        {
          const auto coordinate = Corners<dim>::coordinates(*lattice, x + Corners<dim>::arm(r, c));
          for (unsigned int d = 0; d < dim; ++d)
          {
            found.first[c][d]    = floor(coordinate[d]);
            found.distance[c][d] = coordinate[d] - found.first[c][d];
            found.lowest[d]      = min(found.lowest[d], found.first[c][d]);
            found.extent[d]      = max(found.extent[d], found.first[c][d]);
            found.gradient[c][d] = 0.;
            for (unsigned int e = 0; e < dim; ++e)
              found.gradient[c][d] += (c >> e & 1 ? 1. / n_corners : -1. / n_corners) * dual[d][e];
          }
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
        if (!is_small)
        {
          for_each_hat(found, l, [&](const auto &node, const Four &value) { add(found, l, node, value, stencil); });
          return;
        }
        Four               sums[max_merged];
        const int          size = extent[0] * extent[1] * (dim == 3 ? extent[dim - 1] : 1);
        for (int i = 0; i < size; ++i)
          sums[i] = 0.;
        for_each_hat(found, l, [&](const auto &node, const Four &value) {
          int i = node[dim - 1] - lowest[dim - 1];
          for (unsigned int d = dim - 1; d-- > 0;)
            i = i * extent[d] + node[d] - lowest[d];
          sums[i] += value;
        });
        int i = 0;
        for (int c = 0; c < (dim == 3 ? extent[dim - 1] : 1); ++c)
          for (int b = 0; b < extent[1]; ++b)
            for (int a = 0; a < extent[0]; ++a, ++i)
            {
              std::array<int, dim> node = lowest;
              node[0] += a;
              node[1] += b;
              if constexpr (dim == 3)
                node[2] += c;
              add(found, l, node, sums[i], stencil);
            }
      }

      /** Calls `body(node, value)` for the hats at all corners: lattice index of the node, share of phi and grad phi. */
      template <class Body>
      [[gnu::always_inline]] void for_each_hat(const Batch &found, const unsigned int l, const Body &body) const
      {
        for (unsigned int c = 0; c < n_corners; ++c)
        {
          alignas(32) double   factor[4] = {1. / n_corners, 0., 0., 0.};
          std::array<int, dim> first;
          double               weight[dim][2];
          for (unsigned int d = 0; d < dim; ++d)
          {
            factor[1 + d] = found.gradient[c][d].data()[l];
            first[d]      = static_cast<int>(found.first[c][d].data()[l]);
            weight[d][1]  = found.distance[c][d].data()[l];
            weight[d][0]  = 1 - weight[d][1];
          }
          const Four of_corner = Four::load(factor);
          for (unsigned int i = 0; i < n_hats; ++i)
          {
            std::array<int, dim> node = first;
            double               hat  = 1;
            for (unsigned int d = 0; d < dim; ++d)
            {
              node[d] += i >> d & 1;
              hat *= weight[d][i >> d & 1];
            }
            body(node, hat * of_corner);
          }
        }
      }

      void add(const Batch &found, const unsigned int l, const std::array<int, dim> &node, const Four &value,
               Stencil<dim> &stencil) const
      {
        const double *numbers = value.data();
        // Nodes of the merged box that no corner sees, among them those beyond the domain.
        bool has_weight = numbers[0] != 0;
        for (unsigned int d = 0; d < dim; ++d)
          has_weight = has_weight || numbers[1 + d] != 0;
        if (!has_weight)
          return;
        const unsigned int k = stencil.size++;
        stencil.place[k]     = lattice->table_index(node);
        stencil.weight[k]    = numbers[0];
        for (unsigned int d = 0; d < dim; ++d)
        {
          stencil.offset[d][k]   = (node[d] - found.x[d].data()[l]) * lattice->h[d];
          stencil.gradient[d][k] = numbers[1 + d];
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

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
      Reach reach() const override { return {2, 0., /* at_corners = */ true, n_layers}; }

      void attach(const Grid<dim> &grid) override
      {
        lattice = &box_grid(grid, "/Kernel", "Type").lattice;
        for (unsigned int form = 0; form < n_forms; ++form)
        {
          Box &box = boxes[form];
          box      = Box();
          for (unsigned int i = 0; i < n_box; ++i)
          {
            unsigned int place     = 0;
            bool         is_listed = true;
            for (unsigned int d = 0, rest = i; d < dim; ++d, rest /= usual_extent)
            {
              place += rest % usual_extent * lattice->stride[d];
              is_listed = is_listed && rest % usual_extent < 2 + (form >> d & 1);
            }
            if (!is_listed)
              continue;
            box.place[box.size] = place;
            box.row[box.size++] = i * native_width;
          }
        }
      }

      void evaluate(const WorkingSet<dim> &particles, const unsigned int begin, const unsigned int end,
                    Stencil<dim> *stencils) const override
      {
        const Corners<dim> corners(particles, half_edges);
        Domains            found;
        for_each_batch(begin, end, [&](const auto batch) {
          find(corners.position(batch), corners.half_edges(batch), found);
          Stencil<dim> *of_batch = stencils + (batch.p - begin);
          if (found.largest_extent <= static_cast<int>(usual_extent))
            list_boxes(found, batch.size(), of_batch);
          else
            for (unsigned int l = 0; l < batch.size(); ++l)
              list_corners(found, l, of_batch[l]);
        });
      }

    private:
      using Number = Simd<native_width>;

      static constexpr unsigned int n_corners = Corners<dim>::n;
      static constexpr unsigned int n_hats    = 1u << dim; // that are not zero at a corner

      // Nodes per axis of a box that holds those of all corners, as long as a domain is no longer than a spacing.
      static constexpr unsigned int usual_extent = 3;
      static constexpr unsigned int n_inner      = dim == 2 ? usual_extent : usual_extent * usual_extent; // of a layer
      static constexpr unsigned int n_box        = n_inner * usual_extent;
      static constexpr unsigned int n_forms      = 1u << dim; // with 2 or 3 nodes along each axis

      /** The nodes of a box that a domain reaches. */
      struct Box
      {
        unsigned int size         = 0;
        unsigned int place[n_box] = {}; // after that of the first
        unsigned int row[n_box]   = {}; // of a batch's numbers
      };

      /** The domains of a batch, one in each lane. */
      struct Domains
      {
        Number x[dim];                   // lattice coordinates of the particle
        Number corner[n_corners][dim];   // and of the corners
        Number gradient[n_corners][dim]; // 2^-d sum_e s_ce r^e
        Number lowest[dim], extent[dim]; // the box of nodes: first index and number
        int    largest_extent;           // of any lane and axis
        int    n_layers;                 // largest extent of any lane along the last axis, 2 at least
      };

      void find(const dealii::Tensor<1, dim, Number> &x, const dealii::Tensor<2, dim, Number> &r, Domains &found) const
      {
        // Rows of r are half edges, so columns of its inverse the dual vectors.
        const auto dual = invert(r);
        Number     highest[dim];
        for (unsigned int c = 0; c < n_corners; ++c)
        {
          const auto coordinate = Corners<dim>::coordinates(*lattice, x + Corners<dim>::arm(r, c));
          for (unsigned int d = 0; d < dim; ++d)
          {
            found.corner[c][d]   = coordinate[d];
            found.lowest[d]      = c == 0 ? coordinate[d] : min(found.lowest[d], coordinate[d]);
            highest[d]           = c == 0 ? coordinate[d] : max(highest[d], coordinate[d]);
            found.gradient[c][d] = 0.;
            for (unsigned int e = 0; e < dim; ++e)
              found.gradient[c][d] += (c >> e & 1 ? 1. / n_corners : -1. / n_corners) * dual[d][e];
          }
        }
        const auto greatest = [](const Number &value) {
          return static_cast<int>(*std::max_element(value.data(), value.data() + native_width));
        };
        found.largest_extent = 0;
        for (unsigned int d = 0; d < dim; ++d)
        {
          found.x[d]           = (x[d] - lattice->origin[d]) * lattice->inverse_h[d];
          found.lowest[d]      = floor(found.lowest[d]);
          found.extent[d]      = 1. - found.lowest[d] - floor(-highest[d]); // with the ceiling of the highest
          found.n_layers       = std::max(2, greatest(found.extent[d]));
          found.largest_extent = std::max(found.largest_extent, found.n_layers);
        }
      }

      /** The hats of some nodes of a line at lattice coordinate t after the first. */
      static Number hat(const Number &t, const unsigned int k) { return max(1. - abs(t - Number(1. * k)), Number(0.)); }

      /**
       * Lists the nodes of boxes, those of several corners once: sums over corners, with a domain in each lane. Nodes
       * of the box that no corner sees have weight 0; those beyond a domain's own box are left out.
       */
      void list_boxes(const Domains &found, const unsigned int size, Stencil<dim> *stencils) const
      {
        constexpr unsigned int last     = dim - 1;
        const unsigned int     n_layers = found.n_layers, n_listed = n_layers * n_inner;
        Number                 inner[n_corners][n_inner], outer[usual_extent][n_corners][1 + dim];
        for (unsigned int c = 0; c < n_corners; ++c)
        {
          Number along[dim][usual_extent];
          for (unsigned int d = 0; d < dim; ++d)
            for (unsigned int k = 0; k < usual_extent; ++k)
              along[d][k] = hat(found.corner[c][d] - found.lowest[d], k);
          for (unsigned int i = 0; i < n_inner; ++i)
            inner[c][i] = dim == 2 ? along[0][i] : along[0][i % usual_extent] * along[1][i / usual_extent];
          for (unsigned int k = 0; k < n_layers; ++k)
          {
            outer[k][c][0] = (1. / n_corners) * along[last][k];
            for (unsigned int d = 0; d < dim; ++d)
              outer[k][c][1 + d] = along[last][k] * found.gradient[c][d];
          }
        }
        double *numbers = stencils[0].keep(Stencil<dim>::n_columns * n_box * native_width);
        for (unsigned int k = 0; k < n_layers; ++k)
          for (unsigned int i = 0; i < n_inner; i += usual_extent)
            add_corners(inner, outer[k], i, numbers + (k * n_inner + i) * native_width);
        set_offsets(found, n_listed, numbers);

        alignas(64) int lowest[dim][native_width], extent[dim][native_width];
        for (unsigned int d = 0; d < dim; ++d)
        {
          store_integers(found.lowest[d], lowest[d]);
          store_integers(found.extent[d], extent[d]);
        }
        for (unsigned int l = 0; l < size; ++l)
        {
          typename Lattice<dim>::Index first;
          unsigned int                 form = 0;
          for (unsigned int d = 0; d < dim; ++d)
          {
            first[d] = lowest[d][l];
            form |= (extent[d][l] > 2 ? 1u : 0u) << d;
          }
          const Box &box = boxes[form];
          stencils[l].reserve(n_box);
          stencils[l].share(box.size, numbers + l, n_box * native_width, box.row);
          stencils[l].is_at_slip_wall.fill(false);
          const unsigned int place  = lattice->table_index(first);
          unsigned int      *places = stencils[l].place.data();
#pragma GCC ivdep
          for (unsigned int i = 0; i < n_box; ++i)
            places[i] = place + box.place[i];
        }
      }

      /** What all corners give to a line of nodes, in registers. */
      [[gnu::always_inline]] static void add_corners(const Number (&inner)[n_corners][n_inner],
                                                     const Number (&outer)[n_corners][1 + dim], const unsigned int i,
                                                     double *numbers)
      {
        Number sum[usual_extent][1 + dim];
        for (auto &of_node : sum)
          for (Number &number : of_node)
            number = 0.;
        for (unsigned int c = 0; c < n_corners; ++c)
          for (unsigned int a = 0; a < usual_extent; ++a)
            for (unsigned int j = 0; j <= dim; ++j)
              sum[a][j] += inner[c][i + a] * outer[c][j];
        for (unsigned int a = 0; a < usual_extent; ++a)
          for (unsigned int j = 0; j <= dim; ++j)
            sum[a][j].store(numbers + (a + (j == 0 ? 0 : dim + j) * n_box) * native_width);
      }

      void set_offsets(const Domains &found, const unsigned int n_listed, double *numbers) const
      {
        for (unsigned int d = 0; d < dim; ++d)
        {
          Number along[usual_extent];
          for (unsigned int k = 0; k < usual_extent; ++k)
            along[k] = (found.lowest[d] + 1. * k - found.x[d]) * lattice->h[d];
          double *column = numbers + (1 + d) * n_box * native_width;
          for (unsigned int i = 0, step = d == 0 ? 1 : d == 1 ? usual_extent : n_inner; i < n_listed; ++i)
            along[i / step % usual_extent].store(column + i * native_width);
        }
      }

      /** Lists the nodes of each corner by themselves: of domains that are stretched over more than a few cells. */
      void list_corners(const Domains &found, const unsigned int l, Stencil<dim> &stencil) const
      {
        stencil.reserve(n_corners * n_hats);
        stencil.is_at_slip_wall.fill(false);
        for (unsigned int c = 0; c < n_corners; ++c)
          for (unsigned int i = 0; i < n_hats; ++i)
          {
            double                       weight = 1;
            typename Lattice<dim>::Index index;
            for (unsigned int d = 0; d < dim; ++d)
            {
              const double x = found.corner[c][d].data()[l], lower = std::floor(x);
              const bool   is_upper = i >> d & 1;
              weight *= is_upper ? x - lower : 1 - (x - lower);
              index[d] = static_cast<int>(lower) + is_upper;
            }
            if (weight == 0) // perhaps beyond the domain
              continue;
            const unsigned int k = stencil.size++;
            stencil.place[k]     = lattice->table_index(index);
            stencil.weight[k]    = weight / n_corners;
            for (unsigned int d = 0; d < dim; ++d)
            {
              stencil.offset[d][k]   = (index[d] - found.x[d].data()[l]) * lattice->h[d];
              stencil.gradient[d][k] = weight * found.gradient[c][d].data()[l];
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
      Box                 boxes[n_forms];
    };

    const RegisterDimensions<Kernel, Cpdi> registration(
      "CPDI", "convected particle domain interpolation: hats averaged over deformed particle domains");
  } // namespace
} // namespace Talus

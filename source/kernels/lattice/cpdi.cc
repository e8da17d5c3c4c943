#include <talus/core/registry.h>
#include <talus/grid/box_grid.h>
#include <talus/kernels/lattice/corner_hats.h>
#include <talus/kernels/kernel.h>

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
     * sum phi x_i = x_p and sum x_i (x) grad phi = I hold for any half edges. A list has the nodes of each corner's
     * cell, some several times. Test: tests/kernels/cpdi.cc.
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
      void  attach(const Grid<dim> &grid) override { lattice = &box_grid(grid, "/Kernel", "Type").lattice; }

      std::optional<DomainForm<dim>> domain_form() const override { return {{*lattice, half_edges}}; }

      void evaluate(const WorkingSet<dim> &particles, const unsigned int begin, const unsigned int end,
                    Stencil<dim> *stencils) const override
      {
        const Corners<dim> corners(particles, half_edges);
        CornerHats<dim>    hats;
        for_each_batch(begin, end, [&](const auto batch) {
          hats.find(*lattice, corners, batch);
          for (unsigned int l = 0; l < batch.size(); ++l)
            list(hats, l, stencils[batch.p - begin + l]);
        });
      }

    private:
      void list(const CornerHats<dim> &hats, const unsigned int l, Stencil<dim> &stencil) const
      {
        constexpr double share = 1. / CornerHats<dim>::n_corners;
        stencil.reserve(hats.n_corners * hats.n_nodes);
        stencil.is_at_slip_wall.fill(false);
        for (unsigned int c = 0; c < hats.n_corners; ++c)
        {
          dealii::Tensor<1, dim> arm, gradient;
          for (unsigned int e = 0; e < dim; ++e)
            for (unsigned int d = 0; d < dim; ++d)
            {
              arm[d] += hats.sign(c, e) * hats.half_edges[e][d][l];
              gradient[d] += share * hats.sign(c, e) * hats.dual[d][e][l];
            }
          for (unsigned int i = 0; i < hats.n_nodes; ++i)
          {
            const double hat = hats.hat[c][i][l];
            if (hat == 0) // perhaps nothing is there
              continue;
            const unsigned int k = stencil.size++;
            stencil.place[k]     = hats.place[c][l] + hats.step[i];
            stencil.weight[k]    = share * hat;
            for (unsigned int d = 0; d < dim; ++d)
            {
              stencil.offset[d][k]   = arm[d] + ((i >> d & 1) - hats.fraction[c][d][l]) * lattice->h[d];
              stencil.gradient[d][k] = hat * gradient[d];
            }
          }
        }
      }

      const Lattice<dim> *lattice    = nullptr;
      unsigned int        half_edges = 0, n_layers = 2;
    };

    const RegisterDimensions<Kernel, Cpdi> registration(
      "CPDI", "convected particle domain interpolation: hats averaged over deformed particle domains");
  } // namespace
} // namespace Talus

#include <talus/core/registry.h>
#include <talus/kernels/lattice_batch.h>
#include <talus/particles/batch_access.h>
#include <talus/transfer/volume_smoothing.h>

#include <cmath>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    // Of a node: the mass, and its mean J in place of the first component of the velocity.
    template <int dim>
    constexpr unsigned int mean = NodalFields<dim>::velocity;

    /** Both passes for one function of the kernel; the stencils of a batch are made once for all of its particles. */
    template <int dim, class Function>
    class Passes
    {
    public:
      using Number = Simd<native_width>;

      Passes(const Function &function, const Treatment<dim> &treatment, const MaterialRange &range,
             const double reference_density, const unsigned int gradient, Particles<dim> &particles, Grid<dim> &grid) :
        function(function),
        treatment(treatment), range(range), reference(reference_density), grid(grid), lattice(grid.lattice),
        position(particles.template components<dim>(particles.position)),
        F(particles.template components<dim * dim>(particles.F)), g(particles.template components<dim>(gradient)),
        mass(particles.component(particles.mass, 0)), volume(particles.component(particles.volume, 0))
      {
      }

      void scatter()
      {
        for_each_stencil([&](const auto &batch, const LatticeBatch<dim, n> &stencil) {
          const Number m = batch.load(mass), J = reference * batch.load(volume) / m;
          const auto   g_p = load_vector<dim>(batch, g);
          for (unsigned int l = 0; l < batch.size(); ++l)
            for_each_node(stencil, l, [&](double *node, const unsigned int *k, const double *weight, const double *) {
              double J_here = J.data()[l];
              for (unsigned int d = 0; d < dim; ++d)
                J_here += g_p[d].data()[l] * stencil.offset[d][k[d]].data()[l];
              node[NodalFields<dim>::mass] += m.data()[l] * *weight;
              node[mean<dim>] += m.data()[l] * *weight * J_here;
            });
        });
      }

      void gather(const double alpha)
      {
        for_each_stencil([&](const auto &batch, const LatticeBatch<dim, n> &stencil) {
          Number                 mean_J = 0.;
          Tensor<1, dim, Number> g_p;
          for (unsigned int l = 0; l < batch.size(); ++l)
          {
            double         sum = 0;
            Tensor<1, dim> slope;
            for_each_node(stencil, l,
                          [&](const double *node, const unsigned int *, const double *weight, const double *gradient) {
                            sum += *weight * node[mean<dim>];
                            for (unsigned int d = 0; d < dim; ++d)
                              slope[d] += gradient[d] * node[mean<dim>];
                          });
            mean_J.set(l, sum);
            for (unsigned int d = 0; d < dim; ++d)
              g_p[d].set(l, slope[d]);
          }
          store_vector<dim>(batch, g, g_p);

          const Number V = batch.load(volume), J = reference * V / batch.load(mass),
                       ratio = 1. + alpha * (mean_J / J - 1.);
          batch.store(volume, ratio * V);
          Number stretch = 1.;
          for (unsigned int l = 0; l < batch.size(); ++l)
            stretch.set(l, std::pow(ratio.data()[l], 1. / dim));
          store_matrix<dim>(batch, F, stretch * load_matrix<dim>(batch, F));
        });
      }

    private:
      static constexpr unsigned int n = Function::n;

      template <class Body>
      void for_each_stencil(const Body &body)
      {
        LatticeBatch<dim, n> stencil;
        for_each_batch(range.begin, range.end, [&](const auto batch) {
          evaluate_batch(function, lattice, treatment, load_vector<dim>(batch, position), stencil);
          body(batch, stencil);
        });
      }

      /** Calls `body(numbers of the node, its place along each axis, weight, gradient)` for the nodes of a particle. */
      template <class Body>
      void for_each_node(const LatticeBatch<dim, n> &stencil, const unsigned int l, const Body &body)
      {
        const unsigned int *nodes = lattice.node.data() + stencil.first_node[l];
        for (unsigned int i = 0; i < stencil.n_nodes; ++i)
        {
          const unsigned int k[3] = {i % n, i / n % n, i / (n * n)};
          const unsigned int node =
            nodes[k[0] + k[1] * lattice.stride[1] + (dim == 3 ? k[2] * lattice.stride[dim - 1] : 0)];
          if (node == Lattice<dim>::missing)
            continue;
          double weight = 1, gradient[dim];
          for (unsigned int d = 0; d < dim; ++d)
          {
            gradient[d] = 1;
            for (unsigned int e = 0; e < dim; ++e)
              gradient[d] *= (d == e ? stencil.derivative : stencil.weight)[e][k[e]].data()[l];
            weight *= stencil.weight[d][k[d]].data()[l];
          }
          if (!stencil.is_product)
          {
            weight = stencil.value[i].data()[l];
            for (unsigned int d = 0; d < dim; ++d)
              gradient[d] = stencil.gradient[d][i].data()[l];
          }
          body(grid.fields[node], k, &weight, gradient);
        }
      }

      const Function                 &function;
      const Treatment<dim>           &treatment;
      const MaterialRange            &range;
      const double                    reference;
      Grid<dim>                      &grid;
      const Lattice<dim>             &lattice;
      std::array<double *, dim>       position;
      std::array<double *, dim * dim> F;
      std::array<double *, dim>       g;
      const double                   *mass;
      double                         *volume;
    };
  } // namespace

  template <int dim>
  VolumeSmoothing<dim>::VolumeSmoothing() : treatment(Registry<Treatment<dim>>::get().make("WLS separable", "/Kernel"))
  {
  }

  template <int dim>
  void VolumeSmoothing<dim>::add_fields(const std::vector<std::unique_ptr<Material>> &materials,
                                        WorkingSet<dim>                              &particles)
  {
    for (const auto &material : materials)
      if (material->smoothing_speed() > 0)
        gradient = particles.add_field("gradient of the smoothed volume ratio", dim);
  }

  template <int dim>
  void VolumeSmoothing<dim>::initialize(const std::vector<std::unique_ptr<Material>> &materials,
                                        const Kernel<dim> &kernel, Particles<dim> &particles, Grid<dim> &grid) const
  {
    for (unsigned int m = 0; m < materials.size(); ++m)
      if (materials[m]->smoothing_speed() > 0)
        smooth(*materials[m], material_range(particles, *materials[m], m, 0.), kernel, /* alpha = */ 0., particles,
               grid);
  }

  template <int dim>
  void VolumeSmoothing<dim>::apply(const std::vector<std::unique_ptr<Material>> &materials, const Kernel<dim> &kernel,
                                   const double dt, Particles<dim> &particles, Grid<dim> &grid) const
  {
    for (unsigned int m = 0; m < materials.size(); ++m)
    {
      const double speed = materials[m]->smoothing_speed();
      if (!(speed > 0))
        continue;
      const auto range = material_range(particles, *materials[m], m, dt);
      smooth(*materials[m], range, kernel, std::min(1., speed * dt / grid.lattice.smallest_spacing()), particles, grid);
      // A material that smooths has no memory: this gives the stress of the new volume, whatever the step.
      materials[m]->update(range);
    }
  }

  template <int dim>
  void VolumeSmoothing<dim>::smooth(const Material &material, const MaterialRange &range, const Kernel<dim> &kernel,
                                    const double alpha, Particles<dim> &particles, Grid<dim> &grid) const
  {
    using Fields        = NodalFields<dim>;
    const auto function = kernel.lattice_function();
    AssertThrow(function, ExcMessage("Smoothing of J needs a kernel that is a product over the axes."));
    std::visit(
      [&](const auto &function) {
        Passes<dim, std::decay_t<decltype(function)>> passes(function, *treatment, range, material.density, gradient,
                                                             particles, grid);
        grid.clear();
        passes.scatter();
        grid.fields.add_copies_to_owners();
        for (const unsigned int i : grid.active_nodes)
        {
          double      *node = grid.fields[i];
          const double m    = node[Fields::mass];
          // An empty node counts next to nothing, whatever it says.
          node[mean<dim>] = m > grid.mass_floor ? node[mean<dim>] / m : 1.;
        }
        grid.fields.update_copies();
        passes.gather(alpha);
      },
      *function);
  }

  template class VolumeSmoothing<2>;
  template class VolumeSmoothing<3>;
} // namespace Talus

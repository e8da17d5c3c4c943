#include <talus/core/registry.h>
#include <talus/kernels/lattice_batch.h>
#include <talus/particles/batch_access.h>
#include <talus/transfer/volume_smoothing.h>

#include <algorithm>

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
             const double reference_density, const unsigned int gradient, Particles<dim> &particles,
             const Lattice<dim> &lattice, NodalArray<2> &fields) :
        function(function),
        treatment(treatment), range(range), reference(reference_density), lattice(lattice), fields(fields),
        position(particles.template components<dim>(particles.position)), J_p(particles.component(particles.F, 0)),
        g(particles.template components<dim>(gradient)), mass(particles.component(particles.mass, 0)),
        volume(particles.component(particles.volume, 0))
      {
      }

      void scatter()
      {
        for_each_stencil([&](const auto &batch, const auto &stencil) {
          const Number m = batch.load(mass), J = reference * batch.load(volume) / m;
          const auto   g_p = load_vector<dim>(batch, g);
          Number       weight[n_nodes], moment[n_nodes];
          for (unsigned int i = 0; i < n_nodes; ++i)
          {
            Number J_i = J;
            for (unsigned int d = 0; d < dim; ++d)
              J_i += g_p[d] * stencil.offset[d][place(i, d)];
            weight[i] = m * stencil.value[i];
            moment[i] = weight[i] * J_i;
          }
          for (unsigned int l = 0; l < batch.size(); ++l)
            for (unsigned int i = 0; i < n_nodes; ++i)
              if (double *node = find(stencil, l, i))
              {
                node[NodalFields<dim>::mass] += weight[i].data()[l];
                node[mean<dim>] += moment[i].data()[l];
              }
        });
      }

      void gather(const double alpha)
      {
        for_each_stencil([&](const auto &batch, const auto &stencil) {
          Number                 mean_J = 0.;
          Tensor<1, dim, Number> g_p;
          for (unsigned int i = 0; i < n_nodes; ++i)
          {
            alignas(64) double values[native_width];
            for (unsigned int l = 0; l < native_width; ++l)
            {
              const double *node = find(stencil, l, i);
              values[l]          = node ? node[mean<dim>] : 0.; // has no weight where it does not exist
            }
            const Number J_i = Number::load(values);
            mean_J += stencil.value[i] * J_i;
            for (unsigned int d = 0; d < dim; ++d)
              g_p[d] += stencil.gradient[d][i] * J_i;
          }
          store_vector<dim>(batch, g, g_p);

          const Number V     = batch.load(volume);
          const Number ratio = 1. + alpha * (mean_J * batch.load(mass) / (reference * V) - 1.);
          batch.store(volume, ratio * V);
          batch.store(J_p, reference * (ratio * V) / batch.load(mass)); // F = diag(J, 1, 1)
        });
      }

    private:
      static constexpr unsigned int n = Function::n, n_nodes = LatticeBatch<dim, n>::n_nodes;

      /** The place of a node of a list along an axis. */
      static unsigned int place(const unsigned int i, const unsigned int d)
      {
        return d == 0 ? i % n : (d == 1 ? i / n % n : i / (n * n));
      }

      /** Calls `body(batch, stencil)` for all particles; all stencils are lists. */
      template <class Body>
      void for_each_stencil(const Body &body)
      {
        const BatchEvaluator<dim, Function> evaluator(function, lattice, treatment);
        LatticeBatch<dim, n>                stencil;
        for_each_batch(range.begin, range.end, [&](const auto batch) {
          evaluator.locate(load_vector<dim>(batch, position), stencil);
          evaluator.evaluate(stencil);
          if (!stencil.is_at_face)
          {
            LatticeFactors<dim> factors;
            for (unsigned int d = 0; d < dim; ++d)
            {
              std::copy_n(stencil.weight[d], n, factors.weight[d]);
              std::copy_n(stencil.derivative[d], n, factors.derivative[d]);
            }
            multiply(factors, stencil);
          }
          body(batch, stencil);
        });
      }

      /** The numbers of a node, null if it does not exist. */
      double *find(const LatticeBatch<dim, n> &stencil, const unsigned int l, const unsigned int i)
      {
        unsigned int at = stencil.first_node[l];
        for (unsigned int d = 0; d < dim; ++d)
          at += place(i, d) * lattice.stride[d];
        return lattice.node[at] == Lattice<dim>::missing ? nullptr : fields.at_place(at);
      }

      const Function           &function;
      const Treatment<dim>     &treatment;
      const MaterialRange      &range;
      const double              reference;
      const Lattice<dim>       &lattice;
      NodalArray<2>            &fields;
      std::array<double *, dim> position;
      double                   *J_p;
      std::array<double *, dim> g;
      const double             *mass;
      double                   *volume;
    };
  } // namespace

  template <int dim>
  VolumeSmoothing<dim>::VolumeSmoothing(Parameters &parameters) :
    treatment(Registry<Treatment<dim>>::get().make("WLS separable", parameters, "/Kernel"))
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
                                        const Kernel<dim> &kernel, Particles<dim> &particles, const Grid<dim> &grid)
  {
    const auto smooths = [](const auto &material) { return material->smoothing_speed() > 0; };
    if (std::any_of(materials.begin(), materials.end(), smooths))
      fields.reinit(grid.nodes);
    for (unsigned int m = 0; m < materials.size(); ++m)
      if (smooths(materials[m]))
        smooth(*materials[m], material_range(particles, m, 0.), kernel, /* alpha = */ 0., particles,
               grid);
  }

  template <int dim>
  void VolumeSmoothing<dim>::apply(const std::vector<std::unique_ptr<Material>> &materials, const Kernel<dim> &kernel,
                                   const double dt, Particles<dim> &particles, const Grid<dim> &grid)
  {
    for (unsigned int m = 0; m < materials.size(); ++m)
    {
      const double speed = materials[m]->smoothing_speed();
      if (!(speed > 0))
        continue;
      const auto range = material_range(particles, m, dt);
      smooth(*materials[m], range, kernel, std::min(1., speed * dt / grid.smallest_spacing), particles, grid);
      // A material that smooths has no memory: this gives the stress of the new volume, whatever the step.
      materials[m]->update(range);
    }
  }

  template <int dim>
  void VolumeSmoothing<dim>::smooth(const Material &material, const MaterialRange &range, const Kernel<dim> &kernel,
                                    const double alpha, Particles<dim> &particles, const Grid<dim> &grid)
  {
    using Fields        = NodalFields<dim>;
    const auto form = kernel.lattice_form();
    AssertThrow(form, ExcMessage("Smoothing of J needs a kernel that is a product over the axes."));
    std::visit(
      [&](const auto &function) {
        Passes<dim, std::decay_t<decltype(function)>> passes(function, *treatment, range, material.density, gradient,
                                                             particles, form->lattice, fields);
        // Nodes that are not active are not read.
        fields.clear(grid.active_nodes);
        passes.scatter();
        fields.add_copies_to_owners();
        for (const unsigned int i : grid.active_nodes)
        {
          double      *node = fields[i];
          const double m    = node[Fields::mass];
          // An empty node counts next to nothing, whatever it says.
          node[mean<dim>] = m > grid.mass_floor ? node[mean<dim>] / m : 1.;
        }
        fields.update_copies();
        passes.gather(alpha);
      },
      form->function);
  }

  template class VolumeSmoothing<2>;
  template class VolumeSmoothing<3>;
} // namespace Talus

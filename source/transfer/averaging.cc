#include <talus/core/registry.h>
#include <talus/transfer/averaging.h>
#include <talus/transfer/loops.h>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    /** A velocity and its gradient, scattered and gathered: TPIC. */
    template <int dim>
    struct Average : Scheme<dim>
    {
      static constexpr bool is_affine = true;

      template <class Batch, class Moment>
      auto affine(const TransferArrays<dim> &arrays, const Batch &batch, const Moment &, const double) const
      {
        return load_matrix<dim>(batch, arrays.grad_v);
      }

      template <class Batch>
      void update(const TransferArrays<dim> &arrays, const Batch &batch,
                  const Gathered<dim, typename Batch::Number> &sum) const
      {
        store_vector<dim>(batch, arrays.velocity, sum.velocity);
      }
    };

    /** The arrays of a transfer whose velocity the quantities are; `missing` stands for those that are not there. */
    template <int dim>
    void bind(const std::array<typename Averaging<dim>::Quantity, dim> &quantities, double *missing,
              TransferArrays<dim> &arrays)
    {
      const auto or_missing = [&](double *array) { return array ? array : missing; };
      for (unsigned int k = 0; k < dim; ++k)
      {
        arrays.velocity[k] = or_missing(quantities[k].value);
        for (unsigned int e = 0; e < dim; ++e)
          arrays.grad_v[dim * k + e] = or_missing(quantities[k].gradient[e]);
      }
    }
  } // namespace

  template <int dim>
  Averaging<dim>::Averaging(Parameters &parameters, const std::string &treatment) :
    treatment(Registry<Treatment<dim>>::get().make(treatment, parameters, "/Kernel"))
  {
    no_force.initialize(dim == 2 ? "0; 0" : "0; 0; 0", "/", "");
    AssertThrow(!this->treatment->is_mirror(), ExcMessage("Averages do not know mirror images."));
  }

  template <int dim>
  void Averaging<dim>::apply(const std::array<Quantity, dim> &quantities, const std::array<double, dim> &empty,
                             Particles<dim> &particles, const unsigned int begin, const unsigned int end,
                             const Kernel<dim> &kernel, const Grid<dim> &grid)
  {
    using Fields = NodalFields<dim>;
    if (fields.is_empty())
      fields.reinit(grid.nodes);
    zeros.resize(particles.size(), 0.);
    unused.resize(particles.size());
    TransferArrays<dim> arrays(particles);
    bind<dim>(quantities, zeros.data(), arrays);
    arrays.stress.fill(zeros.data());

    CompiledForm<dim> form = kernel.compiled_form();
    if (const auto own = kernel.product_form())
      form.template emplace<ProductForm<dim>>(own->with(*treatment));
    // Nodes that are not active are not read.
    fields.clear(grid.active_nodes);
    Loops<dim, Average<dim>>::particle_to_grid({}, arrays, particles, kernel, form, no_force, 0., begin, end, grid,
                                               fields);
    fields.add_copies_to_owners();
    for (const unsigned int i : grid.active_nodes)
    {
      double      *node = fields[i];
      const double m    = node[Fields::mass];
      for (unsigned int k = 0; k < dim; ++k)
        // An empty node counts next to nothing, whatever it says.
        node[Fields::velocity + k] = m > grid.mass_floor ? node[Fields::momentum + k] / m : empty[k];
    }
    fields.update_copies();
    bind<dim>(quantities, unused.data(), arrays);
    Loops<dim, Average<dim>>::grid_to_particle({}, arrays, particles, kernel, form, grid, fields, /* dt = */ 0., begin,
                                               end);
  }

  template class Averaging<2>;
  template class Averaging<3>;
} // namespace Talus

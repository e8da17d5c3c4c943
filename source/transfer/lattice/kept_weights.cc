#include <talus/kernels/lattice/lattice_batch.h>
#include <talus/particles/batch_access.h>
#include <talus/transfer/kept_weights.h>

#include <algorithm>

namespace Talus
{
  namespace
  {
    /** The variant's alternative, as it is if it is that one already: its arrays keep their memory. */
    template <class Alternative, class Variant>
    Alternative &choose(Variant &variant)
    {
      if (!std::holds_alternative<Alternative>(variant))
        variant.template emplace<Alternative>();
      return std::get<Alternative>(variant);
    }
  } // namespace

  template <int dim>
  void KeptWeights<dim>::find(const Kernel<dim> &kernel, const WorkingSet<dim> &particles)
  {
    if (const auto form = kernel.product_form())
      std::visit([&](const auto &function) { find_products(*form, function, particles); }, form->function);
    else
      find_lists(kernel, particles);
    sum.assign(particles.size(), 0.);
    std::visit(
      [&](const auto &w) {
        for (unsigned int p = 0; p < particles.size(); ++p)
          w.for_each(p, [&](const unsigned int, const double weight) { sum[p] += weight; });
      },
      weights);
  }

  template <int dim>
  template <class Function>
  void KeptWeights<dim>::find_products(const ProductForm<dim> &form, const Function &function,
                                       const WorkingSet<dim> &particles)
  {
    using Number                             = Simd<native_width>;
    constexpr unsigned int              n    = Function::n;
    auto                               &kept = choose<ProductWeights<dim, n>>(weights);
    const BatchEvaluator<dim, Function> evaluator(function, form.lattice, form.treatment);
    const auto                          x = particles.template components<dim>(particles.position);
    kept.weight.resize(particles.size());
    kept.first.resize(particles.size());
    std::copy(form.lattice.stride.begin(), form.lattice.stride.end(), kept.stride.begin());
    LatticePlaces<dim> found;
    for_each_batch(0, particles.size(), [&](const auto batch) {
      evaluator.locate(load_vector<dim>(batch, x), found);
      for (unsigned int d = 0; d < dim; ++d)
      {
        Number weight[n], derivative[n];
        function.evaluate(found.distance[d], weight, derivative);
        for (unsigned int k = 0; k < n; ++k)
        {
          const Number index  = found.first[d] + static_cast<double>(k);
          const auto is_there = (index >= Number(0.)) & (index <= Number(static_cast<double>(form.lattice.n_cells[d])));
          weight[k]           = select(is_there, weight[k], Number(0.));
          for (unsigned int l = 0; l < batch.size(); ++l)
            kept.weight[batch.p + l][d * n + k] = weight[k].data()[l];
        }
      }
      for (unsigned int l = 0; l < batch.size(); ++l)
        kept.first[batch.p + l] = found.first_node[l];
    });
  }

  template <int dim>
  void KeptWeights<dim>::find_lists(const Kernel<dim> &kernel, const WorkingSet<dim> &particles)
  {
    auto &kept = choose<ListWeights>(weights);
    kept.begin.assign(1, 0);
    kept.weight.clear();
    kept.place.clear();
    constexpr unsigned int batch = Kernel<dim>::max_batch;
    Stencil<dim>           stencils[batch];
    for (unsigned int begin = 0; begin < particles.size(); begin += batch)
    {
      const unsigned int end = std::min(begin + batch, particles.size());
      kernel.evaluate(particles, begin, end, stencils);
      for (unsigned int p = begin; p < end; ++p)
      {
        const auto &stencil = stencils[p - begin];
        kept.weight.insert(kept.weight.end(), stencil.weight, stencil.weight + stencil.size);
        kept.place.insert(kept.place.end(), stencil.place.begin(), stencil.place.begin() + stencil.size);
        kept.begin.push_back(kept.weight.size());
      }
    }
  }

  template <int dim>
  void KeptWeights<dim>::scatter(const double *a, const unsigned int begin, const unsigned int end,
                                 NodalArray<1> &nodes) const
  {
    double *const values = nodes.at_place(0);
    std::visit(
      [&](const auto &w) {
        for (unsigned int p = begin; p < end; ++p)
        {
          const double a_p = a[p];
          w.for_each(p, [&](const unsigned int place, const double weight) { values[place] += weight * a_p; });
        }
      },
      weights);
  }

  template <int dim>
  void KeptWeights<dim>::gather(const NodalArray<1> &nodes, const unsigned int begin, const unsigned int end,
                                double *a) const
  {
    const double *const values = nodes.at_place(0);
    std::visit(
      [&](const auto &w) {
        for (unsigned int p = begin; p < end; ++p)
        {
          double a_p = 0;
          w.for_each(p, [&](const unsigned int place, const double weight) { a_p += weight * values[place]; });
          a[p] = a_p;
        }
      },
      weights);
  }

  template class KeptWeights<2>;
  template class KeptWeights<3>;
} // namespace Talus

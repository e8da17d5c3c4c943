#pragma once

#include <talus/grid/nodal_array.h>
#include <talus/kernels/kernel.h>
#include <talus/particles/working_set.h>

#include <variant>

namespace Talus
{
  /** Products over the axes of n weights each, those of nodes that are not there being 0. */
  template <int dim, unsigned int n>
  struct ProductWeights
  {
    std::vector<std::array<double, dim * n>> weight;
    std::vector<unsigned int>                first; // place of the first node
    std::array<unsigned int, dim>            stride;

    template <class Body>
    [[gnu::always_inline]] void for_each(const unsigned int p, const Body &body) const
    {
      const double *const w = weight[p].data();
      if constexpr (dim == 2)
        for (unsigned int j = 0; j < n; ++j)
          for (unsigned int i = 0; i < n; ++i)
            body(first[p] + i * stride[0] + j * stride[1], w[i] * w[n + j]);
      else
        for (unsigned int k = 0; k < n; ++k)
          for (unsigned int j = 0; j < n; ++j)
          {
            const double yz = w[n + j] * w[2 * n + k];
            for (unsigned int i = 0; i < n; ++i)
              body(first[p] + i * stride[0] + j * stride[1] + k * stride[2], w[i] * yz);
          }
    }
  };

  /** Any number of nodes a particle. */
  struct ListWeights
  {
    std::vector<std::size_t>  begin; // of a particle's list; one more than there are particles
    std::vector<double>       weight;
    std::vector<unsigned int> place;

    template <class Body>
    [[gnu::always_inline]] void for_each(const unsigned int p, const Body &body) const
    {
      for (std::size_t k = begin[p]; k < begin[p + 1]; ++k)
        body(place[k], weight[k]);
    }
  };

  /**
   * The nodes around the particles and their weights at one moment, for sums that follow while particles move: products
   * over the axes of a box grid, without correction at the domain's faces so that none is negative, or lists, without
   * gradients. Test: tests/transfer/f_bar.cc.
   */
  template <int dim>
  class KeptWeights
  {
  public:
    void find(const Kernel<dim> &kernel, const WorkingSet<dim> &particles);

    /** Adds the particles' numbers times their weights to the nodes. */
    void scatter(const double *a, const unsigned int begin, const unsigned int end, NodalArray<1> &nodes) const;

    /** Sets numbers of the particles to the sums of the nodes' numbers times their weights. */
    void gather(const NodalArray<1> &nodes, const unsigned int begin, const unsigned int end, double *a) const;

    /** Sums of each particle's weights: 1 away from the domain's faces. */
    const std::vector<double> &sums() const { return sum; }

  private:
    template <class Function>
    void find_products(const ProductForm<dim> &form, const Function &function, const WorkingSet<dim> &particles);
    void find_lists(const Kernel<dim> &kernel, const WorkingSet<dim> &particles);

    std::variant<ProductWeights<dim, 2>, ProductWeights<dim, 3>, ProductWeights<dim, 4>, ListWeights> weights;

    std::vector<double> sum;
  };
} // namespace Talus

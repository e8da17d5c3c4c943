#pragma once

#include <talus/core/simd.h>

#include <vector>

namespace Talus
{
  /**
   * The nodes of a stencil of any length, each with weight phi_ip [1], offset x_i - x_p [length] and gradient
   * [1/length]. The lists are filled up to whole registers with entries of weight and gradient 0 at the first node, so
   * that loops over registers need no end of their own. Memory grows to what is needed and stays.
   */
  template <int dim>
  struct NodeList
  {
    static constexpr unsigned int width = 8;
    using Lanes                         = Simd<width>;

    unsigned int              size = 0, padded_size = 0;
    std::vector<unsigned int> node; // local numbers
    std::vector<double>       weight;
    std::vector<double>       offset[dim], gradient[dim];

    /** The lists in memory, for loops. */
    struct Arrays
    {
      unsigned int *node;
      double       *weight, *offset[dim], *gradient[dim];
    };

    /** Makes room for n nodes. */
    Arrays resize(const unsigned int n)
    {
      size        = n;
      padded_size = (n + width - 1) / width * width;
      if (node.size() < padded_size)
        grow();
      Arrays arrays;
      arrays.node   = node.data();
      arrays.weight = weight.data();
      for (unsigned int d = 0; d < dim; ++d)
      {
        arrays.offset[d]   = offset[d].data();
        arrays.gradient[d] = gradient[d].data();
      }
      return arrays;
    }

  private:
    void grow()
    {
      node.resize(padded_size);
      weight.resize(padded_size);
      for (unsigned int d = 0; d < dim; ++d)
      {
        offset[d].resize(padded_size);
        gradient[d].resize(padded_size);
      }
    }
  };
} // namespace Talus

#pragma once

#include <talus/core/simd.h>

#include <deal.II/base/aligned_vector.h>

#include <array>

namespace Talus
{
  /**
   * The nodes a particle talks to, as a list of any length: for each its place (see Nodes), weight phi_ip [1], gradient
   * grad phi_ip [1/length] and offset x_i - x_p [length]. A node may be there more than once; all sums are linear in
   * the weights. This is all that list loops know of kernels.
   */
  template <int dim>
  class Stencil
  {
  public:
    static constexpr unsigned int width = 8; // there is always room for whole registers
    using Lanes                         = Simd<width>;

    Stencil() { reserve(16); }

    /** Makes room for n nodes and forgets what there was. */
    void reserve(const unsigned int n)
    {
      size       = 0;
      has_images = false;
      if (n > place.size())
      {
        const unsigned int capacity = (n + 7) / 8 * 8;
        place.resize(capacity);
        beyond.resize(capacity);
        numbers.resize_fast(n_columns * capacity);
        weight = numbers.data();
        for (unsigned int d = 0; d < dim; ++d)
        {
          offset[d]   = weight + (1 + d) * capacity;
          gradient[d] = weight + (1 + dim + d) * capacity;
        }
      }
    }

    static constexpr unsigned int n_columns = 1 + 2 * dim;

    /** The lists in memory, for loops over registers. */
    struct Arrays
    {
      unsigned int             *place;
      double                   *weight;
      std::array<double *, dim> offset, gradient;
      unsigned int              padded_size; // whole registers
    };

    /** Lists n nodes, whatever they are: all arrays have room for whole registers of them. */
    Arrays resize(const unsigned int n)
    {
      reserve(n);
      size = n;
      return {place.data(), weight, offset, gradient, (n + width - 1) / width * width};
    }

    unsigned int                        size = 0;
    dealii::AlignedVector<unsigned int> place;
    double                             *weight;
    std::array<double *, dim>           offset, gradient;

    // Where a treatment mirrors nodes in slip walls.
    bool                                 has_images = false;
    dealii::AlignedVector<unsigned char> beyond; // faces of the box in which the node stands for its mirror image
    std::array<bool, dim>                is_at_slip_wall{}; // nodes are missing along this axis, beyond a slip wall

    Stencil(const Stencil &)            = delete;
    Stencil &operator=(const Stencil &) = delete;
    Stencil(Stencil &&)                 = default;
    Stencil &operator=(Stencil &&)      = default;

  private:
    dealii::AlignedVector<double> numbers; // of all columns
  };
} // namespace Talus

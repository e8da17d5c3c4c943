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

    /** One number of each node: every `stride`-th from the first on. */
    struct Column
    {
      double     *first  = nullptr;
      std::size_t stride = 1;

      double &operator[](const std::size_t k) const { return first[k * stride]; }
    };

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
      }
      set_columns(numbers.data(), place.size(), 1);
    }

    /**
     * Lists n nodes whose numbers somebody else keeps, one particle in each lane of `n_lanes`: register i + j n_registers
     * holds number j of node i, the weight, offsets and gradients in this order; `numbers` is this particle's first one.
     */
    void share(const unsigned int n, double *numbers, const std::size_t n_registers, const std::size_t n_lanes)
    {
      if (n_registers > place.size())
        reserve(n_registers);
      size       = n;
      has_images = false;
      set_columns(numbers, n_registers, n_lanes);
    }

    /** Memory for share(), which the first stencil of a batch keeps for the others. */
    double *keep(const std::size_t n)
    {
      if (n > kept.size())
        kept.resize_fast(n);
      return kept.data();
    }

    static constexpr unsigned int n_columns = 1 + 2 * dim;

    /** The lists in memory, for loops over registers. */
    struct Arrays
    {
      unsigned int           *place;
      double                 *weight;
      std::array<double *, dim> offset, gradient;
      unsigned int            padded_size; // whole registers
    };

    /** Lists n nodes, whatever they are: all arrays have room for whole registers of them. */
    Arrays resize(const unsigned int n)
    {
      reserve(n);
      size = n;
      Arrays arrays{place.data(), weight.first, {}, {}, (n + width - 1) / width * width};
      for (unsigned int d = 0; d < dim; ++d)
      {
        arrays.offset[d]   = offset[d].first;
        arrays.gradient[d] = gradient[d].first;
      }
      return arrays;
    }

    unsigned int                          size = 0;
    dealii::AlignedVector<unsigned int>   place;
    Column                                weight;
    std::array<Column, dim>               offset, gradient; // all columns have one stride

    // Where a treatment mirrors nodes in slip walls.
    bool                                 has_images = false;
    dealii::AlignedVector<unsigned char> beyond; // faces of the box in which the node stands for its mirror image
    std::array<bool, dim> is_at_slip_wall{};     // nodes are missing along this axis, beyond a slip wall

    Stencil(const Stencil &)            = delete;
    Stencil &operator=(const Stencil &) = delete;
    Stencil(Stencil &&)                 = default;
    Stencil &operator=(Stencil &&)      = default;

  private:
    void set_columns(double *first, const std::size_t capacity, const std::size_t stride)
    {
      weight = {first, stride};
      for (unsigned int d = 0; d < dim; ++d)
      {
        offset[d]   = {first + (1 + d) * capacity * stride, stride};
        gradient[d] = {first + (1 + dim + d) * capacity * stride, stride};
      }
    }

    dealii::AlignedVector<double> numbers, kept; // of all columns, and of those of a batch
  };
} // namespace Talus

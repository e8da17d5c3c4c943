#pragma once

#include <talus/core/simd.h>

#include <deal.II/base/aligned_vector.h>

#include <array>
#include <numeric>

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

    /** One number of each node: that of node k is row[k] after the first. */
    struct Column
    {
      double             *first = nullptr;
      const unsigned int *row   = nullptr;

      double &operator[](const std::size_t k) const { return first[row[k]]; }
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
        rows.resize_fast(capacity);
        std::iota(rows.begin(), rows.end(), 0u);
      }
      set_columns(numbers.data(), place.size(), rows.data());
    }

    /**
     * Lists n nodes whose numbers somebody else keeps, for instance those of a batch in the lanes of registers: column
     * j, of the weight, the offsets, the gradients, begins `column` j after `numbers`, and has node k `row[k]` farther
     * on.
     */
    void share(const unsigned int n, double *numbers, const std::size_t column, const unsigned int *row)
    {
      size       = n;
      has_images = false;
      set_columns(numbers, column, row);
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
      Arrays arrays{place.data(), weight.first, {}, {}, (n + width - 1) / width * width};
      for (unsigned int d = 0; d < dim; ++d)
      {
        arrays.offset[d]   = offset[d].first;
        arrays.gradient[d] = gradient[d].first;
      }
      return arrays;
    }

    unsigned int                        size = 0;
    dealii::AlignedVector<unsigned int> place;
    Column                              weight;
    std::array<Column, dim>             offset, gradient; // all columns have the same rows

    // Where a treatment mirrors nodes in slip walls.
    bool                                 has_images = false;
    dealii::AlignedVector<unsigned char> beyond; // faces of the box in which the node stands for its mirror image
    std::array<bool, dim>                is_at_slip_wall{}; // nodes are missing along this axis, beyond a slip wall

    Stencil(const Stencil &)            = delete;
    Stencil &operator=(const Stencil &) = delete;
    Stencil(Stencil &&)                 = default;
    Stencil &operator=(Stencil &&)      = default;

  private:
    void set_columns(double *first, const std::size_t column, const unsigned int *row)
    {
      weight = {first, row};
      for (unsigned int d = 0; d < dim; ++d)
      {
        offset[d]   = {first + (1 + d) * column, row};
        gradient[d] = {first + (1 + dim + d) * column, row};
      }
    }

    dealii::AlignedVector<unsigned int> rows;          // 0, 1, ...
    dealii::AlignedVector<double>       numbers, kept; // of all columns, and of those of a batch
  };
} // namespace Talus

#pragma once

#include <talus/core/simd.h>

#include <utility>

namespace Talus
{
  namespace internal
  {
    /** Lanes block * width .. of a number of more. */
    template <int width, int n>
    [[gnu::always_inline]] inline auto get_part(const Simd<n> &x, const int block)
    {
      if constexpr (Simd<n>::n_part == width)
        return x.part[block];
      else
        return Simd<width>::load(x.data() + block * width).part[0];
    }
    template <int width, int n>
    [[gnu::always_inline]] inline void set_part(Simd<n> &x, const int block,
                                                const typename Register<width>::Double &part)
    {
      if constexpr (Simd<n>::n_part == width)
        x.part[block] = part;
      else
        std::memcpy(reinterpret_cast<char *>(x.part) + block * sizeof(part), &part, sizeof(part));
    }

    /** Exchanges the off-diagonal blocks of size d in two rows of a matrix of registers. */
    template <int d, typename Part, std::size_t... k>
    [[gnu::always_inline]] inline void exchange(Part &a, Part &b, std::index_sequence<k...>)
    {
      constexpr int n     = sizeof...(k);
      const Part    old_a = a;
      a                   = __builtin_shufflevector(old_a, b, (k & d ? n + (k - d) : k)...);
      b                   = __builtin_shufflevector(old_a, b, (k & d ? n + k : k + d)...);
    }

    /** Transposes the blocks of size `block` of n_rows registers, each of n lanes. */
    template <int n, int block, typename Part>
    [[gnu::always_inline]] inline void transpose_blocks(Part *rows)
    {
      if constexpr (block >= 2)
        for (int i = 0; i < block; i += 2)
          exchange<1>(rows[i], rows[i + 1], std::make_index_sequence<n>());
      if constexpr (block >= 4)
        for (int i = 0; i < block; ++i)
          if ((i & 2) == 0)
            exchange<2>(rows[i], rows[i + 2], std::make_index_sequence<n>());
      if constexpr (block >= 8)
        for (int i = 0; i < 4; ++i)
          exchange<4>(rows[i], rows[i + 4], std::make_index_sequence<n>());
    }

    /** Adds the halves of the lanes of n rows, and the quarters, ...: row 0 then holds the sum of each row's lanes. */
    template <int n, int d, typename Part>
    [[gnu::always_inline]] inline void fold_rows(Part *rows)
    {
      if constexpr (d < n)
      {
        for (int i = 0; i < n; i += 2 * d)
        {
          exchange<d>(rows[i], rows[i + d], std::make_index_sequence<n>());
          rows[i] += rows[i + d];
        }
        fold_rows<n, 2 * d>(rows);
      }
    }
  } // namespace internal

  /** From eight numbers of `width` particles, side by side, to one vector of eight for each particle. */
  template <int width>
  [[gnu::always_inline]] inline void lanes_to_vectors(const Simd<width> (&rows)[8], Simd<8> (&columns)[width])
  {
    static_assert(width <= native_width, "a batch must fit a register");
    for (int block = 0; block < 8 / width; ++block)
    {
      typename Simd<width>::Part part[width];
      for (int i = 0; i < width; ++i)
        part[i] = rows[block * width + i].part[0];
      internal::transpose_blocks<width, width>(part);
      for (int l = 0; l < width; ++l)
        internal::set_part<width>(columns[l], block, part[l]);
    }
  }

  /** The sums over the lanes of eight registers, in one vector: what adding all columns of lanes_to_vectors() gives. */
  template <int width>
  [[gnu::always_inline]] inline Simd<8> sums_of_lanes(const Simd<width> (&rows)[8])
  {
    static_assert(width <= native_width, "a batch must fit a register");
    Simd<8> sums;
    for (int block = 0; block < 8 / width; ++block)
    {
      typename Simd<width>::Part part[width];
      for (int i = 0; i < width; ++i)
        part[i] = rows[block * width + i].part[0];
      internal::fold_rows<width, 1>(part);
      internal::set_part<width>(sums, block, part[0]);
    }
    return sums;
  }

  /** The way back: from one vector of n for each of `width` particles to n numbers of all of them. */
  template <int width, int n>
  [[gnu::always_inline]] inline void vectors_to_lanes(const Simd<n> (&columns)[width], Simd<width> (&rows)[n])
  {
    static_assert(width <= native_width && width <= 2 * n, "a batch must fit a register, and half of one a vector");
    using Part = typename Simd<width>::Part;
    if constexpr (width == 2 * n)
    {
      static_assert(n == 4, "the lanes named below");
      Part part[n];
      for (int i = 0; i < n; ++i)
        part[i] = __builtin_shufflevector(columns[i].part[0], columns[i + n].part[0], 0, 1, 2, 3, 4, 5, 6, 7);
      internal::transpose_blocks<width, n>(part);
      for (int i = 0; i < n; ++i)
        rows[i].part[0] = part[i];
    }
    else
      for (int block = 0; block < n / width; ++block)
      {
        Part part[width];
        for (int l = 0; l < width; ++l)
          part[l] = internal::get_part<width>(columns[l], block);
        internal::transpose_blocks<width, width>(part);
        for (int i = 0; i < width; ++i)
          rows[block * width + i].part[0] = part[i];
      }
  }
} // namespace Talus

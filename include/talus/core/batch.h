#pragma once

#include <talus/core/simd.h>

namespace Talus
{
  /** One particle; a loop over these is a plain one. */
  struct SingleBatch
  {
    using Number = double;
    unsigned int p;

    Number       load(const double *column) const { return column[p]; }
    void         store(double *column, const Number &value) const { column[p] = value; }
    unsigned int size() const { return 1; }

    /** The value, with zero in the lanes that hold no particle. */
    Number used_lanes(const Number &value) const { return value; }
  };

  /** Particles p .. p + width - 1, one in each lane. */
  template <int width>
  struct FullBatch
  {
    using Number = Simd<width>;
    unsigned int p;

    Number       load(const double *column) const { return Number::load(column + p); }
    void         store(double *column, const Number &value) const { value.store(column + p); }
    unsigned int size() const { return width; }
    Number       used_lanes(const Number &value) const { return value; }
  };

  /** What is left at the end of a range: n < width particles. Further lanes repeat the last and are not stored. */
  template <int width>
  struct PartialBatch
  {
    using Number = Simd<width>;
    unsigned int p, n;

    Number load(const double *column) const
    {
      Number value;
      for (unsigned int l = 0; l < width; ++l)
        value.set(l, column[p + (l < n ? l : n - 1)]);
      return value;
    }
    void store(double *column, const Number &value) const
    {
      for (unsigned int l = 0; l < n; ++l)
        column[p + l] = value[l];
    }
    unsigned int size() const { return n; }
    Number       used_lanes(Number value) const
    {
      for (unsigned int l = n; l < width; ++l)
        value.set(l, 0.);
      return value;
    }
  };

  /** Calls `body` for batches that cover the particles begin .. end - 1. */
  template <class Body>
  [[gnu::always_inline]] inline void for_each_batch(const unsigned int begin, const unsigned int end, const Body &body)
  {
    constexpr unsigned int width = native_width;
    unsigned int           p     = begin;
    for (; p + width <= end; p += width)
      body(FullBatch<width>{p});
    if (p < end)
      body(PartialBatch<width>{p, end - p});
  }
} // namespace Talus

#pragma once

#include <talus/core/simd_registers.h>

namespace Talus
{
  /**
   * `width` doubles treated as one number, by GCC's vector extensions, which
   * compile for every processor; what is wider than a register is split into
   * several. Operators work lane by lane, comparisons give a mask of the lanes
   * that select() and any() read. Test: tests/core/simd.cc, at all widths.
   */
  template <int width>
  struct Simd
  {
    static constexpr int n_lanes = width;
    static constexpr int n_part  = width < native_width ? width : native_width; // lanes of a part
    static constexpr int n_parts = width / n_part;

    using Part     = typename internal::Register<n_part>::Double;
    using AnyPlace = typename internal::Register<n_part>::AnyPlace; // a part, which needs no alignment
    using Integer  = typename internal::Register<n_part>::Integer;

    /** True (all bits set) or false for each lane. */
    struct Mask
    {
      Integer part[n_parts];

      bool operator[](const int lane) const { return part[lane / n_part][lane % n_part] != 0; }

      friend Mask operator&(Mask a, const Mask &b)
      {
        for (int i = 0; i < n_parts; ++i)
          a.part[i] &= b.part[i];
        return a;
      }
      friend Mask operator|(Mask a, const Mask &b)
      {
        for (int i = 0; i < n_parts; ++i)
          a.part[i] |= b.part[i];
        return a;
      }
      friend Mask operator!(Mask a)
      {
        for (int i = 0; i < n_parts; ++i)
          a.part[i] = ~a.part[i];
        return a;
      }
      friend bool lane(const Mask &a, const int l) { return a[l]; }
      friend bool any(const Mask &a)
      {
        Integer all = a.part[0];
        for (int i = 1; i < n_parts; ++i)
          all |= a.part[i];
        return internal::any_lane(all);
      }
      /** `a` in the lanes where the condition holds, elsewhere `b`. */
      friend Simd select(const Mask &condition, const Simd &a, const Simd &b)
      {
        Simd result;
        for (int i = 0; i < n_parts; ++i)
          result.part[i] = condition.part[i] ? a.part[i] : b.part[i];
        return result;
      }
    };

    Part part[n_parts];

    Simd() = default;
    Simd(const double x)
    {
      for (int i = 0; i < n_parts; ++i)
        part[i] = x - Part{}; // the same x in all lanes
    }

    // Part by part: a compiler may copy memory in smaller pieces, and a register that is read from what has just been
    // written so has to wait for all of them.

    /** The lanes at consecutive places from `x`, which need no alignment. */
    static Simd load(const double *x)
    {
      Simd result;
      for (int i = 0; i < n_parts; ++i)
        result.part[i] = *reinterpret_cast<const AnyPlace *>(x + i * n_part);
      return result;
    }
    void store(double *x) const
    {
      for (int i = 0; i < n_parts; ++i)
        *reinterpret_cast<AnyPlace *>(x + i * n_part) = part[i];
    }

    /** The first `count` doubles from `x`, again and again: lane l is x[l % count]. */
    template <int count>
    [[gnu::always_inline]] static Simd load_repeated(const double *x)
    {
      static_assert(count == 2 || count == 4, "see internal::repeat");
      Simd result;
      for (int i = 0; i < n_parts; ++i)
        internal::repeat<count>(x + i * n_part % count, result.part[i]);
      return result;
    }

    /** The first four lanes, of more. */
    Simd<4> first_four() const { return Simd<4>::load(data()); }

    /** With other numbers in the first four lanes, of more. */
    Simd with_first_four(const Simd<4> &x) const
    {
      Simd result = *this;
      x.store(reinterpret_cast<double *>(result.part));
      return result;
    }

    /** Lane l is x[index[l]]. */
    template <typename Index>
    static Simd gather(const double *x, const Index *index)
    {
      Simd result;
      for (int l = 0; l < width; ++l)
        result.set(l, x[index[l]]);
      return result;
    }

    double operator[](const int lane) const { return part[lane / n_part][lane % n_part]; }
    void   set(const int lane, const double x) { part[lane / n_part][lane % n_part] = x; }

    /** The lanes in memory, for loops over them. */
    const double *data() const { return reinterpret_cast<const double *>(part); }

    friend Simd operator-(Simd a)
    {
      for (int i = 0; i < n_parts; ++i)
        a.part[i] = -a.part[i];
      return a;
    }

#define TALUS_OPERATOR(op, assign)                                                                                     \
  Simd &operator assign(const Simd &other)                                                                             \
  {                                                                                                                    \
    for (int i = 0; i < n_parts; ++i)                                                                                  \
      part[i] = part[i] op other.part[i];                                                                              \
    return *this;                                                                                                      \
  }                                                                                                                    \
  friend Simd operator op(Simd a, const Simd &b)                                                                       \
  {                                                                                                                    \
    a assign b;                                                                                                        \
    return a;                                                                                                          \
  }
    TALUS_OPERATOR(+, +=)
    TALUS_OPERATOR(-, -=)
    TALUS_OPERATOR(*, *=)
    TALUS_OPERATOR(/, /=)
#undef TALUS_OPERATOR

#define TALUS_COMPARISON(op)                                                                                           \
  friend Mask operator op(const Simd &a, const Simd &b)                                                                \
  {                                                                                                                    \
    Mask result;                                                                                                       \
    for (int i = 0; i < n_parts; ++i)                                                                                  \
      result.part[i] = a.part[i] op b.part[i];                                                                         \
    return result;                                                                                                     \
  }
    TALUS_COMPARISON(<)
    TALUS_COMPARISON(<=)
    TALUS_COMPARISON(>)
    TALUS_COMPARISON(>=)
    TALUS_COMPARISON(==)
#undef TALUS_COMPARISON
  };
} // namespace Talus

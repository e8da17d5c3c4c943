#pragma once

#include <cmath>
#include <cstring>
#ifdef __SSE2__
#include <immintrin.h>
#endif

namespace Talus
{
  /** How many doubles the target's vector registers hold. */
#if defined(__AVX512F__)
  constexpr int native_width = 8;
#elif defined(__AVX__)
  constexpr int native_width = 4;
#else
  constexpr int native_width = 2;
#endif

  namespace internal
  {
    template <int n>
    struct Register;
#define TALUS_REGISTER(n)                                                                                              \
  template <>                                                                                                          \
  struct Register<n>                                                                                                   \
  {                                                                                                                    \
    typedef double    Double __attribute__((vector_size(n * sizeof(double))));                                         \
    typedef double    AnyPlace __attribute__((vector_size(n * sizeof(double)), aligned(8), may_alias));                \
    typedef long long Integer __attribute__((vector_size(n * sizeof(double))));                                        \
    typedef int       Index __attribute__((vector_size(n * sizeof(int))));                                             \
  };
    TALUS_REGISTER(1)
    TALUS_REGISTER(2)
    TALUS_REGISTER(4)
    TALUS_REGISTER(8)
#undef TALUS_REGISTER

    // What the vector extensions lack: the largest whole number not above x, and whether a lane's first bit is set.
    template <class Double>
    Double floor_lanes(Double x)
    {
      for (unsigned int l = 0; l < sizeof(x) / sizeof(double); ++l)
        x[l] = std::floor(x[l]);
      return x;
    }
    template <class Integer>
    bool any_lane(const Integer &mask)
    {
      long long result = 0;
      for (unsigned int l = 0; l < sizeof(mask) / sizeof(double); ++l)
        result |= mask[l];
      return result != 0;
    }
    // A register of x[0], ..., x[count - 1], x[0], ...; if it is shorter than that, of its first ones.
    template <int count, class Double>
    [[gnu::always_inline]] inline void repeat(const double *x, Double &result)
    {
      for (unsigned int l = 0; l < sizeof(result) / sizeof(double); ++l)
        result[l] = x[l % count];
    }
#ifdef __SSE2__
    inline bool any_lane(const Register<2>::Integer &mask) { return _mm_movemask_pd((__m128d) mask) != 0; }
#endif
#ifdef __SSE4_1__
    inline Register<2>::Double floor_lanes(const Register<2>::Double x) { return _mm_floor_pd(x); }
#endif
#ifdef __AVX__
    inline bool any_lane(const Register<4>::Integer &mask) { return _mm256_movemask_pd((__m256d) mask) != 0; }
    inline Register<4>::Double floor_lanes(const Register<4>::Double x) { return _mm256_floor_pd(x); }
#endif
#ifdef __AVX__
    template <>
    [[gnu::always_inline]] inline void repeat<2>(const double *x, Register<4>::Double &result)
    {
      result = _mm256_broadcast_pd(reinterpret_cast<const __m128d *>(x)); // needs no alignment
    }
    template <>
    [[gnu::always_inline]] inline void repeat<4>(const double *x, Register<4>::Double &result)
    {
      result = _mm256_loadu_pd(x);
    }
#endif
#ifdef __AVX512DQ__
    // The forms without a mask warn of an uninitialized value in GCC 12.
    template <>
    [[gnu::always_inline]] inline void repeat<2>(const double *x, Register<8>::Double &result)
    {
      result = _mm512_maskz_broadcast_f64x2(0xff, _mm_loadu_pd(x));
    }
    template <>
    [[gnu::always_inline]] inline void repeat<4>(const double *x, Register<8>::Double &result)
    {
      result = _mm512_maskz_broadcast_f64x4(0xff, _mm256_loadu_pd(x));
    }
#endif
#ifdef __AVX512F__
    inline bool any_lane(const Register<8>::Integer &mask)
    {
      return _mm512_test_epi64_mask((__m512i) mask, (__m512i) mask) != 0;
    }
    inline Register<8>::Double floor_lanes(const Register<8>::Double x)
    {
      // The form without a mask warns of an uninitialized value in GCC 12.
      return _mm512_mask_roundscale_pd(x, 0xff, x, _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC);
    }
#endif
  } // namespace internal

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

  // Plain numbers know the same words, so that a formula can be written once for both.
  inline double select(const bool condition, const double a, const double b) { return condition ? a : b; }
  template <int width>
  Simd<width> select(const bool condition, const Simd<width> &a, const Simd<width> &b)
  {
    return condition ? a : b;
  }
  inline bool   any(const bool condition) { return condition; }
  inline double min(const double a, const double b) { return a < b ? a : b; }
  inline double max(const double a, const double b) { return a > b ? a : b; }
  inline double abs(const double a) { return std::abs(a); }

  // One lane of a number or of a mask.
  inline double lane(const double value, const int) { return value; }
  inline bool   lane(const bool value, const int) { return value; }
  inline void   set_lane(double &value, const int, const double x) { value = x; }
  template <int width>
  double lane(const Simd<width> &value, const int l)
  {
    return value[l];
  }
  template <int width>
  void set_lane(Simd<width> &value, const int l, const double x)
  {
    value.set(l, x);
  }

  template <int width>
  Simd<width> min(const Simd<width> &a, const Simd<width> &b)
  {
    return select(a < b, a, b);
  }
  template <int width>
  Simd<width> max(const Simd<width> &a, const Simd<width> &b)
  {
    return select(a > b, a, b);
  }
  template <int width>
  Simd<width> abs(const Simd<width> &a)
  {
    return max(a, -a);
  }

  /** The result of a function of one number in every lane. */
  template <int width, typename Function>
  Simd<width> apply(const Simd<width> &a, const Function &function)
  {
    Simd<width> result;
    for (int l = 0; l < width; ++l)
      result.set(l, function(a[l]));
    return result;
  }

#if defined(__x86_64__) && defined(__GLIBC__)
  // The vector functions of the C library (libmvec); their names say target, width and arguments.
#define TALUS_VECTOR_FUNCTION(name)                                                                                    \
  extern "C" internal::Register<2>::Double _ZGVbN2v_##name(internal::Register<2>::Double);                             \
  TALUS_WIDER_FUNCTIONS(name)                                                                                          \
  template <int width>                                                                                                 \
  Simd<width> name(Simd<width> a)                                                                                      \
  {                                                                                                                    \
    if constexpr (width == 1)                                                                                          \
      return apply(a, [](const double x) { return std::name(x); });                                                    \
    else                                                                                                               \
      for (int i = 0; i < a.n_parts; ++i)                                                                              \
        a.part[i] = vector_##name(a.part[i]);                                                                          \
    return a;                                                                                                          \
  }                                                                                                                    \
  inline double name(const double x) { return std::name(x); }
#if defined(__AVX512F__)
#define TALUS_WIDER_FUNCTIONS(name)                                                                                      \
  extern "C" internal::Register<4>::Double _ZGVdN4v_##name(internal::Register<4>::Double);                               \
  extern "C" internal::Register<8>::Double _ZGVeN8v_##name(internal::Register<8>::Double);                               \
  inline internal::Register<2>::Double     vector_##name(internal::Register<2>::Double x) { return _ZGVbN2v_##name(x); } \
  inline internal::Register<4>::Double     vector_##name(internal::Register<4>::Double x) { return _ZGVdN4v_##name(x); } \
  inline internal::Register<8>::Double     vector_##name(internal::Register<8>::Double x) { return _ZGVeN8v_##name(x); }
#elif defined(__AVX2__)
#define TALUS_WIDER_FUNCTIONS(name)                                                                                      \
  extern "C" internal::Register<4>::Double _ZGVdN4v_##name(internal::Register<4>::Double);                               \
  inline internal::Register<2>::Double     vector_##name(internal::Register<2>::Double x) { return _ZGVbN2v_##name(x); } \
  inline internal::Register<4>::Double     vector_##name(internal::Register<4>::Double x) { return _ZGVdN4v_##name(x); }
#elif defined(__AVX__)
#define TALUS_WIDER_FUNCTIONS(name)                                                                                      \
  extern "C" internal::Register<4>::Double _ZGVcN4v_##name(internal::Register<4>::Double);                               \
  inline internal::Register<2>::Double     vector_##name(internal::Register<2>::Double x) { return _ZGVbN2v_##name(x); } \
  inline internal::Register<4>::Double     vector_##name(internal::Register<4>::Double x) { return _ZGVcN4v_##name(x); }
#else
#define TALUS_WIDER_FUNCTIONS(name)                                                                                    \
  inline internal::Register<2>::Double vector_##name(internal::Register<2>::Double x) { return _ZGVbN2v_##name(x); }
#endif
#else
#define TALUS_VECTOR_FUNCTION(name)                                                                                    \
  template <int width>                                                                                                 \
  Simd<width> name(const Simd<width> &a)                                                                               \
  {                                                                                                                    \
    return apply(a, [](const double x) { return std::name(x); });                                                      \
  }                                                                                                                    \
  inline double name(const double x) { return std::name(x); }
#endif
  TALUS_VECTOR_FUNCTION(log)
  TALUS_VECTOR_FUNCTION(exp)
#undef TALUS_VECTOR_FUNCTION
#undef TALUS_WIDER_FUNCTIONS

  template <int width>
  Simd<width> sqrt(const Simd<width> &a)
  {
    return apply(a, [](const double x) { return __builtin_sqrt(x); });
  }
  inline double sqrt(const double x) { return std::sqrt(x); }

  /** The largest whole number not above x in each lane. */
  template <int width>
  Simd<width> floor(Simd<width> x)
  {
    for (int i = 0; i < x.n_parts; ++i)
      x.part[i] = internal::floor_lanes(x.part[i]);
    return x;
  }

  /** Whole numbers, |x| < 2^31, as integers. */
  template <int width>
  void store_integers(const Simd<width> &x, int *integers)
  {
    using Index = typename internal::Register<Simd<width>::n_part>::Index;
    for (int i = 0; i < x.n_parts; ++i)
    {
      const Index whole = __builtin_convertvector(x.part[i], Index);
      std::memcpy(integers + i * x.n_part, &whole, sizeof(whole));
    }
  }
} // namespace Talus

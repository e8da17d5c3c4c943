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
} // namespace Talus

#pragma once

#include <talus/core/simd_number.h>

#include <cmath>
#include <cstring>

namespace Talus
{
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

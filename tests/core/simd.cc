#include <talus/core/batch.h>
#include <talus/core/tensors.h>
#include <talus/core/transpose.h>

#include "../check.h"

#include <limits>
#include <type_traits>

using namespace Talus;
using namespace Test;

namespace
{
  const double numbers[16] = {1.5, -2.25, 0., 3., 1e10, -1e-10, 7., 0.1, -1., 5., 2., 2., 8., -3.5, 4., 0.6};

  /** All that can be done with numbers of one width, lane by lane. */
  template <int width>
  struct AtWidth
  {
    using Number = Simd<width>;

    void check_all() const
    {
      arithmetic();
      functions();
      selections();
      rounding();
      conditions();
      lanes();
      not_a_number();
      if constexpr (width > 1 && width <= native_width)
      {
        transposes();
        sums();
      }
      repeated_loads();
      tensors();
    }

  private:
    template <class Expected>
    void check_lanes(const std::string &what, const Number &value, const Expected &expected, const double bound) const
    {
      double error = 0;
      for (int l = 0; l < width; ++l)
      {
        const double e = expected(numbers[l], numbers[8 + l]);
        error          = std::max(error, std::abs(value[l] - e) / std::max(1., std::abs(e)));
      }
      check(name + what, error, bound);
    }

    void arithmetic() const
    {
      check_lanes(
        "a + b", a + b, [](double x, double y) { return x + y; }, 1e-300);
      check_lanes(
        "a - 2", a - 2., [](double x, double) { return x - 2; }, 1e-300);
      check_lanes(
        "3 a", 3. * a, [](double x, double) { return 3 * x; }, 1e-300);
      check_lanes(
        "a / b", a / b, [](double x, double y) { return x / y; }, 1e-300);
      check_lanes(
        "-a", -a, [](double x, double) { return -x; }, 1e-300);
      // Contracted to one instruction or not, it is correct to one unit in the last place of its terms.
      check_lanes(
        "a b + a", a * b + a, [](double x, double y) { return x * y + x; }, 2 * ulp);
      check_lanes(
        "min", min(a, b), [](double x, double y) { return std::min(x, y); }, 1e-300);
      check_lanes(
        "max", max(a, b), [](double x, double y) { return std::max(x, y); }, 1e-300);
      check_lanes(
        "abs", abs(a), [](double x, double) { return std::abs(x); }, 1e-300);
      check_lanes(
        "sqrt", sqrt(abs(a)), [](double x, double) { return std::sqrt(std::abs(x)); }, 1e-300);
    }

    void functions() const
    {
      // The C library's vector functions promise four units in the last place.
      check_lanes(
        "log", log(abs(a) + 1e-20), [](double x, double) { return std::log(std::abs(x) + 1e-20); }, 4 * ulp);
      check_lanes(
        "exp", exp(b), [](double, double y) { return std::exp(y); }, 4 * ulp);
    }

    void selections() const
    {
      check_lanes(
        "select", select(a < b, a, b), [](double x, double y) { return x < y ? x : y; }, 1e-300);
      check_lanes(
        "select of and, or, not", select(((a < b) & (a > Number(0.))) | !(b >= Number(0.)), a, b),
        [](double x, double y) { return (x < y && x > 0) || !(y >= 0) ? x : y; }, 1e-300);
    }

    void rounding() const
    {
      int          index[width];
      const double steps[8] = {1.5, -0.25, -1., 0., 7.999, -3.0001, 2., -0.999};
      const Number whole    = floor(Number::load(steps));
      store_integers(whole, index);
      double wrong = 0;
      for (int l = 0; l < width; ++l)
        wrong += (whole[l] != std::floor(steps[l])) + (index[l] != static_cast<int>(std::floor(steps[l])));
      check(name + "floor", wrong, 0.5);
    }

    void conditions() const
    {
      double wrong = any(a < a) + !any(a <= a);
      for (int l = 0; l < width; ++l)
      {
        Number one = 0.;
        one.set(l, -1.);
        wrong += !any(one < Number(0.)) + any(one > Number(0.));
      }
      check(name + "any", wrong, 0.5);
      wrong = 0;
      for (int l = 0; l < width; ++l)
        wrong += select(true, a, a + 1.)[l] != a[l] || select(false, a, a + 1.)[l] != a[l] + 1.;
      check(name + "select by one condition", wrong, 0.5);
    }

    void lanes() const
    {
      int wanted[width];
      for (int l = 0; l < width; ++l)
        wanted[l] = (3 * l + 5) % 16;
      double       wrong    = 0;
      const Number gathered = Number::gather(numbers, wanted);
      for (int l = 0; l < width; ++l)
        wrong += gathered[l] != numbers[wanted[l]] || lane(gathered, l) != gathered.data()[l];
      check(name + "gather, lanes", wrong, 0.5);
    }

    void not_a_number() const
    {
      Number with_nan = a;
      with_nan.set(width - 1, std::numeric_limits<double>::quiet_NaN());
      check_true(name + "NaN fails comparisons", any(!(with_nan <= Number(1e300))) && !any(!(a <= Number(1e300))));
      check_true(name + "any", any(a > Number(1.)) && !any(a > Number(1e11)));
    }

    void transposes() const
    {
      double matrix[64], error = 0;
      for (int i = 0; i < 64; ++i)
        matrix[i] = i;
      Number  rows[8], four[4];
      Simd<8> columns[width];
      Simd<4> vectors[width];
      for (int i = 0; i < 8; ++i)
        rows[i] = Number::load(matrix + i * width);
      lanes_to_vectors<width>(rows, columns);
      for (int l = 0; l < width; ++l)
      {
        for (int i = 0; i < 8; ++i)
          error += columns[l][i] != matrix[i * width + l];
        vectors[l] = Simd<4>::load(matrix + 4 * l);
      }
      vectors_to_lanes<width>(vectors, four);
      for (int l = 0; l < width; ++l)
        for (int i = 0; i < 4; ++i)
          error += four[i][l] != matrix[4 * l + i];
      Number back[8];
      vectors_to_lanes<width>(columns, back);
      for (int i = 0; i < 8; ++i)
        for (int l = 0; l < width; ++l)
          error += back[i][l] != rows[i][l];
      check(name + "transposes", error, 0.5);
    }

    void sums() const
    {
      double matrix[64], error = 0;
      for (int i = 0; i < 64; ++i)
        matrix[i] = i;
      Number rows[8];
      for (int i = 0; i < 8; ++i)
        rows[i] = Number::load(matrix + i * width);
      const Simd<8> found = sums_of_lanes<width>(rows); // of whole numbers, exact
      for (int i = 0; i < 8; ++i)
      {
        double expected = 0;
        for (int l = 0; l < width; ++l)
          expected += rows[i][l];
        error += found[i] != expected;
      }
      check(name + "sums of lanes", error, 0.5);
    }

    /** A few numbers over and over, and the first four lanes alone. */
    void repeated_loads() const
    {
      double     error = 0;
      const auto pairs = Number::template load_repeated<2>(numbers + 1),
                 fours = Number::template load_repeated<4>(numbers);
      for (int l = 0; l < width; ++l)
        error += (pairs[l] != numbers[1 + l % 2]) + (fours[l] != numbers[l % 4]);
      if constexpr (width >= 4)
      {
        const auto replaced = Number::load(numbers).with_first_four(Simd<4>(-1.));
        for (int l = 0; l < width; ++l)
          error += replaced[l] != (l < 4 ? -1. : numbers[l]);
        for (int l = 0; l < 4; ++l)
          error += Number::load(numbers).first_four()[l] != numbers[l];
      }
      check(name + "repeated loads", error, 0.5);
    }

    void tensors() const
    {
      // deal.II's tensors of these numbers are one tensor a lane.
      dealii::Tensor<2, 3, Number> A;
      dealii::Tensor<2, 3>         A_last;
      for (int i = 0; i < 9; ++i)
      {
        A[i / 3][i % 3]      = Number::load(numbers + i % 8);
        A_last[i / 3][i % 3] = numbers[i % 8 + width - 1];
      }
      check(name + "determinant of a tensor", (determinant(A)[width - 1] - determinant(A_last)) / 1e21, 1e-14);
      check(name + "product of tensors",
            ((A * transpose(A))[1][2][width - 1] - (A_last * transpose(A_last))[1][2]) / 1e21, 1e-14);
    }

    const double      ulp  = std::numeric_limits<double>::epsilon();
    const std::string name = "width " + std::to_string(width) + ": ";
    const Number      a = Number::load(numbers), b = Number::load(numbers + 8);
  };
} // namespace

void simd()
{
  AtWidth<1>().check_all();
  AtWidth<2>().check_all();
  AtWidth<4>().check_all();
  AtWidth<8>().check_all();
}

/** Batches cover a range once, and what lies beyond it stays as it was. */
void batches()
{
  constexpr unsigned int size = 40;
  for (const unsigned int begin : {0u, 3u})
    for (unsigned int end = begin; end < 30; ++end)
    {
      double       column[size], sum = 0, expected = 0;
      unsigned int n = 0;
      for (unsigned int p = 0; p < size; ++p)
        column[p] = p;
      for_each_batch(begin, end, [&](const auto batch) {
        const auto value = batch.load(column);
        n += batch.size();
        const auto used = batch.used_lanes(value);
        for (int l = 0; l < used.n_lanes; ++l)
          sum += used[l];
        batch.store(column, value + 100.);
      });
      double wrong = n != end - begin;
      for (unsigned int p = 0; p < size; ++p)
      {
        const bool is_in = p >= begin && p < end;
        wrong += column[p] != p + (is_in ? 100. : 0.);
        expected += is_in ? p : 0;
      }
      if (wrong + std::abs(sum - expected) > 0)
        check("particles " + std::to_string(begin) + " to " + std::to_string(end), wrong + sum - expected, 0.5);
    }
  check_true("all ranges", Test::n_failed == 0);
}

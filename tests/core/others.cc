#include <talus/core/reduction.h>

#include "../setup.h"

using namespace Test;
using namespace dealii;

namespace
{
  template <int dim>
  void expressions_in()
  {
    const std::string more = dim == 3 ? "; z" : "";
    ParsedVector<dim> f;
    f.initialize("x + 2*t; sin(pi*y)" + more, "/Run", "Body force");
    Point<dim> x;
    for (unsigned int d = 0; d < dim; ++d)
      x[d] = 0.1 + 0.2 * d;
    const auto v = f.value(x, 3.);
    check("x + 2 t", v[0] - 6.1, 1e-15);
    check("sin(pi y)", v[1] - std::sin(0.3 * numbers::PI), 1e-15);
    check("last component", v[dim - 1] - (dim == 3 ? 0.5 : v[1]), 1e-15);
    check_true("varies", f.depends_on_space() && !f.is_zero());
    f.initialize("0; 0." + std::string(dim == 3 ? "; 0" : ""), "/Run", "Body force");
    check_true("zero", !f.depends_on_space() && f.is_zero());
    f.initialize("exp(t); max(1, 2)" + std::string(dim == 3 ? "; 0" : ""), "/Run", "Body force");
    check_true("x in exp and max is no variable", !f.depends_on_space() && !f.is_zero());

    const auto error = [](const std::string &name, const std::string &text, const std::string &message) {
      check_error<EntryError>(name, {"/Run: Body force: ", message}, [&] {
        ParsedVector<dim> g;
        g.initialize(text, "/Run", "Body force");
      });
    };
    error("too few", "1", "expected " + std::to_string(dim) + " expressions separated by ';', found 1");
    error("too many", "1; 2; 3; 4", "found 4");
    error("unknown name", "1; speed" + more, "cannot understand");
    error("no expression", "1; 2 +" + more, "cannot understand");
    error("open bracket", "1; sin(x" + more, "cannot understand");

    // What has no finite value is told of with formula, place and time, when it is evaluated there.
    f.initialize("1; sqrt(1 - t)" + more, "/Run", "Body force");
    check("finite until then", f.value(x, 0.75)[1] - 0.5, 1e-15);
    const std::string formula = "the formula '1; sqrt(1 - t)" + more + "' has no finite value";
    check_error<EntryError>("no value at a time", {"/Run: Body force: " + formula, "at t = 1.5"},
                            [&] { f.value(x, 1.5); });
    f.initialize("1/(x - 0.1); 1" + more, "/Run", "Body force");
    check_error<EntryError>("no value at a place", {"has no finite value at (0.1, 0.3", "at t = 2"},
                            [&] { f.value(x, 2); });
    check_true("evaluated all the same", std::isinf(f.evaluate(x, 2)[0]));
  }
} // namespace

void expressions()
{
  expressions_in<2>();
  expressions_in<3>();
  ParsedScalar<3> scalar;
  scalar.initialize("2 * x - z + t", "/Obstacles/bed", "Formula");
  check("one number", scalar.value({1., 5., 0.25}, 0.5) - 2.25, 1e-15);
  check_true("that depends on space", scalar.depends_on_space() && !scalar.is_zero());
  check_error<EntryError>("two numbers", {"/Run: Formula: ", "one number"},
                          [] { ParsedScalar<2>().initialize("x; y", "/Run", "Formula"); });
  scalar.initialize("1 / x", "/Obstacles/bed", "Formula");
  check_error<EntryError>("none", {"has no finite value at (0, 0, 0), t = 0.5"}, [&] { scalar.value({}, 0.5); });
  check_true("whole word", uses_variable("2*x+1", "x") && !uses_variable("exp(2)", "x") && !uses_variable("xy", "x"));
}

/** Maxima and sums in one message; also for none of a kind and for infinities. */
void reduction()
{
  const double rank    = Utilities::MPI::this_mpi_process(MPI_COMM_WORLD),
               n       = Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
  double       highest = rank, lowest = -rank, far = -1e300, one = 1.;
  bool         is_last = rank + 1 == n, never = false;
  Tensor<1, 2> vector;
  vector[0]                   = rank;
  vector[1]                   = 0.25;
  std::vector<double> numbers = {2., -rank};

  const Communicator communicator(MPI_COMM_WORLD);
  Reduction          all;
  all.sum(one);
  all.max(highest);
  all.any(is_last);
  all.sum(vector);
  all.max(lowest);
  all.any(never);
  all.max(far);
  all.sum(numbers);
  all.run(communicator);
  check_true("maxima", highest == n - 1 && lowest == 0 && far == -1e300);
  check_true("flags", is_last && !never);
  check_true("sums", one == n && numbers == std::vector<double>{2 * n, -n * (n - 1) / 2});
  check_true("of vectors", vector[0] == n * (n - 1) / 2 && vector[1] == 0.25 * n);
  check_true("one message", communicator.traffic().messages == (n > 1 ? 1 : 0));

  one = 2.;
  Reduction sums, maxima;
  sums.sum(one);
  sums.run(communicator);
  check_true("sums alone", one == 2 * n);
  maxima.max(one);
  maxima.run(communicator);
  check_true("maxima alone", one == 2 * n);
}

/** Copies of a communicator count together, others apart. */
void traffic()
{
  const Communicator communicator(MPI_COMM_WORLD), copy = communicator, other(MPI_COMM_WORLD);
  communicator.sent(100);
  copy.sent(20);
  check_true("messages", communicator.traffic().messages == 2 && communicator.traffic().bytes == 120);
  check_true("of one run alone", other.traffic().messages == 0);
  check("stands for MPI_Comm", Utilities::MPI::n_mpi_processes(copy) - sum(1.), 0.5);
}

/** Numbers are read when a row is asked for. */
void table()
{
  double       number = 1;
  Tensor<1, 2> vector;
  Talus::Table table;
  table.add("number", "length", number);
  table.add("vector", "force", vector);
  table.add("square", "area", [&number] { return number * number; });
  number    = 3;
  vector[1] = -2;
  check_true("row", table.row() == std::vector<double>{3, 0, -2, 9});
  std::string names;
  for (const auto &column : table.columns())
    names += column.name + " [" + column.unit + "], ";
  check_true("columns", names == "number [length], vector x [force], vector y [force], square [area], ");
}

void registry()
{
  auto  parameters = Parameters::from_text("");
  auto &kernels    = Registry<Kernel<2>>::get();
  check_error<InputError>("unknown", {"Nothing is registered as 'quartic'"},
                          [&] { kernels.make("quartic", parameters, "/Kernel"); });
  check_true("selection", kernels.selection() == "C1 UMLS|CPDI|P1|UMLS|cubic B-spline|linear|quadratic B-spline|uGIMP");
  bool is_rejected = false;
  try
  {
    kernels.add("linear", "", {});
  }
  catch (const ExceptionBase &)
  {
    is_rejected = true;
  }
  check_true("registered twice", is_rejected);
  for (const auto &entry : kernels.all())
    check_true("help of " + entry.first, !entry.second.help.empty());
}

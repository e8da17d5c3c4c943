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
  }
} // namespace

void expressions()
{
  expressions_in<2>();
  expressions_in<3>();
  check_true("whole word", uses_variable("2*x+1", "x") && !uses_variable("exp(2)", "x") && !uses_variable("xy", "x"));
}

/** Maxima and sums in one message; also for none of a kind and for infinities. */
void reduction()
{
  const double rank          = Utilities::MPI::this_mpi_process(MPI_COMM_WORLD),
               n             = Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
  std::vector<double> maxima = {rank, -rank, -1e300}, sums = {1., rank, 0.25};
  reduce(maxima, sums, MPI_COMM_WORLD);
  check_true("maxima", maxima == std::vector<double>{n - 1, 0., -1e300});
  check_true("sums", sums == std::vector<double>{n, n * (n - 1) / 2, 0.25 * n});
  std::vector<double> none, one = {2.};
  reduce(none, one, MPI_COMM_WORLD);
  check_true("sums alone", none.empty() && one[0] == 2 * n);
  reduce(one, none, MPI_COMM_WORLD);
  check_true("maxima alone", none.empty() && one[0] == 2 * n);
}

void registry()
{
  auto &kernels = Registry<Kernel<2>>::get();
  check_error<InputError>("unknown", {"Nothing is registered as 'quartic'"},
                          [&] { kernels.make("quartic", "/Kernel"); });
  check_true("selection", kernels.selection() == "cubic B-spline|linear|quadratic B-spline|uGIMP");
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

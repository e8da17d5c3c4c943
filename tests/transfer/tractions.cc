#include "transfer.h"

using namespace Test;
using namespace dealii;

namespace
{
  const std::vector<std::string> kernels = {"linear", "quadratic B-spline", "cubic B-spline", "uGIMP"};

  constexpr double lower[] = {0.05, 0.9, 0.6}, upper[] = {0.4, 1.1, 0.8};

  /** A body inside of a skewed grid, which it meets at no face of a cell, and what was asked of its surface. */
  template <int dim>
  struct LoadedBody
  {
    LoadedBody(const std::string &kernel, const std::string &load) :
      setup(text(kernel) + section("Tractions", set("Names", "load") + section("load", load))),
      traction(*setup.tractions.loads[0])
    {
    }

    static std::string text(const std::string &kernel)
    {
      const std::array<int, 3> cells = {{10, 8, 8}};
      return skewed_grid<dim>(cells) + kernel_text(kernel, "WLS") + transfer_text("TPIC") +
             box_body<dim>({{lower[0], lower[1], lower[2]}}, {{upper[0], upper[1], upper[2]}}, 0.3);
    }

    /** A point of the body after deform(). */
    static Point<dim> moved(const Point<dim> &X)
    {
      Point<dim> x;
      for (unsigned int d = 0; d < dim; ++d)
        x[d] = X[d] + 0.03 * (d + 1);
      return Point<dim>(x + 0.2 * (some_gradient<dim>() * (X - centre())));
    }
    static Tensor<2, dim> A() { return Tensor<2, dim>(unit_symmetric_tensor<dim>()) + 0.2 * some_gradient<dim>(); }

    static Point<dim> centre()
    {
      Point<dim> x;
      for (unsigned int d = 0; d < dim; ++d)
        x[d] = (lower[d] + upper[d]) / 2;
      return x;
    }

    /** Deforms the body evenly; particles change ranks. */
    void deform()
    {
      auto &particles = setup.particles;
      for (unsigned int p = 0; p < particles.size(); ++p)
      {
        const Point<dim> x = moved(setup.position(p));
        for (unsigned int d = 0; d < dim; ++d)
          particles.component(particles.position, d)[p] = x[d];
        for (unsigned int c = 0; c < dim * dim; ++c)
          particles.component(particles.F, c)[p] = A()[c / dim][c % dim];
      }
      particles.synchronise();
    }

    /** The sums over the nodes of f_i and f_i (x) x_i that the load makes. */
    std::pair<Tensor<1, dim>, Tensor<2, dim>> sums(const double time)
    {
      setup.grid.clear();
      traction.apply(setup.particles, *setup.kernel, time, setup.grid);
      setup.grid.fields.add_copies_to_owners();
      Tensor<1, dim> force;
      Tensor<2, dim> moment;
      for (unsigned int i = 0; i < setup.grid.fields.n_owned(); ++i)
      {
        const auto f = node_vector(setup, i, NodalFields<dim>::force);
        force += f;
        moment += outer_product(f, Tensor<1, dim>(setup.grid.node_position(i)));
      }
      return {Utilities::MPI::sum(force, MPI_COMM_WORLD), Utilities::MPI::sum(moment, MPI_COMM_WORLD)};
    }

    Setup<dim>     setup;
    Traction<dim> &traction;
  };

  template <int dim>
  double volume()
  {
    double V = 1;
    for (unsigned int d = 0; d < dim; ++d)
      V *= upper[d] - lower[d];
    return V;
  }
} // namespace

namespace
{
  /** -p da over the whole surface: no force, moment -p V I. */
  template <int dim>
  void check_pressure(const std::string &kernel)
  {
    LoadedBody<dim> body(kernel, set("Type", "pressure") + set("Pressure", "3*t"));
    body.deform();
    const auto           sums = body.sums(0.5);
    const double         V    = volume<dim>() * determinant(body.A());
    const Tensor<2, dim> I    = unit_symmetric_tensor<dim>();
    check(kernel + ": pressure: force", sums.first.norm(), 1e-14);
    check(kernel + ": pressure: moment", (sums.second + 1.5 * V * I).norm(), 1e-14);
  }

  /** p = 2 - 5 y: buoyancy 5 V. */
  template <int dim>
  void check_buoyancy(const std::string &kernel)
  {
    LoadedBody<dim> body(kernel, set("Type", "pressure") + set("Pressure", "2 - 5*y") + set("Faces", "all"));
    body.deform();
    Tensor<1, dim> error = body.sums(0.).first;
    error[1] -= 5 * volume<dim>() * determinant(body.A());
    check(kernel + ": buoyancy", error.norm(), 1e-14);
    check(kernel + ": recorded force", (Utilities::MPI::sum(body.traction.force, MPI_COMM_WORLD) - error)[0], 1e-14);
  }

  /** An even traction on a face acts in the middle of the deformed face. */
  template <int dim>
  void check_even_traction(const std::string &kernel)
  {
    const std::string third = dim == 3 ? "; 2*t" : "";
    LoadedBody<dim>   body(kernel, set("Type", "traction") + set("Traction", "3; -t" + third) + set("Faces", "x+") +
                                     set("Points per cell edge", "3"));
    body.deform();
    const auto     sums = body.sums(0.5);
    Tensor<1, dim> force;
    force[0] = 3, force[1] = -0.5, force[dim - 1] += dim == 3 ? 1. : 0.;
    force *= volume<dim>() / (upper[0] - lower[0]);
    Point<dim> middle = body.centre();
    middle[0]         = upper[0];
    middle            = body.moved(middle);
    check(kernel + ": traction: force", (sums.first - force).norm(), 1e-14);
    check(kernel + ": traction: moment", (sums.second - outer_product(force, Tensor<1, dim>(middle))).norm(), 1e-14);
  }

  /** A traction that depends on the place, (x, 0), on the part of a face with y < 1, evenly deformed. */
  template <int dim>
  void check_traction_on_part(const std::string &kernel)
  {
    LoadedBody<dim> body(kernel, set("Traction", dim == 2 ? "x; 0" : "x; 0; 0") + set("Faces", "x-, x+") +
                                   set("Lower corner", coordinates<dim>({{0, 0, 0}})) +
                                   set("Upper corner", coordinates<dim>({{1, 1, 1}})) +
                                   set("Points per cell edge", "8"));
    body.deform();
    double length = 0;
    for (const double x : {lower[0], upper[0]})
    {
      Point<dim> middle = body.centre();
      middle[0]         = x;
      middle[1]         = (lower[1] + 1) / 2;
      length += body.moved(middle)[0] * (1 - lower[1]) * (dim == 3 ? upper[2] - lower[2] : 1.);
    }
    check(kernel + ": part of a face", body.sums(0).first[0] - length, 1e-14);
  }

  template <int dim>
  void check_point_force(const std::string &kernel)
  {
    LoadedBody<dim> body(kernel, set("Type", "force") + set("Force", dim == 2 ? "2; x" : "2; x; 0") +
                                   set("Position", coordinates<dim>({{0.21, 1.06, 0.7}})));
    body.deform();
    const auto sums = body.sums(0);
    Point<dim> x;
    x[0] = 0.21, x[1] = 1.06;
    if (dim == 3)
      x[dim - 1] = 0.7;
    x = body.moved(x);
    Tensor<1, dim> force;
    force[0] = 2, force[1] = x[0];
    check(kernel + ": point force", (sums.first - force).norm(), 1e-14);
    check(kernel + ": its place", (sums.second - outer_product(force, Tensor<1, dim>(x))).norm(), 1e-14);
  }
} // namespace

/**
 * Force and moment about the origin of loads on a body that is deformed evenly, by the divergence theorem. What the
 * points integrate is at most linear, and a mid-point rule is exact.
 */
template <int dim>
void traction_sums()
{
  for (const auto &kernel : kernels)
  {
    check_pressure<dim>(kernel);
    check_buoyancy<dim>(kernel);
    check_even_traction<dim>(kernel);
    check_traction_on_part<dim>(kernel);
    check_point_force<dim>(kernel);
  }
}

/** The load's work on its points is that of the nodal forces on the nodes: dt sum f_i . v_i = sum m_i dv_i . v_i. */
template <int dim>
void traction_work()
{
  LoadedBody<dim> body("quadratic B-spline", set("Type", "pressure") + set("Pressure", "-1 - y"));
  body.deform();
  auto &setup     = body.setup;
  auto &particles = setup.particles;
  randomize_motion(setup);
  const double dt = 1e-2;
  setup.scatter();
  body.traction.apply(particles, *setup.kernel, 0., setup.grid);
  setup.grid.fields.add_copies_to_owners();
  setup.grid.update_velocity(dt);
  setup.grid.fields.update_copies();
  double work = 0;
  for (unsigned int i = 0; i < setup.grid.fields.n_owned(); ++i)
    work += setup.grid.fields[i][NodalFields<dim>::mass] *
            (node_vector(setup, i, NodalFields<dim>::increment) * node_vector(setup, i, NodalFields<dim>::velocity));
  setup.transfer->grid_to_particle(setup.grid, *setup.kernel, dt, particles);
  for (unsigned int p = 0; p < particles.size(); ++p)
  {
    const auto F =
      matrix(setup, particles.F, p) + dt * matrix(setup, particles.grad_v, p) * matrix(setup, particles.F, p);
    for (unsigned int c = 0; c < dim * dim; ++c)
      particles.component(particles.F, c)[p] = F[c / dim][c % dim];
  }
  body.traction.finish(particles);
  check("work", (sum(body.traction.work) - sum(work)) / sum(work), 1e-11);
}

template <int dim>
void traction_errors()
{
  const auto error = [](const std::string &name, const std::string &text, const std::string &entry,
                        const std::string &message) {
    check_error<EntryError>(name, {"/Tractions/load: " + entry, message},
                            [&] { LoadedBody<dim> body("linear", text); });
  };
  error("unknown face", set("Faces", "x+, up"), "Faces", "no face 'up'. Choices: all, x-");
  error("empty region",
        set("Lower corner", coordinates<dim>({{0.2, 0.95, 0.65}})) +
          set("Upper corner", coordinates<dim>({{0.3, 1, 0.7}})),
        "Lower corner", "no point of the surface");
  error("one corner", set("Lower corner", coordinates<dim>({{0, 0, 0}})), "Lower corner", "both corners");
  error("two pressures", set("Type", "pressure") + set("Pressure", "1; 2"), "Pressure", "expected one expression");
  error("force off the body", set("Type", "force") + set("Position", coordinates<dim>({{0.6, 1, 0.7}})), "Position",
        "no particle of 'body'");
}

template void traction_sums<2>();
template void traction_sums<3>();
template void traction_work<2>();
template void traction_work<3>();
template void traction_errors<2>();
template void traction_errors<3>();

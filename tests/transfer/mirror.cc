#include <talus/steppers/explicit_step.h>

#include "slip.h"

using namespace Test;
using namespace dealii;

namespace
{
  /** The plane is x_axis = 0; the half with a mirror is above, or below where it meets the other face of its axis. */
  template <int dim>
  class HalfAndWhole
  {
  public:
    HalfAndWhole(const std::string &kernel, const std::string &transfer, const unsigned int axis) :
      kernel(kernel), transfer(transfer), axis(axis), is_above(axis == 0)
    {
    }

    void compare() const
    {
      Setup<dim> half(box(is_above ? 0 : -0.5, is_above ? 0.5 : 0) +
                      walls({{"slip", faces(std::to_string(2 * axis + (is_above ? 0 : 1)))}}));
      Setup<dim> whole(box(-0.5, 0.5));
      for (Setup<dim> *setup : {&half, &whole})
      {
        start(*setup);
        advance(*setup);
      }
      const auto a = sums(half), b = sums(whole);
      double     error = 0, largest = 0;
      for (unsigned int i = 0; i < a.size(); ++i)
      {
        raise(error, a[i] - b[i]);
        largest = std::max(largest, std::abs(b[i]));
      }
      check(transfer + ", " + kernel + ", normal " + "xy"[axis], error / largest, 1e-12);
    }

  private:
    std::string box(const double lower, const double upper) const
    {
      std::array<double, 3> a = {{0, 0, 0}}, b = {{0.5, 0.5, 0.5}};
      a[axis] = lower, b[axis] = upper;
      return section("Grid", set("Lower corner", coordinates<dim>(a)) + set("Upper corner", coordinates<dim>(b)) +
                               set("Spacing", "0.125")) +
             kernel_text(kernel, "mirror") + transfer_text(transfer) +
             body_text(set("Lower corner", coordinates<dim>(a)) + set("Upper corner", coordinates<dim>(b)));
    }

    double wave(const Setup<dim> &setup, const unsigned int p, const unsigned int c, const bool is_odd) const
    {
      auto         x    = setup.position(p);
      const double side = x[axis] < 0 ? -1 : 1;
      x[axis]           = std::abs(x[axis]);
      double phase      = 1. + c;
      for (unsigned int d = 0; d < dim; ++d)
        phase += (9. + 4 * d) * x[d];
      return (is_odd ? side : 1.) * std::sin(phase);
    }

    /** What points along the normal is odd, the rest even; so are stress and gradient, entry by entry. */
    void start(Setup<dim> &setup) const
    {
      const auto &particles = setup.particles;
      setup.fill(particles.velocity,
                 [&](const unsigned int p, const unsigned int c) { return wave(setup, p, c, c == axis); });
      setup.fill(particles.grad_v, [&](const unsigned int p, const unsigned int c) {
        return wave(setup, p, c + 3, (c / dim == axis) != (c % dim == axis));
      });
      setup.fill(particles.stress, [&](const unsigned int p, const unsigned int c) {
        const unsigned int i = c < 3 ? c : (c == 5 ? 1 : 0), j = c < 3 ? c : (c == 3 ? 1 : 2);
        return wave(setup, p, c + 11, (i == axis) != (j == axis));
      });
    }

    static void advance(Setup<dim> &setup)
    {
      auto &particles = setup.particles;
      setup.boundary.mark_slip_walls(0., particles.n_stencil_nodes, setup.grid);
      setup.transfer->initialize(*setup.kernel, particles);
      const double dt = 5e-3;
      for (unsigned int n = 0; n < 5; ++n)
      {
        setup.step(dt, n * dt);
        update_stress(particles, setup.materials, dt);
        particles.relocate();
        if (max(particles.needs_synchronise) > 0)
          particles.migrate();
      }
    }

    /** The same sums over all particles of a half, of functions that tell them apart. */
    std::vector<double> sums(const Setup<dim> &setup) const
    {
      const auto         &particles = setup.particles;
      std::vector<double> result;
      for (const unsigned int field : {particles.position, particles.velocity, particles.grad_v, particles.stress})
        for (unsigned int c = 0; c < particles.fields[field].n_components; ++c)
          for (const double q : {0., 3., 7.})
          {
            double value = 0;
            for (unsigned int p = 0; p < particles.size(); ++p)
            {
              const auto X = Point<dim>(particles.vector(particles.initial_position, p));
              if ((X[axis] > 0) == is_above)
                value += particles.component(field, c)[p] * std::cos(q * X[0] + 2 * q * X[1] + q * X[dim - 1]);
            }
            result.push_back(sum(value));
          }
      return result;
    }

    const std::string  kernel, transfer;
    const unsigned int axis;
    const bool         is_above;
  };
} // namespace

/**
 * Half of a symmetric body with a mirror moves as half of the whole body does. Not with FLIP: the nodes on the mirror
 * know the momentum of one side alone before the condition acts, and FLIP gathers the change.
 */
template <int dim>
void mirror_and_whole()
{
  for (const std::string kernel : {"linear", "quadratic B-spline", "cubic B-spline", "uGIMP"})
    for (const std::string transfer : {"PIC", "APIC", "TPIC"})
      for (const unsigned int axis : {0u, 1u})
        HalfAndWhole<dim>(kernel, transfer, axis).compare();
}

/** A uniform pressure in a box of mirrors: each face bears pressure times area, by its nodes and by mirrored forces. */
template <int dim>
void mirror_reaction()
{
  for (const std::string kernel : {"quadratic B-spline", "cubic B-spline", "uGIMP"})
    for (const bool is_plain : {false, true})
      for (const unsigned int id : {2u, 3u})
      {
        const std::string others = dim == 2 ? "0, 1" : "0, 1, 4, 5";
        Setup<dim>        setup(
                 section("Grid", set("Cells", dim == 2 ? "6, 5" : "6, 5, 4")) + kernel_text(kernel, "mirror") +
                 transfer_text("TPIC") + body_text("") +
                 walls(
                   {{"slip", faces(std::to_string(id))}, {"slip", faces(std::to_string(5 - id))}, {"slip", faces(others)}}));
        setup.transfer->is_plain = is_plain;
        setup.fill(setup.particles.stress, [](unsigned int, const unsigned int c) { return c < 3 ? -2. : 0.; });
        setup.step(1e-3);
        const double reaction = sum(setup.boundary.conditions[0]->reaction[1]);
        check(kernel + (is_plain ? ", plain" : ", batched") + ", face " + std::to_string(id),
              reaction - (id == 2 ? -2. : 2.), 1e-12);
        check("  nodal force", sum(setup.boundary.conditions[0]->nodal_force[1]) - reaction, 1e-12);
        double v = 0;
        for (unsigned int p = 0; p < setup.particles.size(); ++p)
          raise(v, velocity(setup, p).norm());
        check("  nothing moves", max(v), 1e-12);
      }
}

#define INSTANTIATE(name)                                                                                              \
  template void name<2>();                                                                                             \
  template void name<3>();
INSTANTIATE(mirror_and_whole)
INSTANTIATE(mirror_reaction)

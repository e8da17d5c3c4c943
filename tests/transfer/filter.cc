#include "transfer.h"

using namespace Test;
using namespace dealii;

namespace
{
  /**
   * What a step without forces leaves of a wave of `length` cells, by the transform W of the quadratic B-spline at all
   * waves that look alike at the nodes: doc/transfers.md.
   */
  double remainder(const std::string &transfer, const double length)
  {
    if (transfer == "FLIP")
      return 1;
    double factor = 0;
    for (int j = -100; j <= 100; ++j)
    {
      const double z = numbers::PI / length + numbers::PI * j, s = std::sin(z) / z;
      const double W = s * s * s, dW = 3 * s * s * (std::cos(z) / z - std::sin(z) / (z * z));
      factor += W * W + (transfer == "APIC" ? dW * dW : transfer == "TPIC" ? -z * W * dW : 0);
    }
    return factor;
  }

  /** The same of particles at rest in their places, `n` per cell and direction, far from the ends of a row of cells. */
  template <int dim>
  double counted(const std::string &transfer, const unsigned int length, const unsigned int n)
  {
    const double       h    = 0.1;
    const unsigned int ends = 8, n_cells = 2 * length + 2 * ends;
    const auto         upper = coordinates<dim>({{n_cells * h, 2 * h, 2 * h}});
    Setup<dim>         setup(
              section("Grid", set("Upper corner", upper) + set("Spacing", std::to_string(h))) + transfer_text(transfer) +
              body_text(set("Upper corner", upper) + set("Particles per cell and direction", std::to_string(n))));
    const double k    = 2 * numbers::PI / (length * h);
    const auto   wave = [&](const unsigned int p) { return std::sin(k * setup.position(p)[0]); };
    setup.fill(setup.particles.velocity, [&](const unsigned int p, unsigned int) { return wave(p); });
    setup.fill(setup.particles.grad_v, [&](const unsigned int p, const unsigned int c) {
      return c % dim == 0 ? k * std::cos(k * setup.position(p)[0]) : 0.;
    });
    setup.transfer->initialize(*setup.kernel, setup.particles);
    const auto amplitude = [&]() {
      double a = 0;
      for (unsigned int p = 0; p < setup.particles.size(); ++p)
        if (std::abs(setup.position(p)[0] - n_cells * h / 2) < length * h)
          for (unsigned int d = 0; d < dim; ++d)
            a += velocity(setup, p)[d] * wave(p);
      return sum(a);
    };
    setup.step(0.); // after one the affine field is the transfer's own
    const double before = amplitude();
    setup.step(0.);
    return amplitude() / before;
  }
} // namespace

/** Losses are those of a continuum of particles as their number grows: of second order, or better. */
template <int dim>
void filter()
{
  for (const std::string transfer : {"FLIP", "PIC", "APIC", "TPIC"})
    for (const unsigned int length : {4u, 8u})
    {
      const double      expected = remainder(transfer, length), coarse = counted<dim>(transfer, length, 3) - expected;
      const double      fine = counted<dim>(transfer, length, 6) - expected;
      const std::string name = transfer + ", wave of " + std::to_string(length) + " h: ";
      check(name + "loss", fine, 0.02 * (1 - expected) + 1e-13);
      check(name + "order", fine, std::abs(coarse) / 3.5 + 1e-13);
    }
}

template void filter<2>();
template void filter<3>();

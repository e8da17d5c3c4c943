#include <talus/steppers/explicit_step.h>

#include "transfer.h"

using namespace Test;
using namespace dealii;

/**
 * The batched loops beside the plain ones: ten steps of jittered particles in all cells of a small box, walls, edges
 * and corners included, from the same random state. Every column of the particles must agree to summation round-off.
 */
namespace
{
  template <int dim>
  void run(Setup<dim> &setup, const bool is_plain)
  {
    setup.transfer->is_plain = is_plain;
    randomize_motion(setup);
    setup.randomize(setup.particles.stress, 5);
    setup.accelerate(dim == 2 ? "0.3; -y" : "0.3; -y; x");
    const double dt = 2e-3;
    for (unsigned int n = 0; n < 10; ++n)
    {
      setup.step(dt, n * dt);
      auto ranges = material_ranges(setup.particles, setup.materials, dt);
      for (auto &range : ranges)
        range.is_plain = is_plain;
      update_stress(setup.particles, setup.materials, ranges, 0, setup.particles.size());
      setup.particles.relocate();
      if (max(setup.particles.needs_synchronise) > 0)
        setup.particles.migrate();
    }
    setup.particles.synchronise(); // the same order in both
  }

  template <int dim>
  void compare(const std::string &kernel, const std::string &treatment, const std::string &transfer)
  {
    Setup<dim> plain(full_box<dim>(kernel, treatment, transfer) + walls_text<dim>("slip"));
    run(plain, true);
    Setup<dim> batched(full_box<dim>(kernel, treatment, transfer) + walls_text<dim>("slip"));
    run(batched, false);

    double error = 0;
    for (unsigned int c = 0; c < plain.particles.n_columns(); ++c)
    {
      double largest = 0, difference = 0;
      for (unsigned int p = 0; p < plain.particles.size(); ++p)
      {
        largest = std::max(largest, std::abs(plain.particles.column(c)[p]));
        raise(difference, plain.particles.column(c)[p] - batched.particles.column(c)[p]);
      }
      raise(error, difference / std::max(largest, 1e-30));
    }
    check(transfer + ", " + kernel + ", " + treatment, error, 1e-10);
  }
} // namespace

template <int dim>
void batched_and_plain()
{
  for (const std::string transfer : {"FLIP", "PIC", "blend", "APIC", "TPIC"})
    for (const std::string kernel : {"linear", "quadratic B-spline", "cubic B-spline", "uGIMP"})
      for (const std::string treatment : {"none", "Steffen", "WLS", "WLS separable", "WLS everywhere", "MLS"})
        if (treatment != "Steffen" || kernel != "uGIMP")
          compare<dim>(kernel, treatment, transfer);
}

template void batched_and_plain<2>();
template void batched_and_plain<3>();

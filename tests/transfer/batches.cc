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
    auto &particles          = setup.particles;
    randomize_motion(setup);
    setup.randomize(particles.stress, 5);
    // Domains are sheared and stretched.
    setup.fill(particles.F, [&](const unsigned int p, const unsigned int c) {
      return (c % (dim + 1) == 0 ? 1. : 0.) + 0.2 * hashed_jitter(7, particles.id[p], c);
    });
    setup.accelerate(dim == 2 ? "0.3; -y" : "0.3; -y; x");
    const double dt = 2e-3;
    for (unsigned int n = 0; n < 10; ++n)
    {
      setup.step(dt, n * dt);
      auto ranges = material_ranges(setup.particles, dt);
      for (auto &range : ranges)
        range.is_plain = is_plain;
      update_stress(setup.particles, setup.materials, ranges, 0, setup.particles.size());
      setup.particles.relocate();
      if (max(setup.particles.needs_synchronise) > 0)
        setup.particles.migrate();
    }
    setup.particles.synchronise(); // the same order in both
  }

  /** The largest difference of any column, over its largest value. */
  template <int dim>
  double difference(const std::string &text)
  {
    Setup<dim> plain(text);
    run(plain, true);
    Setup<dim> batched(text);
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
    return error;
  }

  template <int dim>
  void compare(const std::string &kernel, const std::string &treatment, const std::string &transfer,
               const std::string &more = "", const std::string &conditions = walls_text<dim>("slip"))
  {
    const double      error = difference<dim>(full_box<dim>(kernel, treatment, transfer, more) + conditions);
    const std::string walls = conditions == walls_text<dim>("slip") ? "" : ", mixed walls";
    check(transfer + ", " + kernel + ", " + treatment + (more.empty() ? "" : ", projection") + walls, error, 1e-10);
  }

  /** A slip wall, one of which a part is held, and others. */
  template <int dim>
  std::string mixed_walls()
  {
    const auto faces = [](const std::string &ids) { return set("Boundary ids", ids); };
    return section("Conditions",
                   set("Names", "slip, held, friction, fixed") + section("slip", set("Type", "slip") + faces("1, 2")) +
                     section("held", set("Type", "no-slip") + set("Lower corner", coordinates<dim>({{-9, 0.69, -9}})) +
                                       set("Upper corner", coordinates<dim>({{-0.15, 0.71, 9}}))) +
                     section("friction", set("Type", "friction") + faces("3")) +
                     section("fixed", set("Type", "no-slip") + faces(dim == 2 ? "0" : "0, 5")));
  }
} // namespace

template <int dim>
void batched_and_plain()
{
  for (const std::string transfer : {"FLIP", "PIC", "blend", "APIC", "TPIC"})
    for (const std::string kernel : {"linear", "quadratic B-spline", "cubic B-spline", "uGIMP"})
      for (const std::string treatment :
           {"none", "Steffen", "WLS", "WLS separable", "WLS everywhere", "MLS", "mirror", "ghost nodes"})
        if (treatment != "Steffen" || kernel != "uGIMP")
          compare<dim>(kernel, treatment, transfer);
}

template <int dim>
void batched_and_plain_slip()
{
  const std::string project = set("Slip projection", "true");
  for (const std::string kernel : {"linear", "quadratic B-spline", "cubic B-spline", "uGIMP"})
  {
    for (const std::string transfer : {"APIC", "TPIC"})
      for (const std::string treatment : {"none", "WLS", "WLS separable", "WLS everywhere", "MLS", "mirror"})
        for (const auto &conditions : {walls_text<dim>("slip"), mixed_walls<dim>()})
          compare<dim>(kernel, treatment, transfer, project, conditions);
    for (const std::string transfer : {"FLIP", "APIC"})
      for (const std::string treatment : {"mirror", "ghost nodes"})
        compare<dim>(kernel, treatment, transfer, "", mixed_walls<dim>());
  }
}

/** CPDI, whose loops go over corners. */
template <int dim>
void domains_and_lists()
{
  for (const std::string transfer : {"FLIP", "PIC", "blend", "APIC", "TPIC", "CPLS"})
    check(transfer + ", CPDI",
          difference<dim>(skewed_grid<dim>({{8, 8, 8}}) + section("Kernel", set("Type", "CPDI") + set("Layers", "3")) +
                          transfer_text(transfer) + box_body<dim>({{-0.1, 0.86, 0.45}}, {{0.2, 1.1, 0.825}}, 0.5)),
          1e-10);
}

template void domains_and_lists<2>();
template void domains_and_lists<3>();
template void batched_and_plain<2>();
template void batched_and_plain<3>();
template void batched_and_plain_slip<2>();
template void batched_and_plain_slip<3>();

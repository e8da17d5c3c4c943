#include "../setup.h"
#include "stability.h"

using namespace Test;

/**
 * Growth of the transfer as a linear map: P2G, conditions, G2P of frozen particles in a full box, 3000 times from a
 * random state (v, grad v or B). With normalisation this is the power iteration; the mean factor of the last 200 is
 * the magnitude of the largest eigenvalue. A factor above 1 amplifies noise without any force.
 */
namespace
{
  /** Divides a field by a number. */
  void shrink(Setup<2> &setup, const unsigned int field, const double divisor)
  {
    setup.fill(field, [&](const unsigned int p, const unsigned int c) {
      return setup.particles.component(field, c)[p] / divisor;
    });
  }

  /** sum |u|^2 over all particles. */
  double square(const Setup<2> &setup, const unsigned int field)
  {
    double result = 0;
    for (unsigned int c = 0; c < setup.particles.fields[field].n_components; ++c)
      for (unsigned int p = 0; p < setup.particles.size(); ++p)
        result += std::pow(setup.particles.component(field, c)[p], 2);
    return sum(result);
  }

  double growth(const std::string &kernel, const std::string &treatment, const std::string &transfer,
                const std::string &walls, const bool is_random, const std::string &more = "")
  {
    Setup<2>           setup(section("Grid", set("Cells", "10, 10")) + kernel_text(kernel, treatment) +
                             transfer_text(transfer, more) + walls_text<2>(walls) +
                             body_text(is_random ? set("Jitter", "1") + set("Seed", "3") : ""));
    auto              &particles = setup.particles;
    const bool         is_apic   = transfer == "APIC";
    const unsigned int moment    = is_apic ? particles.add_field("affine moment", 4) : particles.grad_v;
    const double       scale     = is_apic ? 10 : 0.1; // makes B or grad v a velocity: h = 0.1
    setup.randomize(particles.velocity, 1);
    setup.randomize(moment, 2);
    shrink(setup, moment, scale);

    const auto norm = [&] {
      return std::sqrt(square(setup, particles.velocity) + scale * scale * square(setup, moment));
    };
    double mean = 0;
    for (unsigned int n = 0; n < 3000; ++n)
    {
      const bool is_counted = n >= 2800;
      if (is_counted || n % 100 == 0)
      {
        const double before = norm();
        shrink(setup, particles.velocity, before);
        shrink(setup, particles.grad_v, before);
        if (is_apic)
          shrink(setup, moment, before);
      }
      setup.step(0.);
      if (is_counted)
        mean += norm() / 200;
    }
    return mean;
  }

  const std::vector<std::string> all_walls = {"free", "no-slip", "slip"};

  void corrected(const std::string &kernel, const std::string &treatment)
  {
    for (const std::string transfer : {"APIC", "TPIC"})
      for (const auto &walls : all_walls)
        for (const bool is_random : {false, true})
        {
          const double factor = growth(kernel, treatment, transfer, walls, is_random);
          check(transfer + ", " + walls + (is_random ? ", random" : ", lattice") + " = " + std::to_string(factor),
                factor > 1 || std::isnan(factor) ? factor - 1 : 0., 1e-9);
        }
  }

  /** The cures of the noise at slip walls. */
  void cured()
  {
    const std::string project = set("Slip projection", "true");
    for (const std::string kernel : {"quadratic B-spline", "cubic B-spline"})
      for (const std::string transfer : {"APIC", "TPIC"})
        for (const auto &[treatment, more] :
             {std::make_pair(std::string("WLS"), project), std::make_pair(std::string("WLS separable"), project),
              std::make_pair(std::string("mirror"), std::string()),
              std::make_pair(std::string("ghost nodes"), std::string())})
          for (const bool is_random : {false, true})
          {
            const double factor = growth(kernel, treatment, transfer, "slip", is_random, more);
            check(transfer + ", " + kernel + ", " + treatment + (is_random ? ", random" : ", lattice") + " = " +
                    std::to_string(factor),
                  factor > 1 || std::isnan(factor) ? factor - 1 : 0., 1e-9);
          }
  }

  /**
   * The growth that Steffen's functions are known for: it shows that the test sees what the correction cures. It needs
   * free tangential motion of the boundary nodes; no-slip on all faces cuts the feedback.
   */
  void steffen()
  {
    for (const std::string transfer : {"APIC", "TPIC"})
    {
      const bool is_apic = transfer == "APIC";
      const auto factor  = [&](const std::string &walls) {
        return growth("quadratic B-spline", "Steffen", transfer, walls, false);
      };
      check_range(transfer + ", free", factor("free"), is_apic ? 1.38 : 1.06, is_apic ? 1.44 : 1.10);
      check_range(transfer + ", slip", factor("slip"), is_apic ? 1.29 : 1.04, is_apic ? 1.34 : 1.08);
      check_range(transfer + ", no-slip", factor("no-slip"), 0.9, 1.);
    }
  }

  /** Missing nodes alone do hardly any harm. */
  void truncated()
  {
    for (const std::string transfer : {"APIC", "TPIC"})
      for (const auto &walls : all_walls)
        check_range(transfer + ", " + walls, growth("quadratic B-spline", "none", transfer, walls, false), 0.9, 1.1);
  }
} // namespace

int main(int argc, char **argv)
{
  return run(argc, argv,
             {{"quadratic B-spline, WLS", [] { corrected("quadratic B-spline", "WLS"); }},
              {"cubic B-spline, WLS", [] { corrected("cubic B-spline", "WLS"); }},
              {"quadratic B-spline, ghost nodes", [] { corrected("quadratic B-spline", "ghost nodes"); }},
              {"uGIMP, ghost nodes", [] { corrected("uGIMP", "ghost nodes"); }},
              {"slip projection and mirror", cured},
              {"quadratic B-spline, Steffen", steffen},
              {"quadratic B-spline, none", truncated},
              {"lone particles 2D", lone_particles<2>},
              {"lone particles 3D", lone_particles<3>},
              {"arrangements 2D", [] { arrangements<2>(100); }},
              {"arrangements 3D", [] { arrangements<3>(25); }},
              {"meshes 2D", meshes<2>},
              {"meshes 3D", meshes<3>},
              {"long: arrangements 2D", [] { arrangements<2>(2000); }},
              {"long: arrangements 3D", [] { arrangements<3>(500); }}});
}

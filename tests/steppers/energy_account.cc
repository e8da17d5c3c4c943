#include "../run.h"

#include <talus/steppers/energy_watch.h>

using namespace Test;
using namespace dealii;

namespace
{
  struct BalanceCase
  {
    std::string grid, kernel, treatment, transfer, condition, material, run;
  };

  /** A block that spins and is thrown at the floor, or slides on it. */
  template <int dim>
  std::string text_of(const BalanceCase &one, const unsigned int n_cells)
  {
    const std::string cells   = coordinates<dim>({{1. * n_cells, 1. * n_cells, 1. * n_cells}});
    const std::string floor   = set("Boundary ids", "2");
    const bool        is_mesh = one.grid == "mesh", has_mirrors = one.treatment == "mirrors";
    const std::string of_mesh  = has_mirrors ? set("Boundaries", "lower y") : set("Half spaces", "y <= 0");
    const std::string mirrors  = set(one.condition == "slip" ? "Slip mirrors" : "No-slip mirrors", "lower y");
    const std::string velocity = dim == 2 ? "0.2 - 2 * (y - 0.35); -1 + 2 * (x - 0.5)" :
                                            "0.2 - 2 * (y - 0.35); -1 + 2 * (x - 0.5) - (z - 0.5); (y - 0.35)";
    const std::string gradient = dim == 2 ? "0, -2, 2, 0" : "0, -2, 0, 2, 0, -1, 0, 1, 0";
    return section("Grid", set("Type", one.grid) + set("Upper corner", coordinates<dim>({{1, 1, 1}})) +
                             set("Cells", cells) + (has_mirrors ? mirrors : "")) +
           section("Kernel", set("Type", one.kernel) + (is_mesh ? "" : set("Boundary treatment", one.treatment))) +
           section("Transfer", set("Type", one.transfer)) +
           section("Run",
                   one.run + set("Energy account", "true") + set("Body force", dim == 2 ? "0; -3" : "0; -3; 0")) +
           section("Materials", set("Names", "rubber") +
                                  section("rubber", one.material + set("Density", "1") + set("Young's modulus", "100") +
                                                      set("Poisson's ratio", "0.3"))) +
           section("Bodies", set("Names", "block") +
                               section("block", set("Lower corner", coordinates<dim>({{0.3, 0.2, 0.35}})) +
                                                  set("Upper corner", coordinates<dim>({{0.7, 0.5, 0.65}})) +
                                                  set("Velocity", velocity) + set("Velocity gradient", gradient))) +
           section("Conditions",
                   set("Names", "floor") + section("floor", set("Type", one.condition) + (is_mesh ? of_mesh : floor)));
  }

  template <int dim>
  std::array<double, 2> stored_and_taken(Run<dim> &run)
  {
    auto               &particles = run.model.particles;
    std::vector<double> densities(particles.size());
    const double       *volume = particles.component(particles.volume, 0);
    const auto          range  = material_range(particles, 0, 0.);
    const auto          total  = [&] {
      double result = 0;
      for (unsigned int p = 0; p < particles.size(); ++p)
        result += densities[p] * volume[p];
      return sum(result);
    };
    if (run.model.f_bar.is_on)
      run.model.f_bar.remove_added(particles, 0, particles.size()); // the law stores the energy of its own stress
    run.model.materials[0]->strain_energy_densities(range, densities.data());
    if (run.model.f_bar.is_on)
      run.model.f_bar.add_added(particles, 0, particles.size());
    const double stored = total();
    run.model.materials[0]->plastic_work_densities(range, densities.data());
    return {{stored, total()}};
  }

  struct Balance
  {
    double rest, at_end, losses; // greatest and last unaccounted energy, sum of losses: over the energy at the start
  };

  template <int dim>
  Balance balance(const BalanceCase &one, const unsigned int n_cells, const double end, const unsigned int n_steps)
  {
    Run<dim>         run(text_of<dim>(one, n_cells));
    EnergyWatch<dim> watch;
    Talus::Table     losses;
    watch.add_losses_to(losses);
    const auto   start = stored_and_taken(run);
    const double K     = run.report.kinetic_energy;
    watch.start(run.report, start[0]);
    Moment  now;
    Balance result{};
    now.dt = end / n_steps;
    for (unsigned int n = 0; n < n_steps; ++n)
    {
      run.step(now.dt);
      watch.check(run.model, run.report, now);
      const auto   energy = stored_and_taken(run);
      const double rest   = watch.unaccounted(watch.residual(run.report.kinetic_energy, energy[0]), energy[1]) / K;
      result.rest         = std::max(result.rest, std::abs(rest));
      result.at_end       = rest;
      result.losses       = (losses.row()[0] + losses.row()[1] + losses.row()[2] + energy[1]) / K;
    }
    return result;
  }
} // namespace

/**
 * Kinetic and elastic energy, what transfer, walls, friction and plastic flow have taken, less all work: what it was
 * at the start, but for an error of second order in the step size. Much is lost all the same.
 */
template <int dim>
void energy_account()
{
  const std::string spline = "quadratic B-spline", rubber = set("Type", "neo-Hookean");
  const std::string clay = set("Type", "Hencky") + set("Yield stress", "8") +
                           set("Hardening", "exponential softening") + set("Residual yield stress", "4") +
                           set("Softening rate", "3");
  const std::vector<BalanceCase> cases   = {{"box", spline, "WLS", "FLIP", "no-slip", rubber, ""},
                                            {"box", spline, "WLS", "APIC", "friction", rubber, ""},
                                            {"box", spline, "ghost nodes", "TPIC", "no-slip", rubber, ""},
                                            {"box", spline, "ghost nodes", "APIC", "friction", clay, ""},
                                            {"box", spline, "none", "TPIC", "no-slip", rubber, set("MUSL", "true")},
                                            {"mesh", "UMLS", "", "FLIP", "slip", rubber, ""},
                                            {"mesh", "UMLS", "", "APIC", "no-slip", rubber, ""},
                                            {"mesh", "UMLS", "mirrors", "FLIP", "no-slip", rubber, ""},
                                            {"mesh", "UMLS", "mirrors", "FLIP", "slip", clay, ""},
                                            {"box", spline, "mirror", "FLIP", "slip", rubber, ""},
                                            {"box", spline, "ghost nodes", "TPIC", "slip", clay, set("F-bar", "true")},
                                            {"mesh", "UMLS", "", "APIC", "no-slip", clay, set("F-bar", "true")},
                                            {"mesh", "C1 UMLS", "", "TPIC", "no-slip", clay, ""}};
  const unsigned int             n_cells = dim == 2 ? 12 : 8, n_steps = dim == 2 ? 160 : 100;
  for (const BalanceCase &one : cases)
  {
    const std::string name = one.grid + ", " + one.treatment + " " + one.kernel + ", " + one.transfer + ": ";
    const auto coarse = balance<dim>(one, n_cells, 0.4, n_steps), fine = balance<dim>(one, n_cells, 0.4, 2 * n_steps);
    check(name + "unaccounted", fine.rest, one.run.find("F-bar") != std::string::npos ? 2e-3 : 3e-4);
    check_range(name + "half the step", fine.rest / coarse.rest, 0.1, 0.35);
    check_range(name + "losses", fine.losses, 0.05, 2);
  }
}

template void energy_account<2>();
template void energy_account<3>();

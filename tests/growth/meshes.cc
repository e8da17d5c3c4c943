#include "../run.h"
#include "stability.h"

using namespace Test;

namespace
{
  /** A free block of particles at random in a Delaunay mesh, at rest. */
  template <int dim>
  std::string text_of(const std::string &kernel, const std::string &transfer, const std::string &ratio,
                      const std::string &run)
  {
    const std::string here = __FILE__;
    const std::string file =
      here.substr(0, here.rfind('/')) + "/../mesh/data/" + (dim == 2 ? "plate.msh" : "block.msh");
    return section("Grid", set("Type", "mesh") + set("File", file) + set("Spacing", "0.2")) +
           section("Kernel", set("Type", kernel)) + section("Transfer", set("Type", transfer)) + section("Run", run) +
           section("Materials", set("Names", "rubber") +
                                  section("rubber", set("Type", "linear elastic") + set("Density", "1") +
                                                      set("Young's modulus", "1") + set("Poisson's ratio", ratio))) +
           section("Bodies",
                   set("Names", "block") +
                     section("block", set("Lower corner", coordinates<dim>({{0.05, 0.05, 0.05}})) +
                                        set("Upper corner", coordinates<dim>({{0.9, 0.27, 0.7}})) + set("Jitter", "1") +
                                        set("Seed", "5") + set("Particles per cell and direction", "3")));
  }

  /** The greatest kinetic energy of some steps over that of the start: velocities are round-off but for their size. */
  template <int dim>
  double growth(const std::string &kernel, const std::string &transfer, const std::string &ratio, const double factor)
  {
    Run<dim> run(text_of<dim>(kernel, transfer, ratio, ""));
    auto    &particles = run.model.particles;
    for (unsigned int d = 0; d < dim; ++d)
      for (unsigned int p = 0; p < particles.size(); ++p)
        particles.component(particles.velocity, d)[p] = 1e-7 * hashed_jitter(9, particles.id[p], d);
    const double dt = factor * run.stepper->step_size(run.model, run.report);
    run.step(dt);
    const double start = run.report.kinetic_energy;
    double       most  = 0;
    for (unsigned int n = 0; n < 400 && most < 1e3; ++n)
    {
      run.step(dt);
      most = std::max(most, run.report.kinetic_energy / start);
    }
    return most;
  }
} // namespace

/** The default Courant number on a mesh: stable with any transfer, and not much less than what is. */
template <int dim>
void meshes()
{
  for (const std::string kernel : {"UMLS", "C1 UMLS"})
  {
    for (const std::string transfer : {"FLIP", "PIC", "APIC", "TPIC"})
      for (const std::string ratio : {"0", "0.3", "0.49"})
        check(kernel + ", " + transfer + ", " + ratio + ": growth", growth<dim>(kernel, transfer, ratio, 1.), 1.05);
    check_range(kernel + ": with 2.5 times the step", growth<dim>(kernel, "FLIP", "0.3", 2.5), 1e2, 1e300);
  }
}

template void meshes<2>();
template void meshes<3>();

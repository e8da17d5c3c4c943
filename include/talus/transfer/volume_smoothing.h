#pragma once

#include <talus/particles/material_range.h>
#include <talus/transfer/averaging.h>

namespace Talus
{
  /**
   * Draws the volume ratios J = rho_ref V / m of neighbouring particles of a fluid together, and keeps their gradient
   * g:
   * @f[ J_i = \frac{\sum_p m_p \phi_{ip} (J_p + g_p \cdot (x_i - x_p))}{\sum_p m_p \phi_{ip}} , \quad
   *     J_p \mathrel{+}= \alpha \Big(\sum_i \phi_{ip} J_i - J_p\Big) , \quad g_p = \sum_i J_i \nabla\phi_{ip} , \quad
   *     \alpha = \min(1, s \, dt / h) @f]
   * with the speed s that the material asks for; without one there is neither pass nor field. The kernels are corrected
   * by separable least squares at all faces of the domain, whatever the run's treatment: fields that reproduce linear
   * functions keep sum m J, which is the volume, and a linear J. Where the pressure comes from J alone it is what lets
   * rows of particles drift apart in J that nothing brings back: doc/quiet_floor.md. Test: tests/transfer/smoothing.cc.
   */
  template <int dim>
  class VolumeSmoothing
  {
  public:
    explicit VolumeSmoothing(Parameters &parameters) : averaging(parameters, "WLS separable") {}

    /** Adds g to the particles if a material smooths. Before the first particle exists. */
    void add_fields(const std::vector<std::unique_ptr<Material>> &materials, WorkingSet<dim> &particles);

    /** Sets g of the initial state. Collective. */
    void initialize(const std::vector<std::unique_ptr<Material>> &materials, const Kernel<dim> &kernel,
                    Particles<dim> &particles, const Grid<dim> &grid);

    /** Smooths volume, F = diag(J, 1, 1) and stress. Collective. */
    void apply(const std::vector<std::unique_ptr<Material>> &materials, const Kernel<dim> &kernel, const double dt,
               Particles<dim> &particles, const Grid<dim> &grid);

  private:
    void smooth(const Material &material, const MaterialRange &range, const Kernel<dim> &kernel, const double alpha,
                Particles<dim> &particles, const Grid<dim> &grid);

    Averaging<dim>      averaging;
    std::vector<double> J;            // of each particle
    unsigned int        gradient = 0; // g [1/length]
  };
} // namespace Talus

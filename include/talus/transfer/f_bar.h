#pragma once

#include <talus/particles/material_range.h>
#include <talus/transfer/averaging.h>

namespace Talus
{
  /**
   * F-bar by averaging over the grid, Zhao, Jiang & Choo (2023), against volumetric locking: materials see
   * @f[ \bar F = (\bar J / J)^{1/d} F , \qquad
   *     \bar J_p = \frac{\sum_i \phi_{ip} \bar J_i}{\sum_i \phi_{ip}} , \quad
   *     \bar J_i = \frac{\sum_p m_p \phi_{ip} J_p}{\sum_p m_p \phi_{ip}} , @f]
   * J = rho V / m, averaged over the particles of their material; a step of the law the velocity gradient that leads
   * from the last F-bar to the new one. Kernels are not corrected at the domain's faces, so that no weight is negative;
   * what is missing is divided out. F, volume and grad v of the particles, and with them the forces' volumes and the
   * transfer, stay as they are. Particles carry what materials see as further fields, which material_range() finds by
   * their names. Theory: doc/materials.md. Test: tests/transfer/f_bar.cc.
   */
  template <int dim>
  class FBar
  {
  public:
    explicit FBar(Parameters &parameters) : averaging(parameters, "none") {}

    bool is_on = false;

    /** Adds its fields to the particles. Before the first particle exists. */
    void add_fields(WorkingSet<dim> &particles);

    /** Begins with J-bar = J. */
    void initialize(Particles<dim> &particles);

    /** Sets what the materials see, when F and volume are those at the end of the step. Collective. */
    void apply(const std::vector<std::unique_ptr<Material>> &materials, const Kernel<dim> &kernel, const double dt,
               Particles<dim> &particles, const Grid<dim> &grid);

  private:
    /** The same of one material's particles, whose mean J and sum of weights are in the two arrays. */
    void update(const MaterialRange &range, const Material &material, Particles<dim> &particles) const;

    Averaging<dim>      averaging;
    std::vector<double> mean, weight;
  };
} // namespace Talus

#pragma once

#include <talus/particles/kept_positions.h>
#include <talus/particles/material_range.h>
#include <talus/transfer/averaging.h>

namespace Talus
{
  /**
   * Volumes that are averaged over the grid, against volumetric locking: particles deform by f-bar, not by f = I + dt
   * grad v,
   * @f[ \bar f = (\bar\jmath / j)^{1/d} f , \quad j = \det f , \quad \ln\bar\jmath = A \ln j , \quad
   *     (A a)_p = \frac{1}{\sum_i \phi_{ip}} \sum_i \phi_{ip} \frac{\sum_q m_q \phi_{iq} a_q}{\sum_q m_q \phi_{iq}} ,
   * @f] A applied `n_passes` times among the particles of a material. What the nodes get is the adjoint of that: the
   * mean stress p = tr sigma / d acts as @f$ (m/V) A^T (V p/m) @f$, with the weights of the same step, so that force
   * and strain exchange no energy but that of the law. F, J and V of the particles are those of f-bar; their grad v
   * stays. The change of volume is averaged, not the volume: what the average does not see is never seen, wherever
   * particles go. Zhao, Jiang & Choo (2023) average J, and do not average the stress. Kernels are not corrected at the
   * domain's faces, so that no weight of a product kernel is negative; what is missing is divided out. Theory:
   * doc/materials.md. Test: tests/transfer/averaging.cc.
   */
  template <int dim>
  class FBar
  {
  public:
    explicit FBar(Parameters &parameters) : averaging(parameters, "none") {}

    bool         is_on    = false;
    unsigned int n_passes = 2; // two: a wave of two spacings leaves 2 % of itself

    /** Adds its fields to the particles. Before the first particle exists. */
    void add_fields(WorkingSet<dim> &particles);

    /** Before the first step. */
    void initialize(Particles<dim> &particles);

    /** Makes the stress that of the nodes' forces, where particles are. Before a transfer to the nodes. Collective. */
    void average_stress(const unsigned int n_materials, const Kernel<dim> &kernel, Particles<dim> &particles,
                        const Grid<dim> &grid);

    /** Leaves the stress of the law, and puts back what has been added to it: around a step of the law. */
    void remove_added(Particles<dim> &particles, const unsigned int begin, const unsigned int end) const
    {
      change_stress(particles, -1, begin, end);
    }
    void add_added(Particles<dim> &particles, const unsigned int begin, const unsigned int end) const
    {
      change_stress(particles, 1, begin, end);
    }

    /** Remembers where particles are, before they move. */
    void start(const Particles<dim> &particles);

    /** Sets the velocity gradient by which particles deform, from theirs, with the weights of start(). Collective. */
    void average_rate(const unsigned int n_materials, const Kernel<dim> &kernel, const double dt,
                      Particles<dim> &particles, const Grid<dim> &grid);

  private:
    void change_stress(Particles<dim> &particles, const double sign, const unsigned int begin,
                       const unsigned int end) const;
    /** Averages `mean` of one material's particles, or does the adjoint of that. */
    void average(const MaterialRange &range, const bool is_adjoint, const Kernel<dim> &kernel,
                 Particles<dim> &particles, const Grid<dim> &grid);

    Averaging<dim>      averaging;
    unsigned int        added_stress = 0; // the field
    std::vector<double> mean, own;
    KeptPositions<dim>  positions;
  };
} // namespace Talus

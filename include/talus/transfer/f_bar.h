#pragma once

#include <talus/particles/material_range.h>
#include <talus/particles/particles.h>
#include <talus/transfer/kept_weights.h>

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
   * particles go. Zhao, Jiang & Choo (2023) average J, and do not average the stress. The weights are those of
   * KeptWeights, found once a step; what is missing at the domain's faces is divided out. Theory:
   * doc/materials.md. Test: tests/transfer/f_bar.cc.
   */
  template <int dim>
  class FBar
  {
  public:
    bool         is_on    = false;
    unsigned int n_passes = 2; // two: a wave of two spacings leaves 2 % of itself

    /** Adds its fields to the particles. Before the first particle exists. */
    void add_fields(WorkingSet<dim> &particles);

    /** Before the first step. */
    void initialize(Particles<dim> &particles);

    /** Finds the weights of a step, where particles are. Collective. */
    void start(const unsigned int n_materials, const Kernel<dim> &kernel, Particles<dim> &particles,
               const Grid<dim> &grid);

    /** Makes the stress that of the nodes' forces. After start() and before a transfer to the nodes. Collective. */
    void average_stress(Particles<dim> &particles, const Grid<dim> &grid);

    /** Leaves the stress of the law, and puts back what has been added to it: around a step of the law. */
    void remove_added(Particles<dim> &particles, const unsigned int begin, const unsigned int end) const
    {
      change_stress(particles, -1, begin, end);
    }
    void add_added(Particles<dim> &particles, const unsigned int begin, const unsigned int end) const
    {
      change_stress(particles, 1, begin, end);
    }

    /** Sets the velocity gradient by which particles deform, from theirs, with the weights of start(). Collective. */
    void average_rate(const double dt, Particles<dim> &particles, const Grid<dim> &grid);

  private:
    void change_stress(Particles<dim> &particles, const double sign, const unsigned int begin,
                       const unsigned int end) const;

    /** Averages `mean` among the particles of each material, or does the adjoint of that. */
    void average(const bool is_adjoint, Particles<dim> &particles, const Grid<dim> &grid);

    /** Sums of the particles' masses times `numbers` at the nodes, of all ranks, at their owners. */
    void scatter(const MaterialRange &range, const double *numbers, const Grid<dim> &grid, NodalArray<1> &to);

    KeptWeights<dim>           weights;
    std::vector<NodalArray<1>> mass; // at the nodes, of each material
    NodalArray<1>              means;
    unsigned int               added_stress = 0; // the field
    std::vector<double>        mean, own, product;
  };
} // namespace Talus

#pragma once

#include <talus/core/body_force.h>
#include <talus/grid/grid.h>
#include <talus/kernels/kernel.h>
#include <talus/particles/particles.h>

namespace Talus
{
  /**
   * Averages numbers of particles over the grid,
   * @f[ a_i = \frac{\sum_p m_p \phi_{ip} (a_p + g_p \cdot (x_i - x_p))}{\sum_p m_p \phi_{ip}} , \quad
   *     a_p = \sum_i \phi_{ip} a_i , \quad g_p = \sum_i a_i \nabla\phi_{ip} , @f]
   * by the loops that carry velocities, v = (a, b, ..) and C = (g, ..): they do for any kernel. Kernels that are
   * products over the axes have a boundary treatment of their own here, which must not mirror nodes: a mirror image
   * changes the sign of velocities. The nodes' sums have an array of their own; the grid's fields stay those of the
   * step. Test: tests/transfer/averaging.cc.
   */
  template <int dim>
  class Averaging
  {
  public:
    /** `treatment` is a registered boundary treatment, the kernel's own where it is not a product over the axes. */
    Averaging(Parameters &parameters, const std::string &treatment);

    /** What is averaged: an array of numbers and those of their gradient [1/length], of all particles. */
    struct Quantity
    {
      double                   *value = nullptr;
      std::array<double *, dim> gradient{}; // null: constant around each particle, and none is wanted
    };

    /**
     * Replaces numbers of the particles begin .. end - 1 by their averages among these; unused quantities have no
     * arrays. Nodes without mass have the numbers of `empty`. Collective.
     */
    void apply(const std::array<Quantity, dim> &quantities, const std::array<double, dim> &empty,
               Particles<dim> &particles, const unsigned int begin, const unsigned int end, const Kernel<dim> &kernel,
               const Grid<dim> &grid);

  private:
    std::unique_ptr<Treatment<dim>> treatment;
    NodalFields<dim>                fields;
    std::vector<double>             zeros, unused; // of each particle: what is read, and written, of no quantity
    BodyForce<dim>                  no_force;
  };
} // namespace Talus

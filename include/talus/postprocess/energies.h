#pragma once

#include <talus/core/reduction.h>
#include <talus/core/table.h>
#include <talus/materials/material.h>
#include <talus/transfer/transfer.h>

namespace Talus
{
  /** Sums over all particles of all ranks, their greatest speed, and how far they reach. */
  template <int dim>
  struct Totals
  {
    /** An angular momentum has one component in 2D, about z, and three in 3D. */
    static constexpr unsigned int n_rotations = dim == 2 ? 1 : 3;
    using Rotation                            = dealii::Tensor<1, n_rotations>;

    double                 mass           = 0; // [mass]
    double                 volume         = 0; // [volume]
    double                 kinetic_energy = 0; // sum m v . v / 2 [energy]
    double                 strain_energy  = 0; // sum V w(sigma) [energy]
    double                 plastic_work   = 0; // what plastic flow has taken [energy]
    double                 greatest_speed = 0; // [length/time]
    dealii::Tensor<1, dim> least, greatest;    // position along each axis [length]
    dealii::Tensor<1, dim> momentum;           // sum m v [mass length/time]
    Rotation               angular_momentum;   // sum m x cross v, about the origin [mass length^2/time]

    /** The same with what the affine field of each particle holds: plus sum m eps_ijk B_kj. */
    Rotation total_angular_momentum;

    void add_to(Reduction &reduction);
    void add_to(Table &table) const;
  };

  /**
   * The totals. B is the transfer's affine_moment(), sum phi v (x) (x_i - x_p);
   * a transfer that keeps none has the same total as without. Collective.
   * Test: tests/postprocess/energies.cc.
   */
  template <int dim>
  Totals<dim> totals(WorkingSet<dim> &particles, const Transfer<dim> &transfer,
                     const std::vector<std::unique_ptr<Material>> &materials, const Communicator &communicator);
} // namespace Talus

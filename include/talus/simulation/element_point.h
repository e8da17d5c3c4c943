#pragma once

#include <talus/materials/material.h>

namespace Talus
{
  /**
   * One material point with what a particle carries of it, outside of any grid. A step does to it what a step of a run
   * does to a particle: source/steppers/deformation.cc. Copies are points of their own. Test: tests/element.
   */
  class ElementPoint
  {
  public:
    /** At rest under a stress xx, yy, zz, xy, xz, yz that the material does not refuse. */
    ElementPoint(const Material &material, const std::array<double, 6> &stress);

    /** A step of length dt in which the material moves by `increment` = dt grad v, the relative deformation less I. */
    void advance(const dealii::Tensor<2, 3> &increment, const double dt);

    /** Whether the last step was one: the volume is positive and all of the stress finite. */
    bool is_sound() const;

    double volume_ratio() const { return volume / initial_volume; } // since the start [1]
    double strain_energy_density() const;                           // [stress]
    double plastic_work_density() const;                            // [stress]

    /** Modulus of pressure waves, rho c^2 [stress]. */
    double stiffness() const;

    dealii::Tensor<2, 3>  F; // since the start, also of a fluid [1]
    std::array<double, 6> stress;

    std::array<double, MaterialRange::max_states> state{};

  private:
    MaterialRange range(const double dt);

    const Material      *material;
    dealii::Tensor<2, 3> grad_v, seen_F; // what the material sees
    double               mass, volume = 1;

    static constexpr double initial_volume = 1;
  };

  /** The tensor of xx, yy, zz, xy, xz, yz. */
  inline dealii::SymmetricTensor<2, 3> tensor_of(const std::array<double, 6> &components)
  {
    dealii::SymmetricTensor<2, 3> tensor;
    for (unsigned int c = 0; c < 6; ++c)
      tensor.access_raw_entry(c) = components[c];
    return tensor;
  }
} // namespace Talus

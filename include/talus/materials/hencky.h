#pragma once

#include <talus/materials/von_mises.h>

namespace Talus
{
  /**
   * Logarithmic elasticity for finite strains with the plasticity of VonMises,
   * @f[ \epsilon = \tfrac12 \ln b_e , \quad W = \tfrac{K}{2} (\mathrm{tr}\,\epsilon)^2 + G\,|\mathrm{dev}\,\epsilon|^2
   * , \quad J \sigma = K\,\mathrm{tr}\,\epsilon\, I + 2 G\,\mathrm{dev}\,\epsilon , \quad \sqrt{3/2}\,|J s| \le
   * \sigma_Y(\bar\varepsilon) , @f] W per stress-free volume, J = exp(tr epsilon) the volume over the stress-free one.
   * A step takes b_e to f b_e f^T, f = I + dt grad v, and returns along its eigenvectors, which the exponential map
   * makes the return of small strains: Simo (1992), Weber & Anand (1990); the plastic flow keeps the volume. State:
   * equivalent plastic strain [1] and (b_e - I) / 2 [1], the elastic strain where it is small. A body may start with a
   * stress of its own. Theory: doc/materials.md. Test: tests/materials/hencky.cc.
   */
  class Hencky : public VonMises
  {
  public:
    using VonMises::VonMises;

    std::vector<std::string> state_names() const override;

    /** Throws EntryError for a pressure or tension that no volume gives. */
    std::vector<double> initial_states(const std::array<double, 6> &stress) const override;

    void update(const MaterialRange &range) const override;

    /** An upper bound, sharp without stress: rho c^2 <= (K + 4/3 G)/J - the least principal stress. */
    void wave_speeds(const MaterialRange &range, double *speeds) const override;
    void strain_energy_densities(const MaterialRange &range, double *densities) const override;
    void plastic_work_densities(const MaterialRange &range, double *densities) const override;

    std::string refusal(const std::array<double, 6> &initial_stress) const override;
  };
} // namespace Talus

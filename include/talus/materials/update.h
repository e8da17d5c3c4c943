#pragma once

#include <talus/materials/material.h>

namespace Talus
{
  /**
   * Runs `law(grad_v_dt, stress, p)` over a range: it receives the increment
   * dt grad v and the old Cauchy stress as 3x3 tensors, and returns the new stress.
   */
  template <class Law>
  void update_stress(const MaterialRange &range, const Law &law)
  {
    const auto run = [&](const auto n) {
      // The tensors' in-plane components; out of plane grad v is zero.
      constexpr unsigned int dim      = decltype(n)::value;
      constexpr unsigned int n_stress = dim == 2 ? 4 : 6;
      for (unsigned int p = range.begin; p < range.end; ++p)
      {
        dealii::Tensor<2, 3> grad_v_dt;
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = 0; j < dim; ++j)
            grad_v_dt[i][j] = range.dt * range.grad_v[3 * i + j][p];
        dealii::SymmetricTensor<2, 3> stress;
        for (unsigned int c = 0; c < n_stress; ++c)
          stress.access_raw_entry(c) = range.stress[c][p];
        stress = law(grad_v_dt, stress, p);
        for (unsigned int c = 0; c < n_stress; ++c)
          range.stress[c][p] = stress.access_raw_entry(c);
      }
    };
    if (range.grad_v[8] == nullptr)
      run(std::integral_constant<unsigned int, 2>());
    else
      run(std::integral_constant<unsigned int, 3>());
  }

  /**
   * The part of Eq. (28) that turns the stress with the material,
   * @f[ \Delta\omega \cdot \sigma - \sigma \cdot \Delta\omega . @f]
   */
  template <typename Number>
  dealii::SymmetricTensor<2, 3, Number> jaumann_increment(const dealii::Tensor<2, 3, Number>          &grad_v_dt,
                                                          const dealii::SymmetricTensor<2, 3, Number> &stress)
  {
    const Number xy = 0.5 * (grad_v_dt[0][1] - grad_v_dt[1][0]), xz = 0.5 * (grad_v_dt[0][2] - grad_v_dt[2][0]),
                 yz = 0.5 * (grad_v_dt[1][2] - grad_v_dt[2][1]);
    // omega . sigma plus its transpose, since sigma . omega = -(omega . sigma)^T.
    dealii::SymmetricTensor<2, 3, Number> increment;
    increment[0][0] = 2 * (xy * stress[0][1] + xz * stress[0][2]);
    increment[1][1] = 2 * (yz * stress[1][2] - xy * stress[0][1]);
    increment[2][2] = -2 * (xz * stress[0][2] + yz * stress[1][2]);
    increment[0][1] = xy * (stress[1][1] - stress[0][0]) + xz * stress[1][2] + yz * stress[0][2];
    increment[0][2] = xz * (stress[2][2] - stress[0][0]) + xy * stress[1][2] - yz * stress[0][1];
    increment[1][2] = yz * (stress[2][2] - stress[1][1]) - xy * stress[0][2] - xz * stress[0][1];
    return increment;
  }
} // namespace Talus

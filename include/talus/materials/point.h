#pragma once

#include <talus/core/batch.h>
#include <talus/core/tensors.h>
#include <talus/materials/material.h>

namespace Talus
{
  /**
   * The particles of a batch as one material point: its tensors' numbers hold one
   * particle in each lane. `dim` says which components are stored.
   */
  template <class Batch, int dim>
  struct MaterialPoint
  {
    using Number    = typename Batch::Number;
    using Tensor    = dealii::Tensor<2, 3, Number>;
    using Symmetric = dealii::SymmetricTensor<2, 3, Number>;

    static constexpr unsigned int n_stress = dim == 2 ? 4 : 6;

    const MaterialRange &range;
    const Batch          batch;

    Tensor grad_v() const
    {
      Tensor value;
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          value[i][j] = batch.load(range.grad_v[3 * i + j]);
      return value;
    }
    /** dt grad v */
    Tensor grad_v_dt() const
    {
      Tensor value;
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          value[i][j] = Number(range.dt) * batch.load(range.grad_v[3 * i + j]);
      return value;
    }
    Tensor F() const
    {
      Tensor value;
      value[2][2] = 1.;
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          value[i][j] = batch.load(range.F[3 * i + j]);
      return value;
    }
    Symmetric stress() const
    {
      Symmetric value;
      for (unsigned int c = 0; c < n_stress; ++c)
        value.access_raw_entry(c) = batch.load(range.stress[c]);
      return value;
    }
    Number mass() const { return batch.load(range.mass); }
    Number volume() const { return batch.load(range.volume); }
    Number density() const { return mass() / volume(); }
    Number specific_volume() const { return volume() / mass(); }
    Number state(const unsigned int s) const { return batch.load(range.state[s]); }

    void set_stress(const Symmetric &value) const
    {
      for (unsigned int c = 0; c < n_stress; ++c)
        batch.store(range.stress[c], value.access_raw_entry(c));
    }
    void set_state(const unsigned int s, const Number &value) const { batch.store(range.state[s], value); }
  };

  /** Calls `law(point)` for all points of a range: a generic lambda, so that it is written once for all of them. */
  template <class Law>
  void for_each_point(const MaterialRange &range, const Law &law)
  {
    const auto run = [&](const auto dimension) {
      constexpr int dim = decltype(dimension)::value;
      const auto one = [&](const auto batch) { law(MaterialPoint<std::decay_t<decltype(batch)>, dim>{range, batch}); };
      if (range.is_plain)
        for (unsigned int p = range.begin; p < range.end; ++p)
          one(SingleBatch{p});
      else
        for_each_batch(range.begin, range.end, one);
    };
    if (range.grad_v[8] == nullptr)
      run(std::integral_constant<int, 2>());
    else
      run(std::integral_constant<int, 3>());
  }

  /** Puts `value(point)` of all points of a range into an array. */
  template <class Value>
  void evaluate_points(const MaterialRange &range, double *values, const Value &value)
  {
    for_each_point(range, [&](const auto &point) { point.batch.store(values - range.begin, value(point)); });
  }

  /**
   * The part of Eq. (28) that turns the stress with the material,
   * @f[ \Delta\omega \cdot \sigma - \sigma \cdot \Delta\omega . @f]
   */
  template <typename Number>
  [[gnu::always_inline]] inline dealii::SymmetricTensor<2, 3, Number> jaumann_increment(
    const dealii::Tensor<2, 3, Number> &grad_v_dt, const dealii::SymmetricTensor<2, 3, Number> &stress)
  {
    const Number xy = 0.5 * (grad_v_dt[0][1] - grad_v_dt[1][0]), xz = 0.5 * (grad_v_dt[0][2] - grad_v_dt[2][0]),
                 yz = 0.5 * (grad_v_dt[1][2] - grad_v_dt[2][1]);
    // omega . sigma plus its transpose, since sigma . omega = -(omega . sigma)^T.
    dealii::SymmetricTensor<2, 3, Number> increment;
    increment[0][0] = 2. * (xy * stress[0][1] + xz * stress[0][2]);
    increment[1][1] = 2. * (yz * stress[1][2] - xy * stress[0][1]);
    increment[2][2] = -2. * (xz * stress[0][2] + yz * stress[1][2]);
    increment[0][1] = xy * (stress[1][1] - stress[0][0]) + xz * stress[1][2] + yz * stress[0][2];
    increment[0][2] = xz * (stress[2][2] - stress[0][0]) + xy * stress[1][2] - yz * stress[0][1];
    increment[1][2] = yz * (stress[2][2] - stress[1][1]) - xy * stress[0][2] - xz * stress[0][1];
    return increment;
  }

  /** The stress after an elastic step, Eq. (28) with T of isotropic elasticity; the trial stress of plastic laws. */
  template <class Point>
  typename Point::Symmetric elastic_step(const Point &point, const double lambda, const double G)
  {
    const auto                grad_v_dt = point.grad_v_dt();
    const auto                old       = point.stress();
    const auto                d         = symmetrize(grad_v_dt);
    typename Point::Symmetric stress    = old + 2 * G * d + jaumann_increment(grad_v_dt, old);
    const auto                isotropic = lambda * trace(d);
    for (unsigned int i = 0; i < 3; ++i)
      stress[i][i] += isotropic;
    return stress;
  }
} // namespace Talus

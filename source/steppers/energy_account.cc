#include <talus/steppers/energy_account.h>

#include <deal.II/base/symmetric_tensor.h>

#include <cmath>

namespace Talus
{
  using namespace dealii;

  template <int dim>
  template <class Body>
  void EnergyAccount<dim>::for_each_node(const Grid<dim> &grid, const Walls<dim> &walls, const Body &body)
  {
    for (const unsigned int i : grid.active_nodes)
      body(grid.fields[i]);
    walls.for_each_owned_ghost([&](const unsigned int place) { body(grid.fields.at_place(place)); });
  }

  template <int dim>
  void EnergyAccount<dim>::copy(const Grid<dim> &grid, const Walls<dim> &walls, std::vector<double> &numbers)
  {
    numbers.clear();
    for_each_node(grid, walls, [&](const double *node) { numbers.insert(numbers.end(), node, node + all); });
  }

  template <int dim>
  void EnergyAccount<dim>::start(const Grid<dim> &grid, const Walls<dim> &walls)
  {
    if (is_on)
      copy(grid, walls, before);
  }

  template <int dim>
  void EnergyAccount<dim>::finish(const double dt, const Grid<dim> &grid, const Walls<dim> &walls)
  {
    change = wall_loss = integration_loss = second_loss = 0;
    if (!is_on)
      return;
    first.clear();
    const double *old = before.data();
    for_each_node(grid, walls, [&](const double *now) {
      first.insert(first.end(), now + Fields::velocity, now + Fields::velocity + dim);
      if (const double m = old[Fields::mass]; m > grid.mass_floor)
        for (unsigned int d = 0; d < dim; ++d)
        {
          const double v0 = old[Fields::momentum + d] / m, dv = dt * old[Fields::force + d] / m;
          const double v1 = now[Fields::velocity + d];
          change += 0.5 * m * (v1 - v0) * (v1 + v0);
          // Free velocities differ by round-off.
          const bool is_free = std::abs(v1 - (v0 + dv)) <= 1e-12 * (std::abs(v0) + std::abs(dv) + std::abs(v1));
          (is_free ? integration_loss : wall_loss) += 0.5 * m * (v1 - v0) * (v1 - v0);
        }
      old += all;
    });
  }

  template <int dim>
  void EnergyAccount<dim>::restart(const Grid<dim> &grid, const Walls<dim> &walls)
  {
    if (is_on)
      copy(grid, walls, stress);
  }

  template <int dim>
  void EnergyAccount<dim>::repeat(const double dt, const Grid<dim> &grid, const Walls<dim> &walls)
  {
    if (!is_on)
      return;
    const double *force = stress.data(), *v = first.data();
    for_each_node(grid, walls, [&](const double *now) {
      for (unsigned int d = 0; d < dim; ++d)
        second_loss += dt * force[Fields::force + d] * (now[Fields::velocity + d] - v[d]);
      force += all;
      v += dim;
    });
  }

  template <int dim>
  void EnergyAccount<dim>::count_stress(const MaterialRange &range, const bool is_end)
  {
    const double dt  = range.dt;
    double       sum = 0;
    for (unsigned int p = range.begin; p < range.end; ++p)
    {
      Tensor<2, dim> L, f = unit_symmetric_tensor<dim>(), stress;
      for (unsigned int d = 0; d < dim; ++d)
        for (unsigned int e = 0; e < dim; ++e)
        {
          L[d][e] = range.grad_v[3 * d + e][p];
          f[d][e] += dt * L[d][e];
          stress[d][e] = range.stress[d == e ? d : 2 + d + e][p];
        }
      // The volume is that of the end.
      sum += is_end ? range.volume[p] * scalar_product(stress, L * invert(f)) :
                      range.volume[p] / determinant(f) * scalar_product(stress, L);
    }
    integration_loss -= (is_end ? 0.5 : -0.5) * dt * sum;
  }

  template <int dim>
  void EnergyAccount<dim>::add_to(Reduction &reduction)
  {
    if (!is_on)
      return;
    reduction.sum(change);
    reduction.sum(wall_loss);
    reduction.sum(integration_loss);
    reduction.sum(second_loss);
  }

  template class EnergyAccount<2>;
  template class EnergyAccount<3>;
} // namespace Talus

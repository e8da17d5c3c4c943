#include <talus/grid/walls.h>

namespace Talus
{
  using namespace dealii;

  template <int dim>
  void Walls<dim>::find_presses()
  {
    presses.clear();
    for (unsigned int r = 0; r < real_node.size(); ++r)
      for (unsigned int d = 0; state[r] >> pressed_below != 0 && d < dim; ++d)
        if (!asks(r, held, d) && (asks(r, pressed_below, d) || asks(r, pressed_above, d)))
        {
          Press one;
          one.real    = r;
          one.axis    = d;
          one.outward = asks(r, pressed_below, d) ? -1 : 1;
          presses.push_back(one);
        }
  }

  template <int dim>
  double Walls<dim>::fix(const unsigned int r, const unsigned int c, const double velocity)
  {
    Unknowns &of   = unknowns[c];
    of.v[r]        = velocity;
    of.is_fixed[r] = true;
    solve_block(c, rows[c].block[r], of.v);
    return factor.residual(rows[c].local[r]);
  }

  template <int dim>
  void Walls<dim>::press(Press &press, const double dt)
  {
    const unsigned int r = press.real, n = press.axis;
    const auto         wall = [&](const unsigned int d) { return record(r, wall_velocity + dim * n + d); };
    const double       tau = record(r, account_time + n), mu = record(r, friction + n);
    double             J = 0;
    if (press.outward * (unknowns[n].v[r] - wall(n)) > 0 && !unknowns[n].is_fixed[r])
    {
      J              = std::max(0., press.outward * fix(r, n, wall(n)));
      press.fixes[n] = press.acts = true;
    }
    double most = J;
    if (tau > 0)
    {
      const double share = std::min(1., dt / tau);
      press.mean         = record(r, mean_before + n) + share * (J - record(r, mean_before + n));
      press.account      = (1 - share) * record(r, account_before + n) + J;
      most               = std::min(press.account, std::max(J, 10 * press.mean));
    }
    press.acts = press.acts || most > 0;
    if (!press.acts)
      return;

    // What sticking would take; if that is too much, the node slides, and the wall takes what it can.
    Tensor<1, dim> impulse;
    for (unsigned int c = 0; c < dim; ++c)
      if (c != n && !asks(r, held, c) && !unknowns[c].is_fixed[r])
      {
        press.fixes[c] = true;
        impulse[c]     = fix(r, c, wall(c));
      }
    const double limit = mu * most;
    if (impulse.norm() <= limit)
    {
      press.account -= limit > 0 ? impulse.norm() / mu : 0.;
      return;
    }
    press.account = 0;
    for (unsigned int c = 0; c < dim; ++c)
      if (c != n && press.fixes[c])
      {
        Unknowns &of   = unknowns[c];
        press.fixes[c] = false;
        of.is_fixed[r] = false;
        press.load[c]  = limit * impulse[c] / impulse.norm();
        of.load[r] += press.load[c];
        solve_block(c, rows[c].block[r], of.v);
      }
  }

#define INSTANTIATE(dim)                                                                                               \
  template void   Walls<dim>::find_presses();                                                                          \
  template void   Walls<dim>::press(Press &, const double);                                                            \
  template double Walls<dim>::fix(const unsigned int, const unsigned int, const double);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Talus

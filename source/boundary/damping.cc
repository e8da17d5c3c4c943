#include <talus/boundary/damping.h>

#include <cmath>

namespace Talus
{
  template <int dim>
  void LocalDamping<dim>::apply(const std::vector<unsigned int> &nodes, const HeldComponents<dim> &held,
                                Grid<dim> &grid)
  {
    work = 0;
    if (!(factor > 0))
      return;
    using Fields = NodalFields<dim>;
    for (const unsigned int i : nodes)
    {
      double *node = grid.fields[i];
      for (unsigned int d = 0; d < dim; ++d)
      {
        double &v = node[Fields::velocity + d], &increment = node[Fields::increment + d];
        // The increment is dt f_i / m_i where no condition acts.
        const double v_before = v - increment;
        if (held(i, d) || v_before == 0)
          continue;
        const double change = -factor * std::copysign(increment, v_before);
        v += change;
        increment += change;
        work += node[Fields::mass] * change * v;
      }
    }
  }

  template class LocalDamping<2>;
  template class LocalDamping<3>;
} // namespace Talus

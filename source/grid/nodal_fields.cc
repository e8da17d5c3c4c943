#include <talus/grid/nodal_fields.h>

namespace Talus
{
  template <int dim>
  typename NodalFields<dim>::MirrorFactors NodalFields<dim>::make_mirror_factors()
  {
    MirrorFactors factors;
    for (unsigned int faces = 0; faces < factors.size(); ++faces)
    {
      factors[faces].fill(1.);
      for (unsigned int d = 0; d < dim; ++d)
        if (faces >> 2 * d & 3)
          factors[faces][velocity + d] = factors[faces][increment + d] = -1.;
    }
    return factors;
  }

  template <int dim>
  const typename NodalFields<dim>::MirrorFactors NodalFields<dim>::mirror_factors = make_mirror_factors();

  template class NodalFields<2>;
  template class NodalFields<3>;
} // namespace Talus

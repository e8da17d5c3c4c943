#include <talus/grid/nodal_fields.h>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    /** Every index of `nodes` replaced by its block of `stride` indices. */
    IndexSet blocked(const IndexSet &nodes, const unsigned int stride)
    {
      IndexSet indices(nodes.size() * stride);
      for (auto interval = nodes.begin_intervals(); interval != nodes.end_intervals(); ++interval)
        indices.add_range(*interval->begin() * stride, (interval->last() + 1) * stride);
      indices.compress();
      return indices;
    }
  } // namespace

  template <int dim>
  void NodalFields<dim>::reinit(const IndexSet &owned_nodes, const IndexSet &relevant_nodes, MPI_Comm communicator)
  {
    static_assert(1 + 2 * dim <= stride, "mass and two vectors must fit");
    values.reinit(blocked(owned_nodes, stride), blocked(relevant_nodes, stride), communicator);
  }

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

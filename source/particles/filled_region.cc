#include <talus/particles/filled_region.h>

namespace Talus
{
  using namespace dealii;

  template <int dim>
  void FilledRegion<dim>::prepare()
  {
    read();
    const auto corners = bounding_box().get_boundary_points();
    lower              = corners.first;
    upper              = corners.second;
  }

  template <int dim>
  bool FilledRegion<dim>::has(const Point &x) const
  {
    for (unsigned int d = 0; d < dim; ++d)
      if (!is_curved(d) && !(x[d] >= lower[d] && x[d] < upper[d]))
        return false;
    return contains(x);
  }

  template <int dim>
  bool FilledRegion<dim>::holds(const Point &lower, const Point &upper) const
  {
    return holds_on_lattice<dim>(lower, upper, 4, [&](const Point &x) { return contains(x); });
  }

  template class FilledRegion<2>;
  template class FilledRegion<3>;
} // namespace Talus

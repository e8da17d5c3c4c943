#pragma once

#include <deal.II/base/patterns.h>
#include <deal.II/base/point.h>

#include <vector>

namespace Talus
{
  /** The point that a list of an entry gives. */
  template <int dim>
  dealii::Point<dim> to_point(const std::vector<double> &list)
  {
    dealii::Point<dim> x;
    for (unsigned int d = 0; d < dim; ++d)
      x[d] = list[d];
    return x;
  }

  /** What such an entry may be: `dim` numbers. */
  inline dealii::Patterns::List coordinates(const int dim)
  {
    return dealii::Patterns::List(dealii::Patterns::Double(), dim, dim);
  }
} // namespace Talus

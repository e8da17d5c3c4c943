#pragma once

#include <talus/postprocess/particle_fields.h>

#include <limits>

namespace Talus
{
  /** Where the components of a field stand in an array that ParaView reads, and what its other numbers are. */
  struct ArrayLayout
  {
    std::vector<unsigned int> place; // of each component
    std::vector<float>        others;
    std::vector<std::string>  names; // of components; none where ParaView has its own
  };

  /** One number, three of a vector, six of a symmetric tensor in ParaView's order, or nine; none for all others. */
  template <int dim>
  ArrayLayout layout_of(const ParticleField<dim> &field);

  /** In single precision; what lies beyond its range becomes the greatest number that it has, not infinite. */
  inline float single(const double value)
  {
    constexpr double greatest = std::numeric_limits<float>::max();
    return static_cast<float>(value > greatest ? greatest : value < -greatest ? -greatest : value);
  }

  /** Name of the array: with underscores. */
  template <int dim>
  std::string array_name(const ParticleField<dim> &field);
} // namespace Talus

#pragma once

#include <talus/postprocess/particle_fields.h>

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

  /** Name of the array: with underscores. */
  template <int dim>
  std::string array_name(const ParticleField<dim> &field);
} // namespace Talus

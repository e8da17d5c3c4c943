#include "particle_layout.h"

#include <algorithm>

namespace Talus
{
  template <int dim>
  ArrayLayout layout_of(const ParticleField<dim> &field)
  {
    const unsigned int n       = field.components.size();
    const auto         ends_in = [&](const unsigned int c, const std::string &end) {
      const std::string &name = field.components[c];
      return name.size() > end.size() && name.compare(name.size() - end.size(), end.size(), end) == 0;
    };
    if (n == 1)
      return {{0}, {0.f}, {}};
    ArrayLayout layout;
    for (unsigned int c = 0; c < n; ++c)
      layout.place.push_back(c);
    if (field.is_vector)
      layout.others.assign(3, 0.f);
    else if (n >= 4 && ends_in(0, "_xx") && ends_in(2, "_zz"))
    {
      // xx, yy, zz, xy, xz, yz
      layout.others.assign(6, 0.f);
      if (n == 6)
        std::swap(layout.place[4], layout.place[5]);
      layout.names = {"XX", "YY", "ZZ", "XY", "YZ", "XZ"};
    }
    else if (n == dim * dim && ends_in(0, "_xx") && ends_in(1, "_xy"))
    {
      layout.others.assign(9, 0.f);
      for (unsigned int c = 0; c < n; ++c)
        layout.place[c] = 3 * (c / dim) + c % dim;
      if (dim == 2 && field.name == "deformation gradient")
        layout.others[8] = 1;
      layout.names = {"XX", "XY", "XZ", "YX", "YY", "YZ", "ZX", "ZY", "ZZ"};
    }
    return layout;
  }

  template <int dim>
  std::string array_name(const ParticleField<dim> &field)
  {
    std::string name = field.name;
    std::replace(name.begin(), name.end(), ' ', '_');
    return name;
  }

  template ArrayLayout layout_of(const ParticleField<2> &);
  template ArrayLayout layout_of(const ParticleField<3> &);
  template std::string array_name(const ParticleField<2> &);
  template std::string array_name(const ParticleField<3> &);
} // namespace Talus

#include <talus/core/exceptions.h>
#include <talus/materials/material.h>

namespace Talus
{
  using namespace dealii;

  Material::Material(const std::string &section) : ParameterAcceptor(section)
  {
    add_parameter("Density", density,
                  "Mass per volume in the initial state, of a fluid at zero pressure [mass/volume].", prm,
                  Patterns::Double());
  }

  void Material::parse_parameters(ParameterHandler &)
  {
    if (!(density > 0))
      throw EntryError(get_section_name(), "Density", "it must be positive.");
  }
} // namespace Talus

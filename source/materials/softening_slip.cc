#include <talus/core/exceptions.h>
#include <talus/materials/softening_slip.h>

#include <sstream>

namespace Talus
{
  using namespace dealii;

  void SofteningSlip::add_entries(ParameterAcceptor &law, const std::string &what)
  {
    law.add_parameter("Softening slip", slip,
                      what + " [length]; 0: by strain. What a shear band takes then does not hang on the spacing.",
                      law.prm, Patterns::Double());
    law.add_parameter("Band width", width,
                      "Of 'Softening slip': how wide a shear band is, in spacings of the grid [1].", law.prm,
                      Patterns::Double());
  }

  void SofteningSlip::check(const std::string &section) const
  {
    if (!(slip >= 0))
      throw EntryError(section, "Softening slip", "it must be positive, or 0 for softening by strain.");
    if (!(width > 0))
      throw EntryError(section, "Band width", "it must be positive; bands are two or three spacings wide.");
  }

  void SofteningSlip::check_spacing(const std::string &section, const double spacing, const double drop,
                                    const double G) const
  {
    const double largest = slip * G / (drop * width);
    if (spacing < largest)
      return;
    std::ostringstream text;
    text
      << "the strength falls faster than the ground beside a band unloads, which has no unique answer. Take a spacing "
         "below "
      << largest << ", a longer slip, or a lower peak strength.";
    throw EntryError(section, "Softening slip", text.str());
  }
} // namespace Talus

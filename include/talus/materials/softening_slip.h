#pragma once

#include <deal.II/base/parameter_acceptor.h>

#include <cmath>
#include <string>

namespace Talus
{
  /**
   * Softening over the slip u of a shear band instead of over a strain, so that what a band takes per area does not
   * hang on the grid: a band is `width` spacings h wide, and simple shear by gamma_p = u/(width h) has the equivalent
   * plastic strain gamma_p/sqrt(3). Theory: doc/ground.md. Test: tests/materials/softening_slip.cc.
   */
  class SofteningSlip
  {
  public:
    /** Adds the entries to the section of a law; `what` says over what the slip is counted. */
    void add_entries(dealii::ParameterAcceptor &law, const std::string &what);

    /** Throws EntryError. */
    void check(const std::string &section) const;

    bool is_given() const { return slip > 0; }

    /** The equivalent plastic strain of a band that has slipped by that [1]. */
    double strain(const double spacing) const { return slip / (std::sqrt(3.) * width * spacing); }

    /**
     * Throws EntryError where the shear strength, which falls by `drop`/slip per slip at first, falls faster than the
     * ground beside the band unloads with the shear modulus G.
     */
    void check_spacing(const std::string &section, const double spacing, const double drop, const double G) const;

  private:
    double slip  = 0;   // [length]
    double width = 2.5; // [1]
  };
} // namespace Talus

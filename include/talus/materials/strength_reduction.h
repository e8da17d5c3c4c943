#pragma once

#include <talus/core/exceptions.h>

#include <deal.II/base/numbers.h>
#include <deal.II/base/parameter_acceptor.h>

#include <cmath>
#include <string>

namespace Talus
{
  /**
   * The factor by which strengths are divided to see how safe something is: cohesion, yield stress, and the tangents of
   * the angles of friction and dilatancy. Theory: doc/ground.md. Test: tests/materials/strength_reduction.cc.
   */
  class StrengthReduction
  {
  public:
    /** Adds the entry to the section of a law. */
    void add_entry(dealii::ParameterAcceptor &law)
    {
      law.add_parameter("Strength reduction", factor,
                        "Strengths are divided by it: cohesion, yield stress, the tangents of the angles of friction "
                        "and dilatancy [1].",
                        law.prm, dealii::Patterns::Double());
    }

    /** Throws EntryError. */
    void check(const std::string &section) const
    {
      if (!(factor > 0))
        throw EntryError(section, "Strength reduction", "it must be positive; 1 leaves strengths as they are.");
    }

    /** Divides each strength [stress]. */
    template <class... Strengths>
    void reduce(Strengths &...strengths) const
    {
      ((strengths /= factor), ...);
    }

    /** Divides the tangent of each angle [degrees]; a factor of 1 changes no digit. */
    template <class... Angles>
    void reduce_angles(Angles &...angles) const
    {
      constexpr double degree = dealii::numbers::PI / 180;
      if (factor != 1)
        ((angles = std::atan(std::tan(angles * degree) / factor) / degree), ...);
    }

  private:
    double factor = 1;
  };
} // namespace Talus

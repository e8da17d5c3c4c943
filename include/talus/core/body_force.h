#pragma once

#include <talus/core/function.h>

#include <utility>

namespace Talus
{
  /**
   * The body force per mass [length/time^2]: formulas of the place where a particle is and of time, or any function
   * of the place where it began. Loops ask once whether it is uniform; see value().
   */
  template <int dim>
  class BodyForce
  {
  public:
    using Point    = dealii::Point<dim>;
    using Vector   = dealii::Tensor<1, dim>;
    using Function = std::function<Vector(const Point &X, const double time)>;

    /** Formulas; a bad one is blamed on `entry` of `section` by an EntryError. */
    void initialize(const std::string &expressions, const std::string &section, const std::string &entry)
    {
      formulas.initialize(expressions, section, entry);
    }

    /** A function of initial positions instead of the formulas. */
    void initialize(Function function) { of_initial_position = std::move(function); }

    bool is_zero() const { return !of_initial_position && formulas.is_zero(); }
    bool depends_on_space() const { return is_of_initial_position() || formulas.depends_on_space(); }

    /** Whether value() wants the position in which a particle began, and not the one in which it is. */
    bool is_of_initial_position() const { return static_cast<bool>(of_initial_position); }

    Vector value(const Point &x, const double time) const
    {
      return of_initial_position ? of_initial_position(x, time) : formulas.value(x, time);
    }

    /** The value everywhere, for one that does not depend on space; else zero. */
    Vector uniform_value(const double time) const { return depends_on_space() ? Vector() : value({}, time); }

  private:
    ParsedVector<dim> formulas;
    Function          of_initial_position;
  };
} // namespace Talus

#pragma once

#include <deal.II/base/function_parser.h>
#include <deal.II/base/tensor.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace Talus
{
  /**
   * A vector-valued function of x, y, z, t from the parameter file, evaluated by
   * muParser: "expression; expression", one for each component.
   */
  template <int dim>
  class ParsedVector
  {
  public:
    /** Sets the function; a bad expression is blamed on `entry` of `section` by an EntryError. */
    void initialize(const std::string &expressions, const std::string &section, const std::string &entry);

    /** Value at `x` and `time`. Throws EntryError, with formula, place and time, where it is not finite. */
    dealii::Tensor<1, dim> value(const dealii::Point<dim> &x, const double time) const;

    /** The same, whatever it is. */
    dealii::Tensor<1, dim> evaluate(const dealii::Point<dim> &x, const double time) const;

    /** One component of it. */
    double component(const dealii::Point<dim> &x, const double time, const unsigned int c) const;

    bool is_zero() const { return zero; }
    bool depends_on_space() const { return varies; }

  private:
    std::unique_ptr<dealii::FunctionParser<dim>> parser;
    std::string                                  expressions, section, entry;
    bool                                         zero   = true;
    bool                                         varies = false;
    std::optional<dealii::Tensor<1, dim>>        constant; // what it is everywhere and always
  };

  /**
   * A condition on places from the parameter file, "y < 3 + 0.2*sin(x) && x > 1": a formula of x, y, z that is not 0
   * where it holds. Test: tests/inputs (where), tests/particles/regions.cc.
   */
  template <int dim>
  class ParsedCondition
  {
  public:
    /** Sets it; an empty one holds everywhere. A bad formula is blamed on `entry` of `section` by an EntryError. */
    void initialize(const std::string &expression, const std::string &section, const std::string &entry);

    bool is_given() const { return given; }

    /** Throws EntryError where the formula has no finite value. */
    bool holds(const dealii::Point<dim> &x) const;

  private:
    ParsedVector<dim> formula; // the same for all components
    std::string       expression, section, entry;
    bool              given = false;
  };

  /** A number as a function of x, y, z, t from the parameter file. Test: tests/core/others.cc. */
  template <int dim>
  class ParsedScalar
  {
  public:
    /** Sets it; a bad formula is blamed on `entry` of `section` by an EntryError. */
    void initialize(const std::string &expression, const std::string &section, const std::string &entry);

    /** Throws EntryError where the formula has no finite value. */
    double value(const dealii::Point<dim> &x, const double time) const;

    bool is_zero() const { return formula.is_zero(); }
    bool depends_on_space() const { return formula.depends_on_space(); }

  private:
    ParsedVector<dim> formula; // the same for all components
    std::string       expression, section, entry;
  };

  /**
   * Calls `read`, which has deal.II read formulas, and returns in one line why
   * muParser rejects one, or nothing. What deal.II writes to stderr then is dropped.
   */
  std::string formula_error(const std::function<void()> &read);

  /** True when `name` stands in `expression` as a whole word. */
  bool uses_variable(const std::string &expression, const std::string &name);
} // namespace Talus

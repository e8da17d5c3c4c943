#include <talus/core/exceptions.h>
#include <talus/core/function.h>

#include <deal.II/base/numbers.h>
#include <deal.II/base/utilities.h>

#include <cmath>
#include <iostream>
#include <regex>
#include <sstream>

namespace Talus
{
  using namespace dealii;

  bool uses_variable(const std::string &expression, const std::string &name)
  {
    return std::regex_search(expression, std::regex("\\b" + name + "\\b"));
  }

  namespace
  {
    /** What muParser takes and hardly anybody means: it evaluates "9,81" to 81, and "x = 3" sets x. */
    std::string misunderstanding(const std::string &expression)
    {
      int depth = 0;
      for (std::size_t i = 0; i < expression.size(); ++i)
      {
        const char c = expression[i];
        depth += c == '(' ? 1 : c == ')' ? -1 : 0;
        if (c == ',' && depth == 0)
          return "commas separate arguments of functions; write decimal points, and ';' between components";
        const std::string around = (i > 0 ? expression.substr(i - 1, 1) : " ") + expression.substr(i + 1, 1);
        if (c == '=' && around.find_first_of("=<>!") == std::string::npos)
          return "'=' sets a variable; '==' compares";
      }
      return "";
    }

    /** Formulas as they were given: one that stands for all components was given once. */
    std::string as_given(const std::string &expressions)
    {
      const auto list = Utilities::split_string_list(expressions, ';');
      for (const auto &expression : list)
        if (expression != list.front())
          return shortened(expressions);
      return shortened(list.front());
    }
  } // namespace

  std::string formula_error(const std::function<void()> &read)
  {
    std::ostringstream dropped, reason;
    std::streambuf    *terminal = std::cerr.rdbuf(dropped.rdbuf());
    try
    {
      read();
    }
    catch (const ExceptionBase &error)
    {
      error.print_info(reason);
    }
    std::cerr.rdbuf(terminal);
    const std::string said = "The parser said:";
    std::string       text = reason.str();
    if (const auto position = text.find(said); position != std::string::npos)
      text = text.substr(position + said.size());
    text = Utilities::trim(std::regex_replace(text, std::regex("\\s+"), " "));
    while (!text.empty() && text.back() == '.')
      text.pop_back();
    return text;
  }

  template <int dim>
  void ParsedVector<dim>::initialize(const std::string &expressions, const std::string &section,
                                     const std::string &entry)
  {
    const auto list = Utilities::split_string_list(expressions, ';');
    if (list.size() != dim)
      throw EntryError(section, entry,
                       "expected " + std::to_string(dim) + " expressions separated by ';', found " +
                         std::to_string(list.size()) + " in '" + shortened(expressions) + "'.");
    this->expressions = expressions;
    this->section     = section;
    this->entry       = entry;

    zero   = true;
    varies = false;
    constant.reset();
    bool is_constant = true;
    for (const auto &expression : list)
    {
      is_constant = is_constant && !uses_variable(expression, "t") && expression.find("rand") == std::string::npos;
      zero        = zero && (expression == "0" || expression == "0.");
      for (unsigned int d = 0; d < dim; ++d)
        varies = varies || uses_variable(expression, std::string(1, "xyz"[d]));
    }

    const std::string variables = (dim == 2) ? "x,y,t" : "x,y,z,t";
    parser                      = std::make_unique<FunctionParser<dim>>(dim);
    std::string reason;
    for (const auto &expression : list)
      if (reason.empty())
        reason = misunderstanding(expression);
    if (reason.empty())
      reason = formula_error([&] {
        parser->initialize(variables, expressions, {{"pi", numbers::PI}}, true);
        evaluate(Point<dim>(), 0.); // muParser reads a formula when it is first evaluated
      });
    if (!reason.empty())
      throw EntryError(section, entry,
                       "cannot understand '" + as_given(expressions) + "': " + shortened(reason, 200) + ". Use " +
                         variables + ", pi, numbers, + - * / ^, (a > b ? c : d) and functions like sin, sqrt, min.");
    if (is_constant && !varies)
      constant = evaluate(Point<dim>(), 0.);
  }

  template <int dim>
  Tensor<1, dim> ParsedVector<dim>::value(const Point<dim> &x, const double time) const
  {
    const Tensor<1, dim> v = evaluate(x, time);
    for (unsigned int d = 0; d < dim; ++d)
      if (!std::isfinite(v[d]))
      {
        std::ostringstream where;
        where << (varies ? " at " + to_text<dim>(x) + "," : "") << " at t = " << time;
        throw EntryError(section, entry,
                         "the formula '" + as_given(expressions) + "' has no finite value" + where.str() +
                           ". Correct it, so that it is defined everywhere and up to the end of the run.");
      }
    return v;
  }

  template <int dim>
  Tensor<1, dim> ParsedVector<dim>::evaluate(const Point<dim> &x, const double time) const
  {
    if (constant)
      return *constant;
    Tensor<1, dim> v;
    parser->set_time(time);
    for (unsigned int d = 0; d < dim; ++d)
      v[d] = parser->value(x, d);
    return v;
  }

  template <int dim>
  double ParsedVector<dim>::component(const Point<dim> &x, const double time, const unsigned int c) const
  {
    if (constant)
      return (*constant)[c];
    parser->set_time(time);
    return parser->value(x, c);
  }

  template <int dim>
  void ParsedCondition<dim>::initialize(const std::string &expression, const std::string &section,
                                        const std::string &entry)
  {
    given            = !Utilities::trim(expression).empty();
    this->expression = expression;
    this->section    = section;
    this->entry      = entry;
    if (!given)
      return;
    if (expression.find(';') != std::string::npos)
      throw EntryError(section, entry, "it is one condition: join several with && (and) or || (or).");
    if (uses_variable(expression, "t"))
      throw EntryError(section, entry, "it is asked once, before the first step: leave out t.");
    std::string of_components = expression;
    for (unsigned int d = 1; d < dim; ++d)
      of_components += ';' + expression;
    formula.initialize(of_components, section, entry);
  }

  template <int dim>
  bool ParsedCondition<dim>::holds(const Point<dim> &x) const
  {
    if (!given)
      return true;
    const double value = formula.component(x, 0., 0);
    if (!std::isfinite(value))
      throw EntryError(section, entry,
                       "the formula '" + shortened(expression) + "' has no finite value at " + to_text<dim>(x) +
                         ". Correct it, so that it is defined everywhere.");
    return value != 0;
  }

  template <int dim>
  void ParsedScalar<dim>::initialize(const std::string &expression, const std::string &section,
                                     const std::string &entry)
  {
    this->expression = expression;
    this->section    = section;
    this->entry      = entry;
    if (expression.find(';') != std::string::npos)
      throw EntryError(section, entry, "it is one number: give one formula, without ';'.");
    std::string of_components = expression;
    for (unsigned int d = 1; d < dim; ++d)
      of_components += ';' + expression;
    formula.initialize(of_components, section, entry);
  }

  template <int dim>
  double ParsedScalar<dim>::value(const Point<dim> &x, const double time) const
  {
    const double value = formula.component(x, time, 0);
    if (!std::isfinite(value))
    {
      std::ostringstream text;
      text << "the formula '" << shortened(expression) << "' has no finite value at " << to_text<dim>(x)
           << ", t = " << time << ". Correct it, so that it is defined everywhere and up to the end of the run.";
      throw EntryError(section, entry, text.str());
    }
    return value;
  }

  template class ParsedScalar<2>;
  template class ParsedScalar<3>;
  template class ParsedCondition<2>;
  template class ParsedCondition<3>;
  template class ParsedVector<2>;
  template class ParsedVector<3>;
} // namespace Talus

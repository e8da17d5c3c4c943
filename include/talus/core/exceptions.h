#pragma once

#include <deal.II/base/exceptions.h>
#include <deal.II/base/tensor.h>

#include <sstream>
#include <string>

namespace Talus
{
  /** Wrong input: the program ends with exit status 1 and the message alone. */
  class InputError : public dealii::ExceptionBase
  {
  public:
    explicit InputError(std::string message) : message(std::move(message)) {}
    void print_info(std::ostream &out) const override { out << message << '\n'; }

    const std::string message;
  };

  /**
   * Wrong input that can be blamed on one entry of the parameter file. The
   * program puts the file and line where that entry was set before the message.
   */
  class EntryError : public InputError
  {
  public:
    EntryError(const std::string &section, const std::string &entry, std::string message) :
      InputError(std::move(message)), section(section), entry(entry)
    {
    }

    const std::string section, entry;
  };

  /** The run itself failed (diverged, a particle left the grid): exit status 2. */
  class RunError : public dealii::ExceptionBase
  {
  public:
    explicit RunError(std::string message) : message(std::move(message)) {}
    void print_info(std::ostream &out) const override { out << message << '\n'; }

    const std::string message;
  };

  /** A text with its middle left out where it is long: what a message quotes, or a message as a whole. */
  inline std::string shortened(const std::string &text, const std::size_t most = 120)
  {
    return text.size() <= most ? text : text.substr(0, most / 2) + " [...] " + text.substr(text.size() - most / 3);
  }

  /** A point as messages write it: "(0.5, 1)". */
  template <int dim>
  std::string to_text(const dealii::Tensor<1, dim> &x)
  {
    std::ostringstream text;
    for (unsigned int d = 0; d < dim; ++d)
      text << (d == 0 ? "(" : ", ") << x[d];
    return text.str() + ")";
  }
} // namespace Talus

#pragma once

#include <deal.II/base/tensor.h>

#include <functional>
#include <string>
#include <vector>

namespace Talus
{
  /** Name and unit of a column: "kinetic energy", "energy". */
  struct Column
  {
    std::string name, unit;
  };

  /**
   * A table to which rows are appended: a column is a name, a unit and where its number comes from. Each part of a run
   * adds its own columns, so that a new one adds them in one place. Test: tests/core/others.cc.
   */
  class Table
  {
  public:
    using Getter = std::function<double()>;

    void add(const std::string &name, const std::string &unit, Getter getter)
    {
      named.push_back({name, unit});
      getters.push_back(std::move(getter));
    }

    /** A number that is read where it lies, which must outlive the table. */
    void add(const std::string &name, const std::string &unit, const double &number)
    {
      add(name, unit, [&number] { return number; });
    }
    void add(const std::string &, const std::string &, double &&) = delete;

    /** A column for each component: "name x", "name y", ... */
    template <int dim>
    void add(const std::string &name, const std::string &unit, const dealii::Tensor<1, dim> &vector)
    {
      for (unsigned int d = 0; d < dim; ++d)
        add(name + " " + "xyz"[d], unit, [&vector, d] { return vector[d]; });
    }
    template <int dim>
    void add(const std::string &, const std::string &, dealii::Tensor<1, dim> &&) = delete;

    const std::vector<Column> &columns() const { return named; }

    /** The row of this moment. */
    std::vector<double> row() const
    {
      std::vector<double> values;
      for (const auto &getter : getters)
        values.push_back(getter());
      return values;
    }

  private:
    std::vector<Column> named;
    std::vector<Getter> getters;
  };
} // namespace Talus

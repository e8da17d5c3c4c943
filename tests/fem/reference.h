#pragma once

#include <talus/fem/elastic_reference.h>
#include <talus/fem/plastic_reference.h>

#include <deal.II/base/mpi.h>

#include <memory>
#include <random>
#include <string>
#include <vector>

/** What the cases of this program share. */
namespace Test
{
  /** A reference as the section "/FEM reference" of a parameter file describes it. */
  template <class Reference>
  std::unique_ptr<Reference> make(const std::string &text, const MPI_Comm communicator = MPI_COMM_WORLD)
  {
    auto parameters = Talus::Parameters::from_text("subsection FEM reference\n" + text + "end\n");
    auto reference  = std::make_unique<Reference>(parameters, "/FEM reference", communicator);
    parameters.parse();
    return reference;
  }

  template <int dim>
  std::unique_ptr<Talus::ElasticReference<dim>> make_reference(const std::string &text,
                                                               const MPI_Comm     communicator = MPI_COMM_WORLD)
  {
    return make<Talus::ElasticReference<dim>>(text, communicator);
  }

  inline std::string set(const std::string &entry, const std::string &value)
  {
    return "  set " + entry + " = " + value + "\n";
  }

  /** A condition's section; `components` may be empty for all. */
  inline std::string condition(const std::string &name, const std::string &ids, const std::string &formulas,
                               const std::string &components = "")
  {
    return "  subsection " + name + "\n" + set("Boundary ids", ids) + set("Displacement", formulas) +
           (components.empty() ? "" : set("Components", components)) + "  end\n";
  }

  inline std::string conditions(const std::string &names, const std::string &sections)
  {
    return "  subsection Conditions\n" + set("Names", names) + sections + "  end\n";
  }

  /** "n, n" or "n, n, n". */
  template <int dim>
  std::string repeat(const std::string &value)
  {
    return value + ", " + value + (dim == 3 ? ", " + value : "");
  }

  /** Random points of a box, others on each rank (or all alike). */
  template <int dim>
  std::vector<dealii::Point<dim>> random_points(const dealii::Point<dim> &lower, const dealii::Point<dim> &upper,
                                                const unsigned int n, const bool is_same_on_all_ranks = false)
  {
    std::mt19937 generator(is_same_on_all_ranks ? 7 : 7 + dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD));
    std::uniform_real_distribution<double> uniform(0., 1.);
    std::vector<dealii::Point<dim>>        points(n);
    for (auto &point : points)
      for (unsigned int i = 0; i < dim; ++i)
        point[i] = lower[i] + uniform(generator) * (upper[i] - lower[i]);
    return points;
  }
} // namespace Test

#include <talus/core/exceptions.h>
#include <talus/core/memory.h>
#include <talus/fem/box_mesh.h>

#include <deal.II/base/patterns.h>
#include <deal.II/grid/grid_generator.h>

#include <algorithm>
#include <iomanip>
#include <sstream>

namespace Talus
{
  using namespace dealii;

  template <int dim>
  BoxMesh<dim>::BoxMesh(const std::string &section) : ParameterAcceptor(section), n_cells(dim, 20)
  {
    for (unsigned int i = 0; i < dim; ++i)
      upper[i] = 1.;
    add_parameter("Lower corner", lower, "Lower corner of the box [length].", this->prm);
    add_parameter("Upper corner", upper, "Upper corner of the box [length].", this->prm);
    add_parameter("Cells", n_cells,
                  "Number of cells in each direction. A high common power of two saves memory: the rest is "
                  "stored on every rank.",
                  this->prm, Patterns::List(Patterns::Integer(1), dim, dim));
  }

  template <int dim>
  void BoxMesh<dim>::parse_parameters(ParameterHandler &)
  {
    for (unsigned int i = 0; i < dim; ++i)
      if (!(lower[i] < upper[i]))
        throw EntryError(get_section_name(), "Upper corner",
                         "the box from " + Patterns::Tools::to_string(lower) + " to " +
                           Patterns::Tools::to_string(upper) +
                           " is empty. Every coordinate of the upper corner must be greater than that of the lower.");
  }

  template <int dim>
  void BoxMesh<dim>::create(parallel::distributed::Triangulation<dim> &triangulation) const
  {
    // The least: the triangulation, and the matrix of linear elements.
    constexpr double bytes_per_cell = dim == 2 ? 1000 : 5000;
    double           wanted         = bytes_per_cell;
    for (const unsigned int n : n_cells)
      wanted *= n;
    const double has = physical_memory(triangulation.get_communicator());
    if (wanted > has)
    {
      std::ostringstream text;
      text << std::setprecision(3) << "the mesh's " << wanted / bytes_per_cell << " cells take " << wanted / 1e9
           << " GB at least, and there are " << has / 1e9 << " GB of memory. Take fewer.";
      throw EntryError(get_section_name(), "Cells", text.str());
    }
    // p4est keeps the coarse mesh on every rank: leave as much as possible to refinement.
    auto         n_coarse      = n_cells;
    unsigned int n_refinements = 0;
    const auto   is_even       = [](const unsigned int n) { return n % 2 == 0; };
    for (; std::all_of(n_coarse.begin(), n_coarse.end(), is_even); ++n_refinements)
      for (auto &n : n_coarse)
        n /= 2;
    GridGenerator::subdivided_hyper_rectangle(triangulation, n_coarse, lower, upper, true);
    triangulation.refine_global(n_refinements);
  }

  template class BoxMesh<2>;
  template class BoxMesh<3>;
} // namespace Talus

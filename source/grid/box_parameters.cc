#include <talus/core/exceptions.h>
#include <talus/core/memory.h>
#include <talus/grid/box_grid.h>

#include <iomanip>
#include <limits>
#include <sstream>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    std::string number_text(const double number)
    {
      std::ostringstream text;
      text << std::setprecision(3) << number;
      return text.str();
    }

    const std::string coarser = "Take a larger spacing or a smaller box.";
  } // namespace

  template <int dim>
  BoxTriangulation<dim>::BoxTriangulation(MPI_Comm communicator) :
    p4est(communicator, Triangulation<dim>::none,
          parallel::distributed::Triangulation<dim>::communicate_vertices_to_p4est),
    fe(1), dofs(p4est)
  {
  }

  template <int dim>
  BoxGrid<dim>::BoxGrid(const std::string &section, const Communicator &communicator) :
    BoxTriangulation<dim>(communicator), Grid<dim>(section, communicator, this->p4est, this->dofs, this->cartesian),
    lower_corner(dim, 0.), upper_corner(dim, 1.)
  {
    const Patterns::List numbers(Patterns::Double(), dim, dim);
    this->add_parameter("Lower corner", lower_corner, "Corner of the box with the smallest coordinates [length].",
                        this->prm, numbers);
    this->add_parameter("Upper corner", upper_corner, "Corner of the box with the largest coordinates [length].",
                        this->prm, numbers);
    this->add_parameter("Spacing", spacings,
                        "Distance of the nodes [length]: one number, or one per direction. It must divide the box.",
                        this->prm, Patterns::List(Patterns::Double(0), 0, dim));
    this->add_parameter("Cells", cell_counts, "Number of cells per direction; instead of the spacing.", this->prm,
                        Patterns::List(Patterns::Integer(1), 0, dim));
  }

  template <int dim>
  void BoxGrid<dim>::parse_parameters(ParameterHandler &)
  {
    constexpr double   most    = 1 << 29; // an index and its mirror image must fit into an int
    const std::string &section = this->get_section_name();
    if (spacings.empty() == cell_counts.empty())
      throw EntryError(section, "Spacing", "give either 'Spacing' or 'Cells', and not both.");
    if (!spacings.empty() && spacings.size() != 1 && spacings.size() != dim)
      throw EntryError(section, "Spacing", "give one number or " + std::to_string(dim) + ".");
    if (spacings.empty() && cell_counts.size() != dim)
      throw EntryError(section, "Cells", "give " + std::to_string(dim) + " numbers.");
    for (unsigned int d = 0; d < dim; ++d)
    {
      const double length = upper_corner[d] - lower_corner[d];
      lower[d]            = lower_corner[d];
      upper[d]            = upper_corner[d];
      if (!(length > 0))
        throw EntryError(section, "Upper corner", "it must lie above the lower corner in every direction.");
      double count = spacings.empty() ? cell_counts[d] : 0;
      if (!spacings.empty())
      {
        const double wanted = spacings.size() == 1 ? spacings[0] : spacings[d];
        if (!(wanted > 0))
          throw EntryError(section, "Spacing", "it must be positive.");
        count = std::round(length / wanted);
        if (count <= most && (count < 1 || std::abs(count * wanted - length) > 1e-6 * wanted))
          throw EntryError(section, "Spacing",
                           "the box is " + std::to_string(length / wanted) + " spacings long in direction " +
                             std::string(1, "xyz"[d]) + ". Move a corner so that it becomes a whole number.");
      }
      if (!(count <= most))
        throw EntryError(section, spacings.empty() ? "Cells" : "Spacing",
                         "the box is " + number_text(count) + " cells long in direction " + std::string(1, "xyz"[d]) +
                           ", too many to be numbered. " + coarser);
      lattice.n_cells[d]   = static_cast<int>(count);
      lattice.origin[d]    = lower[d];
      lattice.h[d]         = length / lattice.n_cells[d];
      lattice.inverse_h[d] = lattice.n_cells[d] / length;
    }
    this->spacing          = lattice.h;
    this->inverse_spacing  = lattice.inverse_h;
    this->smallest_spacing = lattice.smallest_spacing();
    this->largest_spacing  = lattice.largest_spacing();
    check_memory();
  }

  template <int dim>
  std::string BoxGrid<dim>::extent() const
  {
    return "which reaches from " + Talus::to_text<dim>(lower) + " to " + Talus::to_text<dim>(upper);
  }

  template <int dim>
  std::string BoxGrid<dim>::summary() const
  {
    std::ostringstream text;
    for (unsigned int d = 0; d < dim; ++d)
      text << (d == 0 ? "" : " x ") << lattice.n_cells[d];
    text << " cells";
    return text.str();
  }

  template <int dim>
  void BoxGrid<dim>::check_memory()
  {
    // What deal.II's triangulation and numbers of nodes take at least: measured on grids of a million cells.
    constexpr double bytes_per_cell = dim == 2 ? 600 : 1800;
    double           n_cells = 1, n_nodes = 1, n_coarse = 1;
    int              common = 0;
    for (unsigned int d = 0; d < dim; ++d)
    {
      n_cells *= lattice.n_cells[d];
      n_nodes *= lattice.n_cells[d] + 1.;
      common |= lattice.n_cells[d];
    }
    common &= -common; // the largest power of two that divides all counts: p4est refines so often
    for (const int count : lattice.n_cells)
      n_coarse *= static_cast<double>(count) / common;
    // Every rank stores the coarse mesh, besides its own cells.
    const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(communicator);
    this->remarks.clear();
    const double wanted = bytes_per_cell * std::max(n_cells, n_coarse * n_ranks), has = physical_memory(communicator);
    const std::string takes = "the grid's " + number_text(n_cells) + " cells take " + number_text(wanted / 1e9) +
                              " GB at least, and there are " + number_text(has / 1e9) + " GB of memory. ";
    const std::string entry = spacings.empty() ? "Cells" : "Spacing";
    if (wanted > has)
      throw EntryError(this->get_section_name(), entry, takes + coarser);
    if (n_nodes > std::numeric_limits<types::global_dof_index>::max())
      throw EntryError(this->get_section_name(), entry,
                       "the grid has " + number_text(n_nodes) +
                         " nodes, more than this deal.II can number. Use one with 64-bit indices. " + coarser);
    if (wanted > has / 2)
      this->remarks.emplace_back(this->get_section_name(), entry, takes + coarser);
    if (n_coarse > 1e5)
    {
      std::string better;
      for (const int count : lattice.n_cells)
        better += " " + std::to_string((count + 8) / 16 * 16);
      this->remarks.emplace_back(this->get_section_name(), entry,
                                 "every rank stores a coarse mesh of " + number_text(n_coarse) +
                                   " cells. Numbers of cells with a large common power of two avoid that, for example" +
                                   better + ".");
    }
  }

#define INSTANTIATE(dim)                                                                                               \
  template struct BoxTriangulation<dim>;                                                                               \
  template BoxGrid<dim>::BoxGrid(const std::string &, const Communicator &);                                           \
  template void        BoxGrid<dim>::parse_parameters(ParameterHandler &);                                             \
  template void        BoxGrid<dim>::check_memory();                                                                   \
  template std::string BoxGrid<dim>::extent() const;                                                                   \
  template std::string BoxGrid<dim>::summary() const;
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Talus

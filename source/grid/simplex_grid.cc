#include <talus/core/exceptions.h>
#include <talus/core/memory.h>
#include <talus/core/text_file.h>
#include <talus/grid/mesh_check.h>
#include <talus/grid/mesh_file.h>
#include <talus/grid/mesh_generate.h>
#include <talus/grid/simplex.h>
#include <talus/grid/simplex_grid.h>

#include <deal.II/dofs/dof_tools.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    /** Throws where the mesh does not fit into memory; what to tell where it hardly does. */
    template <int dim>
    std::vector<EntryError> check_memory(const std::vector<unsigned int> &boxes, const std::string &section,
                                         MPI_Comm communicator)
    {
      // What deal.II and the lists of stencils take at least: measured on meshes of .7 million triangles.
      constexpr double bytes_per_cell = dim == 2 ? 1000 : 1500;
      double           n_cells = dim == 2 ? 2 : 6, n_nodes = 1;
      for (const unsigned int count : boxes)
      {
        n_cells *= count;
        n_nodes *= count + 1.;
      }
      const double       wanted = bytes_per_cell * n_cells, has = physical_memory(communicator);
      std::ostringstream text;
      text << std::setprecision(3) << "the mesh's " << n_cells << " cells take " << wanted / 1e9
           << " GB at least, and there are " << has / 1e9 << " GB of memory. Take fewer.";
      if (wanted > has || n_nodes > std::numeric_limits<unsigned int>::max())
        throw EntryError(section, "Cells", text.str());
      return wanted > has / 2 ? std::vector<EntryError>{{section, "Cells", text.str()}} : std::vector<EntryError>();
    }
  } // namespace

  template <int dim>
  SimplexGrid<dim>::SimplexGrid(const std::string &section, const Communicator &communicator) :
    SimplexTriangulation<dim>(communicator), Grid<dim>(section, communicator, this->partition.triangulation,
                                                       this->partition.dof_handler, this->affine),
    lower_corner(dim, 0.), upper_corner(dim, 1.)
  {
    const Patterns::List numbers(Patterns::Double(), dim, dim);
    this->add_parameter("File", file,
                        "Mesh of gmsh (.msh, format 4.1, ASCII) with triangles or tetrahedra; empty: a box is cut into "
                        "them, of the corners and cells below.");
    this->add_parameter("Lower corner", lower_corner, "Corner of the box with the smallest coordinates [length].",
                        this->prm, numbers);
    this->add_parameter("Upper corner", upper_corner, "Corner of the box with the largest coordinates [length].",
                        this->prm, numbers);
    this->add_parameter("Cells", cell_counts, "Number of boxes per direction; each is cut into simplices.", this->prm,
                        Patterns::List(Patterns::Integer(1), 0, dim));
    this->add_parameter("Ratio", ratio, "Length along x of the first box over that of the second, and so on [1].",
                        this->prm, Patterns::Double(1e-3, 1e3));
    this->add_parameter("Held boundaries", held_boundaries,
                        "Parts of the boundary, by name or number, on which the functions of all other nodes shall "
                        "vanish, as those of P1 do: walls whose nodes conditions hold.",
                        this->prm, Patterns::List(Patterns::Anything()));
    this->add_parameter(
      "Slip mirrors", slip_mirrors,
      "Slip walls across axes beyond which velocities along the axis are opposite: parts of the "
      "boundary, by name or number, beyond which the mesh goes on as its mirror image, or half spaces "
      "('x <= 0') where it has a layer of cells whose nodes are mirror images of those before.",
      this->prm, Patterns::List(Patterns::Anything()));
    this->add_parameter("No-slip mirrors", no_slip_mirrors,
                        "The same where all components are opposite: walls whose nodes are fixed.", this->prm,
                        Patterns::List(Patterns::Anything()));
    this->add_parameter("Spacing", spacings,
                        "What counts as a cell's edge where bodies and surfaces are filled by points per cell "
                        "[length], one number or one per direction; empty: that of the boxes.",
                        this->prm, Patterns::List(Patterns::Double(0), 0, dim));
  }

  template <int dim>
  void SimplexGrid<dim>::parse_parameters(ParameterHandler &)
  {
    const std::string &section = this->get_section_name();
    if (file.empty() == cell_counts.empty())
      throw EntryError(section, "File", "give either 'File', or 'Cells' for a mesh of a box, and not both.");
    if (file.empty() && cell_counts.size() != dim)
      throw EntryError(section, "Cells", "give " + std::to_string(dim) + " numbers.");
    if (!file.empty() && spacings.empty())
      throw EntryError(section, "Spacing",
                       "give the length that counts as a cell's edge where bodies are filled, about that of the "
                       "mesh's edges.");
    if (!spacings.empty() && spacings.size() != 1 && spacings.size() != dim)
      throw EntryError(section, "Spacing", "give one number or " + std::to_string(dim) + ".");
    for (unsigned int d = 0; d < dim; ++d)
    {
      if (file.empty() && !(upper_corner[d] > lower_corner[d]))
        throw EntryError(section, "Upper corner", "it must lie above the lower corner in every direction.");
      this->spacing[d] = spacings.empty()     ? (upper_corner[d] - lower_corner[d]) / cell_counts[d] :
                         spacings.size() == 1 ? spacings[0] :
                                                spacings[d];
      if (!(this->spacing[d] > 0))
        throw EntryError(section, "Spacing", "it must be positive.");
    }
    const std::string problem = file.empty() ? "" : why_not_read(file, "the mesh '" + file + "'");
    if (!problem.empty())
      throw EntryError(section, "File", problem);
    if (file.empty())
      this->remarks = check_memory<dim>(cell_counts, section, this->communicator);
  }

  template <int dim>
  MeshInput<dim> SimplexGrid<dim>::read() const
  {
    if (!file.empty())
    {
      auto input = read_msh<dim>(file);
      check_mesh(input);
      return input;
    }
    std::array<double, dim>       lower, upper;
    std::array<unsigned int, dim> n_cells;
    std::copy_n(lower_corner.begin(), dim, lower.begin());
    std::copy_n(upper_corner.begin(), dim, upper.begin());
    std::copy_n(cell_counts.begin(), dim, n_cells.begin());
    return generate_mesh<dim>(lower, upper, n_cells, ratio);
  }

  template <int dim>
  void SimplexGrid<dim>::create(const CellWeight &weight, const Reach &)
  {
    // Material rules, as on boxes: cells without it are free but for their share of memory.
    this->partition.create([this] { return read(); },
                           [&](const CellIterator &cell) { return 1. + 1000. * weight(cell); });
    number_nodes();
    find_extent();
    hold_boundaries();
    mirror_boundaries();
    is_open.assign(mesh().n_cells(), 0);
    find_open_cells();
  }

  template <int dim>
  void SimplexGrid<dim>::repartition(const std::vector<double> &counts)
  {
    std::vector<double> all;
    for (const auto &of_rank : Utilities::MPI::gather(communicator, counts))
      all.insert(all.end(), of_rank.begin(), of_rank.end());
    create(this->weight_by(all), {});
  }

  template <int dim>
  void SimplexGrid<dim>::number_nodes()
  {
    const IndexSet owned = this->dof_handler.locally_owned_dofs();
    IndexSet       known;
    DoFTools::extract_locally_relevant_dofs(this->dof_handler, known);
    IndexSet others = known;
    others.subtract_set(owned);
    // What nodes carry lies in the order of the mesh's nodes, by which stencils name them.
    std::vector<unsigned int> places(known.n_elements());
    for (unsigned int v = 0; v < mesh().n_nodes(); ++v)
    {
      const auto number = this->partition.node_numbers[v];
      places[owned.is_element(number) ? owned.index_within_set(number) :
                                        owned.n_elements() + others.index_within_set(number)] = v;
    }
    this->nodes.reinit(owned, known, communicator, places, mesh().n_nodes());
    fields.reinit(this->nodes);
    this->activate_all();
  }

  template <int dim>
  void SimplexGrid<dim>::find_extent()
  {
    double smallest = std::numeric_limits<double>::max();
    for (unsigned int c = 0; c < mesh().n_cells(); ++c)
      for (const auto &gradient : mesh().gradients(c))
      {
        double square = 0; // 1 over that of a height of the cell
        for (const double g : gradient)
          square += g * g;
        smallest = std::min(smallest, 1 / std::sqrt(square));
      }
    this->smallest_spacing = Utilities::MPI::min(smallest, communicator);
    this->largest_spacing  = mesh().longest_edge;
    this->inverse_spacing.fill(1 / this->smallest_spacing);
    for (unsigned int d = 0; d < dim; ++d)
    {
      double lower = std::numeric_limits<double>::max(), upper = std::numeric_limits<double>::lowest();
      for (const auto &x : mesh().position)
      {
        lower = std::min(lower, x[d]);
        upper = std::max(upper, x[d]);
      }
      this->lower[d] = Utilities::MPI::min(lower, communicator);
      this->upper[d] = Utilities::MPI::max(upper, communicator);
    }
  }

  template <int dim>
  Point<dim> SimplexGrid<dim>::node_position(const unsigned int node) const
  {
    Point<dim> x;
    for (unsigned int d = 0; d < dim; ++d)
      x[d] = mesh().position[this->nodes.place(node)][d];
    return x;
  }

  template <int dim>
  std::string SimplexGrid<dim>::extent() const
  {
    return "whose mesh lies between " + to_text<dim>(this->lower) + " and " + to_text<dim>(this->upper);
  }

  template <int dim>
  std::string SimplexGrid<dim>::summary() const
  {
    return std::to_string(this->partition.triangulation.n_global_active_cells()) +
           (dim == 2 ? " triangles" : " tetrahedra");
  }

  template <int dim>
  const SimplexGrid<dim> &simplex_grid(const Grid<dim> &grid, const std::string &section, const std::string &entry)
  {
    const auto mesh = dynamic_cast<const SimplexGrid<dim> *>(&grid);
    AssertThrow(mesh != nullptr, EntryError(section, entry,
                                            "this needs a mesh of triangles or tetrahedra: set 'Type = mesh' in "
                                            "section 'Grid'."));
    return *mesh;
  }

#define INSTANTIATE(dim)                                                                                               \
  template struct SimplexTriangulation<dim>;                                                                           \
  template class SimplexGrid<dim>;                                                                                     \
  template const SimplexGrid<dim> &simplex_grid(const Grid<dim> &, const std::string &, const std::string &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Talus

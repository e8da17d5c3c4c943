#include <talus/core/exceptions.h>
#include <talus/core/half_space.h>
#include <talus/grid/simplex_grid.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Talus
{
  using namespace dealii;

  template <int dim>
  typename MeshInput<dim>::Group SimplexGrid<dim>::group(const std::string &name) const
  {
    MeshInput<dim> input;
    input.name   = file.empty() ? "generated" : file;
    input.groups = this->partition.groups;
    return input.groups[input.find_group(name)];
  }

  template <int dim>
  std::vector<char> SimplexGrid<dim>::nodes_on(const std::string &name, const std::string &entry) const
  {
    std::vector<char> is_on(this->nodes.n_local(), 0);
    try
    {
      for (const unsigned int node : boundary(name).nodes)
        is_on[node] = 1;
    }
    catch (const InputError &error)
    {
      throw EntryError(this->get_section_name(), entry, error.message);
    }
    return is_on;
  }

  template <int dim>
  void SimplexGrid<dim>::hold_boundaries()
  {
    if (held_boundaries.empty())
      return;
    std::vector<char> is_held(this->nodes.n_local(), 0);
    for (const std::string &name : held_boundaries)
    {
      const auto is_on = nodes_on(name, "Held boundaries");
      for (unsigned int i = 0; i < is_held.size(); ++i)
        is_held[i] |= is_on[i];
    }
    this->spread(is_held);
    this->partition.mesh.hold(by_place(is_held));
  }

  template <int dim>
  void SimplexGrid<dim>::mirror_boundaries()
  {
    std::vector<typename Mesh<dim>::Mirror> ends, layers;
    for (const bool slips : {true, false})
      for (const std::string &text : slips ? slip_mirrors : no_slip_mirrors)
      {
        if (const auto half_space = read_half_space(text, dim))
        {
          layers.push_back({half_space->axis, half_space->is_upper, half_space->position, slips});
          continue;
        }
        const std::string entry = slips ? "Slip mirrors" : "No-slip mirrors";
        auto              is_on = nodes_on(text, entry);
        this->spread(is_on);
        ends.push_back(find_mirror(text, entry, by_place(is_on)));
        ends.back().slips = slips;
        // In the numbers of a box: each component that is opposite beyond the wall has a face that bears it.
        unsigned int &faces = mirrored_faces[group(text).number];
        for (unsigned int d = 0; d < dim; ++d)
          if (!slips || d == ends.back().axis)
            faces |= 1u << (2 * d + (ends.back().is_upper ? 1 : 0));
      }
    if (!ends.empty() && !layers.empty())
      throw EntryError(this->get_section_name(), slip_mirrors.empty() ? "No-slip mirrors" : "Slip mirrors",
                       "give either parts of the boundary or half spaces, and not both.");
    if (!ends.empty())
      this->partition.mesh.mirror(ends);
    typename Mesh<dim>::Vector x{};
    const bool is_complete = layers.empty() || this->partition.mesh.fold(layers, this->partition.n_owned_cells, x);
    // All ranks must know of it: the first that misses an image says where.
    const auto missing = Utilities::MPI::all_gather(communicator, std::make_pair(is_complete, x));
    for (const auto &[has_all, where] : missing)
      if (!has_all)
      {
        Point<dim> place;
        std::copy_n(where.begin(), dim, place.begin_raw());
        throw EntryError(
          this->get_section_name(), slip_mirrors.empty() ? "No-slip mirrors" : "Slip mirrors",
          "the node at " + to_text<dim>(place) +
            " has no mirror image among the nodes near it. Let the mesh be symmetric within two cells of "
            "the wall, or end there.");
      }
  }

  template <int dim>
  typename Mesh<dim>::Mirror SimplexGrid<dim>::find_mirror(const std::string &name, const std::string &entry,
                                                           const std::vector<char> &is_on) const
  {
    double least[dim], greatest[dim];
    for (unsigned int d = 0; d < dim; ++d)
    {
      least[d]    = std::numeric_limits<double>::max();
      greatest[d] = std::numeric_limits<double>::lowest();
      for (unsigned int v = 0; v < is_on.size(); ++v)
        if (is_on[v])
        {
          least[d]    = std::min(least[d], mesh().position[v][d]);
          greatest[d] = std::max(greatest[d], mesh().position[v][d]);
        }
      least[d]    = Utilities::MPI::min(least[d], communicator);
      greatest[d] = Utilities::MPI::max(greatest[d], communicator);
    }
    const double tolerance = 1e-9 * this->largest_spacing;
    for (unsigned int d = 0; d < dim; ++d)
      if (greatest[d] - least[d] <= tolerance)
      {
        typename Mesh<dim>::Mirror mirror;
        mirror.axis     = d;
        mirror.is_upper = std::abs(this->upper[d] - least[d]) < std::abs(this->lower[d] - least[d]);
        mirror.position = least[d];
        mirror.is_on    = is_on;
        return mirror;
      }
    throw EntryError(this->get_section_name(), entry,
                     "'" + name + "' lies in no plane across an axis. Let the mesh end there without a mirror.");
  }

#define INSTANTIATE(dim)                                                                                               \
  template typename MeshInput<dim>::Group SimplexGrid<dim>::group(const std::string &) const;                          \
  template std::vector<char>              SimplexGrid<dim>::nodes_on(const std::string &, const std::string &) const;  \
  template void                           SimplexGrid<dim>::hold_boundaries();                                         \
  template void                           SimplexGrid<dim>::mirror_boundaries();                                       \
  template typename Mesh<dim>::Mirror     SimplexGrid<dim>::find_mirror(const std::string &, const std::string &,      \
                                                                        const std::vector<char> &) const;
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Talus

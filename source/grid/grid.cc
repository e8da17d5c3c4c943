#include <talus/grid/grid.h>

#include <memory>
#include <unordered_map>

namespace Talus
{
  using namespace dealii;

  template <int dim>
  Grid<dim>::Grid(const std::string &section, const Communicator &communicator,
                  parallel::TriangulationBase<dim> &triangulation, DoFHandler<dim> &dof_handler,
                  const Mapping<dim> &mapping) :
    ParameterAcceptor(section),
    communicator(communicator), triangulation(triangulation), dof_handler(dof_handler), mapping(mapping)
  {
  }

  template <int dim>
  typename Grid<dim>::CellWeight Grid<dim>::weight_by(const std::vector<double> &counts) const
  {
    // Numbers of cells are known when the first weight is asked for.
    const auto n_in_cell = std::make_shared<std::unordered_map<std::size_t, unsigned int>>();
    return [this, &counts, n_in_cell](const CellIterator &cell) {
      if (n_in_cell->empty())
        for (std::size_t k = 0; k + dim < counts.size(); k += dim + 1)
        {
          Point<dim> centre;
          std::copy_n(counts.begin() + k, dim, centre.begin_raw());
          (*n_in_cell)[cell_number(centre)] = static_cast<unsigned int>(counts[k + dim]);
        }
      const auto found = n_in_cell->find(cell_number(cell->center()));
      return found == n_in_cell->end() ? 0 : found->second;
    };
  }

  template <int dim>
  void Grid<dim>::collect_active_nodes()
  {
    active_nodes.clear();
    for (unsigned int i = 0; i < fields.n_owned(); ++i)
      if (is_active[i])
        active_nodes.push_back(i);
  }

  template <int dim>
  void Grid<dim>::activate_all()
  {
    is_active.assign(fields.n_local(), true);
    collect_active_nodes();
  }

  template <int dim>
  void Grid<dim>::spread(std::vector<char> &of_nodes)
  {
    // Tell the owners what reaches into their nodes, and those who have copies what the owners know.
    NodalArray<1> marks;
    marks.reinit(nodes);
    const auto for_shared_nodes = [&](const auto &body) {
      for (const auto &neighbours : {nodes.copied_by, nodes.copied_from})
        for (const auto &neighbour : neighbours)
          for (const unsigned int i : neighbour.nodes)
            body(i);
    };
    for_shared_nodes([&](const unsigned int i) { *marks[i] = of_nodes[i]; });
    marks.add_copies_to_owners();
    marks.update_copies();
    for_shared_nodes([&](const unsigned int i) { of_nodes[i] = *marks[i] > 0; });
  }

  template <int dim>
  void Grid<dim>::activate_nodes(std::vector<char> is_reached)
  {
    spread(is_reached);
    // Those that remain are cleared in the next step; the others may hold something of the last one. At first all are
    // active and zero: memory that does not exist is not asked for.
    const auto is_zero = [](const double number) { return number == 0; };
    n_changed_nodes    = 0;
    for (unsigned int i = 0; i < fields.n_local(); ++i)
      if (is_active[i] != static_cast<bool>(is_reached[i]))
      {
        if (is_active[i] && !std::all_of(fields[i], fields[i] + fields.stride, is_zero))
          std::fill_n(fields[i], fields.stride, 0.);
        is_active[i] = !is_active[i];
        ++n_changed_nodes;
      }
    if (n_changed_nodes == 0)
      return;
    collect_active_nodes();
    active_nodes_changed();
  }

  template <int dim>
  std::vector<double> Grid<dim>::share() const
  {
    Tensor<1, dim> sum;
    for (unsigned int i = 0; i < fields.n_owned(); ++i)
      sum += node_position(i);
    std::vector<double> numbers{1. * fields.n_owned(), 1. * fields.n_local(), 1. * nodes.n_places()};
    numbers.insert(numbers.end(), sum.begin_raw(), sum.end_raw());
    return numbers;
  }

  template <int dim>
  void Grid<dim>::serialize(Archive &archive)
  {
    const Archive::Scope scope(archive, "grid");
    std::vector<double>  numbers = share(), active(active_nodes.begin(), active_nodes.end());
    archive.of_rank("share", numbers);
    archive.of_rank("active nodes", active);
    if (!archive.is_reading() || !archive.is_exact())
      return;
    std::vector<char> is_reached(fields.n_local(), 0);
    for (const double i : active)
    {
      AssertThrow(i >= 0 && i < is_reached.size(),
                  InputError("the checkpoint has a node " + std::to_string(i) +
                             " that its grid has not. It is not of this run, or was changed."));
      is_reached[static_cast<unsigned int>(i)] = 1;
    }
    activate_nodes(std::move(is_reached));
  }

  template <int dim>
  void Grid<dim>::clear()
  {
    fields.clear(active_nodes);
    fields.mirrored_force.fill(0.);
  }

  template <int dim>
  void Grid<dim>::update_velocity(const double dt, const std::vector<unsigned int> &some)
  {
    using Fields  = NodalFields<dim>;
    lost_momentum = 0;
    for (const unsigned int i : some)
    {
      double      *values = fields[i];
      const double m      = values[Fields::mass];
      if (m > mass_floor)
      {
        const double inverse_m = 1 / m;
        for (unsigned int d = 0; d < dim; ++d)
        {
          const double v                = values[Fields::momentum + d] * inverse_m;
          const double dv               = dt * values[Fields::force + d] * inverse_m;
          values[Fields::velocity + d]  = v + dv;
          values[Fields::increment + d] = dv;
        }
      }
      else
        // Empty nodes keep v = 0: dividing by m_i = 0 would spread NaN.
        for (unsigned int d = 0; d < dim; ++d)
        {
          lost_momentum[d] += values[Fields::momentum + d] + dt * values[Fields::force + d];
          values[Fields::velocity + d] = values[Fields::increment + d] = 0;
        }
    }
  }

  template <int dim>
  std::vector<unsigned int> Grid<dim>::nodes_in_box(const Point<dim> &lower, const Point<dim> &upper) const
  {
    std::vector<unsigned int> nodes;
    for (unsigned int i = 0; i < fields.n_owned(); ++i)
    {
      const Point<dim> x         = node_position(i);
      bool             is_inside = true;
      for (unsigned int d = 0; d < dim; ++d)
        is_inside = is_inside && is_between(x[d], lower[d], upper[d], d);
      if (is_inside)
        nodes.push_back(i);
    }
    return nodes;
  }

  template class Grid<2>;
  template class Grid<3>;
} // namespace Talus

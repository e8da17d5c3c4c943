#include <talus/postprocess/grid_output.h>

#include <algorithm>

namespace Talus
{
  using namespace dealii;

  template <int dim>
  GridOutput<dim>::GridOutput(const Grid<dim> &grid, const bool has_all_cells)
  {
    using Fields                   = NodalFields<dim>;
    constexpr unsigned int n       = 1 + dim;
    const unsigned int     lanes[] = {Fields::mass, Fields::velocity, Fields::velocity + 1, Fields::velocity + 2};

    // A rank's copies have the velocity of their node, but not all of its mass.
    NodalArray<n> values;
    values.reinit(grid.nodes);
    for (const unsigned int i : grid.active_nodes)
      for (unsigned int c = 0; c < n; ++c)
        values[i][c] = grid.fields[i][lanes[c]];
    values.update_copies();

    const auto cell_type  = grid.cell_type();
    const auto n_vertices = cell_type.n_vertices();
    for (const auto &cell : grid.cells(!has_all_cells))
    {
      DataOutBase::Patch<dim, dim> patch;
      patch.patch_index    = patches.size();
      patch.reference_cell = cell_type;
      patch.data.reinit(n, n_vertices);
      for (unsigned int v = 0; v < n_vertices; ++v)
      {
        patch.vertices[v] = grid.node_position(cell[v]);
        for (unsigned int c = 0; c < n; ++c)
          patch.data(c, v) = values[cell[v]][c];
      }
      patches.push_back(std::move(patch));
    }
  }

  template <int dim>
  std::vector<std::string> GridOutput<dim>::get_dataset_names() const
  {
    const std::vector<std::string> names = {"mass", "velocity_x", "velocity_y", "velocity_z"};
    return {names.begin(), names.begin() + 1 + dim};
  }

  template <int dim>
  std::vector<
    std::tuple<unsigned int, unsigned int, std::string, DataComponentInterpretation::DataComponentInterpretation>>
  GridOutput<dim>::get_nonscalar_data_ranges() const
  {
    return {{1, dim, "velocity", DataComponentInterpretation::component_is_part_of_vector}};
  }

  template class GridOutput<2>;
  template class GridOutput<3>;
} // namespace Talus

#include <talus/postprocess/grid_output.h>

namespace Talus
{
  using namespace dealii;

  template <int dim>
  GridOutput<dim>::GridOutput(const Grid<dim> &grid)
  {
    using Fields                         = NodalFields<dim>;
    const std::vector<std::string> names = {"mass", "velocity_x", "velocity_y", "velocity_z"};
    const unsigned int lanes[]           = {Fields::mass, Fields::velocity, Fields::velocity + 1, Fields::velocity + 2};

    // deal.II copies the owned values into vectors of its own and fetches those of other ranks' nodes itself.
    std::vector<LinearAlgebra::distributed::Vector<double>> vectors(1 + dim);
    this->attach_dof_handler(grid.dof_handler);
    for (unsigned int c = 0; c < vectors.size(); ++c)
    {
      vectors[c].reinit(grid.dof_handler.locally_owned_dofs(), grid.communicator);
      for (unsigned int i = 0; i < grid.fields.n_owned(); ++i)
        vectors[c].local_element(i) = grid.fields[i][lanes[c]];
      this->add_data_vector(vectors[c], names[c]);
    }
    this->build_patches(grid.mapping);
    this->clear_input_data_references();
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

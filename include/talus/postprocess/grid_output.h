#pragma once

#include <talus/grid/grid.h>

#include <deal.II/numerics/data_out.h>

namespace Talus
{
  /**
   * Mass and velocity of the nodes as they stand after a step, for deal.II's writers: on the cells whose nodes are all
   * active, which are those near material, or on all. Test: tests/postprocess.
   */
  template <int dim>
  class GridOutput : public dealii::DataOut<dim>
  {
  public:
    /** Reads the nodes this rank owns and brings their values to its neighbours. Collective. */
    explicit GridOutput(const Grid<dim> &grid, const bool has_all_cells = false);

    using dealii::DataOut<dim>::get_patches;
    using dealii::DataOut<dim>::get_dataset_names;

    // The velocity's components are scalars for the scalar DoFHandler; here they become a vector.
    std::vector<std::tuple<unsigned int, unsigned int, std::string,
                           dealii::DataComponentInterpretation::DataComponentInterpretation>>
    get_nonscalar_data_ranges() const override;
  };
} // namespace Talus

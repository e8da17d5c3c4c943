#pragma once

#include <talus/grid/grid.h>

#include <deal.II/base/data_out_base.h>

namespace Talus
{
  /**
   * Mass and velocity of the nodes as they stand after a step, for deal.II's writers: on the cells whose nodes are all
   * active, which are those near material, or on all. Test: tests/postprocess.
   */
  template <int dim>
  class GridOutput : public dealii::DataOutInterface<dim, dim>
  {
  public:
    /** Reads the nodes this rank owns and brings their values to its neighbours. Collective. */
    explicit GridOutput(const Grid<dim> &grid, const bool has_all_cells = false);

    const std::vector<dealii::DataOutBase::Patch<dim, dim>> &get_patches() const override { return patches; }
    std::vector<std::string>                                 get_dataset_names() const override;
    std::vector<std::tuple<unsigned int, unsigned int, std::string,
                           dealii::DataComponentInterpretation::DataComponentInterpretation>>
    get_nonscalar_data_ranges() const override;

  private:
    std::vector<dealii::DataOutBase::Patch<dim, dim>> patches;
  };
} // namespace Talus

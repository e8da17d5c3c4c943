#include <talus/postprocess/grid_output.h>

#include "fixture.h"

#include <set>

using namespace dealii;
using namespace Test;

namespace
{
  /** Makes what is handed to deal.II's writers visible. */
  template <class Output>
  struct Visible : Output
  {
    using Output::get_dataset_names;
    using Output::get_patches;
    using Output::Output;
  };

  template <int dim>
  void check_grid()
  {
    using Fields = NodalFields<dim>;
    Fixture<dim> run;
    run.create();
    for (unsigned int i = 0; i < run.grid.fields.n_owned(); ++i)
    {
      const Point<dim> x               = run.grid.node_position(i);
      run.grid.fields[i][Fields::mass] = 1 + x[0] + 8 * x[1];
      for (unsigned int d = 0; d < dim; ++d)
        run.grid.fields[i][Fields::velocity + d] = (d + 2) * x[d];
    }
    Visible<GridOutput<dim>> data(run.grid);
    double                   error = 0;
    for (const auto &patch : data.get_patches())
      for (unsigned int v = 0; v < (1 << dim); ++v)
      {
        const Point<dim> x = patch.vertices[v];
        error              = std::max<double>(error, std::abs(patch.data(0, v) - (1 + x[0] + 8 * x[1])));
        for (unsigned int d = 0; d < dim; ++d)
          error = std::max<double>(error, std::abs(patch.data(1 + d, v) - (d + 2) * x[d]));
      }
    check_true("nodes have their values in " + std::to_string(dim) + "D", error == 0);

    // A body in a corner: the cells that a particle may reach in its next step are there, and few others.
    const auto        sum   = [](const double value) { return Utilities::MPI::sum(value, MPI_COMM_WORLD); };
    const std::string name  = std::to_string(dim) + "D: ";
    const double      n_all = sum(data.get_patches().size());
    run.grid.activate(run.particles.used_places());
    Visible<GridOutput<dim>>          near_material(run.grid), all(run.grid, true);
    std::set<std::array<double, dim>> centers;
    const auto                        key = [](const Point<dim> &x) {
      std::array<double, dim> result;
      for (unsigned int d = 0; d < dim; ++d)
        result[d] = std::round(1e6 * x[d]);
      return result;
    };
    for (const auto &patch : near_material.get_patches())
      centers.insert(key((patch.vertices[0] + patch.vertices[(1 << dim) - 1]) / 2.));
    check_true(name + "each cell once", centers.size() == near_material.get_patches().size());
    double missing = 0, n_cells = 0;
    for (const auto &cell : run.grid.triangulation.active_cell_iterators())
      if (cell->is_locally_owned())
      {
        bool holds_particle = false;
        for (unsigned int p = 0; p < run.particles.size(); ++p)
          holds_particle = holds_particle || cell->bounding_box().point_inside(
                                               Point<dim>(run.particles.vector(run.particles.position, p)));
        missing += holds_particle && centers.count(key(cell->center())) == 0;
        ++n_cells;
      }
    check(name + "cells with material that are missing", sum(missing), 0.5);
    const double n_near = sum(centers.size());
    check_true(name + "and not all", n_near > 0 && n_near < sum(n_cells));
    check(name + "all cells, at first and where all are wanted",
          std::abs(sum(all.get_patches().size()) - sum(n_cells)) + std::abs(n_all - sum(n_cells)), 0.5);
  }
} // namespace

void test_grid_output()
{
  check_grid<2>();
  check_grid<3>();
}

#include <talus/grid/box_grid.h>
#include <talus/postprocess/grid_output.h>

#include <deal.II/dofs/dof_tools.h>

#include <algorithm>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    using Cells = std::vector<typename Triangulation<dim>::cell_iterator>;

    /** A cell is found by the node at its lower corner: what is looked at is what is active. */
    template <int dim>
    Cells<dim> active_cells(const BoxGrid<dim> &grid)
    {
      const auto &lattice = grid.lattice;
      Cells<dim>  cells;
      for (unsigned int i = 0; i < grid.fields.n_local(); ++i)
      {
        const unsigned int cell = grid.is_active[i] ? lattice.cell[grid.nodes.place(i)] : lattice.missing;
        if (cell == lattice.missing)
          continue;
        bool all_are_active = true;
        for_each_index(grid.node_index[i], 2, [&](const auto &corner) {
          all_are_active = all_are_active && grid.is_active[lattice.node_at(corner)];
        });
        if (all_are_active)
          cells.push_back(grid.owned_cell(cell));
      }
      return cells;
    }

    template <int dim>
    Cells<dim> active_cells_of_mesh(const Grid<dim> &grid)
    {
      LinearAlgebra::distributed::Vector<double> is_active(grid.dof_handler.locally_owned_dofs(),
                                                           DoFTools::extract_locally_relevant_dofs(grid.dof_handler),
                                                           grid.communicator);
      for (const unsigned int i : grid.active_nodes)
        is_active.local_element(i) = 1;
      is_active.update_ghost_values();
      Cells<dim> cells;
      for (const auto &cell : grid.dof_handler.active_cell_iterators())
        if (cell->is_locally_owned())
        {
          const auto vertices = cell->vertex_indices();
          if (std::all_of(vertices.begin(), vertices.end(),
                          [&](const unsigned int v) { return is_active(cell->vertex_dof_index(v, 0)) > 0; }))
            cells.push_back(cell);
        }
      return cells;
    }

    /** This rank's cells whose nodes are all active, in deal.II's order. */
    template <int dim>
    Cells<dim> active_cells(const Grid<dim> &grid)
    {
      const auto box   = dynamic_cast<const BoxGrid<dim> *>(&grid);
      Cells<dim> cells = box != nullptr ? active_cells(*box) : active_cells_of_mesh(grid);
      std::sort(cells.begin(), cells.end());
      return cells;
    }
  } // namespace

  template <int dim>
  GridOutput<dim>::GridOutput(const Grid<dim> &grid, const bool has_all_cells)
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
    if (!has_all_cells)
    {
      using Cell       = typename Triangulation<dim>::cell_iterator;
      const auto cells = active_cells(grid);
      const auto from  = [&](const auto at) { return at == cells.end() ? Cell(grid.triangulation.end()) : *at; };
      this->set_cell_selection(
        [&](const auto &) { return from(cells.begin()); },
        [&](const auto &, const Cell &cell) { return from(std::upper_bound(cells.begin(), cells.end(), cell)); });
      this->build_patches(grid.mapping);
    }
    else
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

#include "../check.h"
#include "meshes.h"

#include <talus/core/exceptions.h>
#include <talus/grid/mesh_triangulation.h>

#include <deal.II/grid/grid_in.h>

#include <fstream>
#include <tuple>

namespace
{
  using namespace Test;

  /** Centres and measures of all cells, sorted. */
  template <int dim>
  std::vector<std::array<double, dim + 1>> cells(const dealii::Triangulation<dim> &triangulation)
  {
    std::vector<std::array<double, dim + 1>> cells;
    for (const auto &cell : triangulation.active_cell_iterators())
    {
      cells.emplace_back();
      for (unsigned int d = 0; d < dim; ++d)
        cells.back()[d] = cell->center()[d];
      cells.back()[dim] = cell->measure();
    }
    std::sort(cells.begin(), cells.end());
    return cells;
  }

  /** Number and measure of the boundary faces of an id. */
  template <int dim>
  std::pair<unsigned int, double> boundary(const dealii::Triangulation<dim> &triangulation, const unsigned int id)
  {
    std::pair<unsigned int, double> result{0, 0.};
    for (const auto &cell : triangulation.active_cell_iterators())
      for (const unsigned int f : cell->face_indices())
        if (cell->face(f)->at_boundary() && cell->face(f)->boundary_id() == id)
        {
          ++result.first;
          result.second += cell->face(f)->measure();
        }
    return result;
  }
} // namespace

/** What is read is what deal.II's own reader makes of the file; names become numbers. */
template <int dim>
void mesh_file()
{
  const auto                 input = gmsh<dim>();
  dealii::Triangulation<dim> triangulation, reference;
  Talus::check_mesh(input);
  Talus::create_triangulation(input, triangulation);
  std::ifstream file(data(dim == 2 ? "plate.msh" : "block.msh"));
  dealii::GridIn<dim>(reference).read_msh(file);

  const auto ours = cells(triangulation), theirs = cells(reference);
  check_true("number of cells", ours.size() == theirs.size());
  double error = 0, measure = 0;
  for (unsigned int c = 0; c < ours.size(); ++c)
  {
    for (unsigned int d = 0; d <= dim; ++d)
      raise(error, ours[c][d] - theirs[c][d]);
    measure += ours[c][dim];
  }
  check("cells", error, 1e-14);
  if (dim == 3)
    check("volume", measure - 1, 1e-12);

  for (const auto &group : input.groups)
  {
    const auto one = boundary(triangulation, group.number), other = boundary(reference, group.number);
    check_true("faces of group " + group.name, one.first == other.first && one.first > 0);
    check("their measure", one.second - other.second, 1e-13);
  }
  const std::string name  = dim == 2 ? "outer wall" : "left";
  const auto       &group = input.groups[input.find_group(name)];
  check_true("a group by name and number", group.number == (dim == 2 ? 12 : 5) &&
                                             input.find_group(std::to_string(group.number)) == input.find_group(name));
  check("its measure", boundary(triangulation, group.number).second - (dim == 2 ? 3 : 1), 1e-12);
}

template void mesh_file<2>();
template void mesh_file<3>();

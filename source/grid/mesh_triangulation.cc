#include <talus/grid/mesh_triangulation.h>

#include <talus/grid/simplex.h>

#include <algorithm>
#include <map>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    /** Cells in the order of vertices that deal.II asks for: with a positive volume. */
    template <int dim>
    std::vector<CellData<dim>> cell_data(const MeshInput<dim> &input)
    {
      std::vector<CellData<dim>> cells;
      for (const auto &corners : input.cells)
      {
        cells.emplace_back(dim + 1);
        auto &vertices = cells.back().vertices;
        std::copy(corners.begin(), corners.end(), vertices.begin());
        if (determinant(edges<dim>(input.positions, corners)) < 0)
          std::swap(vertices[dim - 1], vertices[dim]);
      }
      return cells;
    }

    /** deal.II wants to hear of each outer face once, and of inner ones not at all. */
    template <int dim>
    SubCellData face_data(const MeshInput<dim> &input)
    {
      using Face        = std::array<unsigned int, dim>;
      const auto sorted = [](Face face) {
        std::sort(face.begin(), face.end());
        return face;
      };
      std::map<Face, unsigned int> n_cells_at;
      for (const auto &corners : input.cells)
        for (unsigned int k = 0; k <= dim; ++k)
        {
          Face face;
          for (unsigned int i = 0; i < dim; ++i)
            face[i] = corners[(k + 1 + i) % (dim + 1)];
          ++n_cells_at[sorted(face)];
        }
      SubCellData data;
      for (const auto &face : input.faces)
        if (auto &n = n_cells_at[sorted(face.vertices)]; n == 1)
        {
          n                   = 0;
          const auto describe = [&](auto &list) {
            list.emplace_back(dim);
            std::copy(face.vertices.begin(), face.vertices.end(), list.back().vertices.begin());
            list.back().boundary_id = input.groups[face.group].number;
          };
          if constexpr (dim == 2)
            describe(data.boundary_lines);
          else
            describe(data.boundary_quads);
        }
      return data;
    }
  } // namespace

  template <int dim>
  void create_triangulation(const MeshInput<dim> &input, Triangulation<dim> &triangulation)
  {
    std::vector<Point<dim>> vertices(input.positions.size());
    for (unsigned int v = 0; v < vertices.size(); ++v)
      for (unsigned int d = 0; d < dim; ++d)
        vertices[v][d] = input.positions[v][d];
    triangulation.create_triangulation(vertices, cell_data(input), face_data(input));
  }

  template void create_triangulation(const MeshInput<2> &, Triangulation<2> &);
  template void create_triangulation(const MeshInput<3> &, Triangulation<3> &);
} // namespace Talus

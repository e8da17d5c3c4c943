#include <talus/grid/mesh_generate.h>

#include <algorithm>

namespace Talus
{
  namespace
  {
    /** Coordinates of the n + 1 nodes along an axis; of the intervals every second is `ratio` times as long. */
    std::vector<double> nodes_along(const double from, const double to, const unsigned int n, const double ratio)
    {
      const unsigned int  n_short = n / 2, n_long = n - n_short;
      const double        n_units = n_long * ratio + n_short;
      std::vector<double> x(1, from);
      double              units = 0;
      for (unsigned int i = 1; i <= n; ++i)
      {
        units += i % 2 == 1 ? ratio : 1.;
        x.push_back(i == n ? to : from + (to - from) * units / n_units);
      }
      return x;
    }

    /** Lists the faces of the cells whose vertices all lie on an outer plane. */
    template <int dim>
    void add_outer_faces(const std::array<unsigned int, dim> &n_cells, const std::array<unsigned int, dim> &stride,
                         MeshInput<dim> &mesh)
    {
      for (const auto &cell : mesh.cells)
        for (unsigned int k = 0; k <= dim; ++k)
        {
          typename MeshInput<dim>::Face face{};
          for (unsigned int i = 0; i < dim; ++i)
            face.vertices[i] = cell[(k + 1 + i) % (dim + 1)];
          for (face.group = 0; face.group < 2 * dim; ++face.group)
          {
            const unsigned int d = face.group / 2, plane = face.group % 2 == 0 ? 0 : n_cells[d];
            if (std::all_of(face.vertices.begin(), face.vertices.end(),
                            [&](const unsigned int v) { return v / stride[d] % (n_cells[d] + 1) == plane; }))
              mesh.faces.push_back(face);
          }
        }
    }
  } // namespace

  template <int dim>
  MeshInput<dim> generate_mesh(const std::array<double, dim> &lower, const std::array<double, dim> &upper,
                               const std::array<unsigned int, dim> &n_cells, const double ratio)
  {
    MeshInput<dim> mesh;
    mesh.name                   = "generated";
    unsigned int        n_nodes = 1;
    std::vector<double> x[dim];

    std::array<unsigned int, dim> stride;
    for (unsigned int d = 0; d < dim; ++d)
    {
      x[d]      = nodes_along(lower[d], upper[d], n_cells[d], d == 0 ? ratio : 1.);
      stride[d] = n_nodes;
      n_nodes *= n_cells[d] + 1;
      for (const unsigned int side : {0, 1})
        mesh.groups.push_back({2 * d + side, std::string(side == 0 ? "lower " : "upper ") + "xyz"[d]});
    }
    for (unsigned int v = 0; v < n_nodes; ++v)
    {
      bool is_corner = true; // the lower one of a box
      mesh.positions.emplace_back();
      for (unsigned int d = 0; d < dim; ++d)
      {
        const unsigned int index = v / stride[d] % (n_cells[d] + 1);
        mesh.positions.back()[d] = x[d][index];
        is_corner                = is_corner && index < n_cells[d];
      }
      std::array<unsigned int, dim> order;
      for (unsigned int d = 0; d < dim; ++d)
        order[d] = d;
      // From the lower to the upper corner of the box along its edges, in each order of the axes.
      if (is_corner)
        do
        {
          typename Mesh<dim>::Corners cell;
          cell[0] = v;
          for (unsigned int d = 0; d < dim; ++d)
            cell[d + 1] = cell[d] + stride[order[d]];
          mesh.cells.push_back(cell);
        } while (std::next_permutation(order.begin(), order.end()));
    }
    add_outer_faces<dim>(n_cells, stride, mesh);
    return mesh;
  }

  template MeshInput<2> generate_mesh<2>(const std::array<double, 2> &, const std::array<double, 2> &,
                                         const std::array<unsigned int, 2> &, const double);
  template MeshInput<3> generate_mesh<3>(const std::array<double, 3> &, const std::array<double, 3> &,
                                         const std::array<unsigned int, 3> &, const double);
} // namespace Talus

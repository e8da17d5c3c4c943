#include <talus/grid/simplex_grid.h>

#include <algorithm>
#include <cmath>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    // On a face, edge or vertex are points nearer to it than this share of the cell's height.
    constexpr double near = 1e-7;

    template <int dim>
    Tensor<1, dim> edge(const Mesh<dim> &mesh, const unsigned int from, const unsigned int to)
    {
      Tensor<1, dim> e;
      for (unsigned int d = 0; d < dim; ++d)
        e[d] = mesh.position[to][d] - mesh.position[from][d];
      return e;
    }

    template <int dim>
    double angle(const Tensor<1, dim> &a, const Tensor<1, dim> &b)
    {
      return std::acos(std::clamp(a * b / (a.norm() * b.norm()), -1., 1.));
    }

    /** Between the faces with the edge from `a` to `b` and the vertices c, d. */
    double dihedral_angle(const Mesh<3> &mesh, const unsigned int a, const unsigned int b, const unsigned int c,
                          const unsigned int d)
    {
      const auto   n    = edge(mesh, a, b) / edge(mesh, a, b).norm();
      Tensor<1, 3> to_c = edge(mesh, a, c), to_d = edge(mesh, a, d);
      to_c -= (to_c * n) * n;
      to_d -= (to_d * n) * n;
      return angle(to_c, to_d);
    }

    /** In which a tetrahedron is seen from its vertex (van Oosterom and Strackee 1983). */
    double solid_angle(const Mesh<3> &mesh, const unsigned int vertex, const std::array<unsigned int, 3> &others)
    {
      std::array<Tensor<1, 3>, 3> e;
      for (unsigned int k = 0; k < 3; ++k)
      {
        e[k] = edge(mesh, vertex, others[k]);
        e[k] /= e[k].norm();
      }
      return 2 * std::atan2(std::abs(e[0] * cross_product_3d(e[1], e[2])), 1 + e[0] * e[1] + e[1] * e[2] + e[2] * e[0]);
    }

    /** The share of a small ball around x, which the cell holds, that lies in the cell. */
    template <int dim>
    double share_of_cell(const Mesh<dim> &mesh, const unsigned int cell, const double *x)
    {
      // First the vertices of the face, edge or vertex of the cell on which x lies.
      const auto                                     B = mesh.barycentric(cell, x);
      std::array<unsigned int, dim + 1>              v = mesh.nodes[cell];
      std::array<std::pair<bool, unsigned>, dim + 1> order;
      unsigned int                                   n_away = 0;
      for (unsigned int k = 0; k <= dim; ++k)
      {
        order[k] = {B[k] <= near, v[k]};
        n_away += B[k] <= near;
      }
      std::stable_sort(order.begin(), order.end(), [](const auto &a, const auto &b) { return a.first < b.first; });
      for (unsigned int k = 0; k <= dim; ++k)
        v[k] = order[k].second;
      if (n_away < 2)
        return n_away == 0 ? 1 : 0.5;
      if constexpr (dim == 2)
        return angle(edge(mesh, v[0], v[1]), edge(mesh, v[0], v[2])) / (2 * numbers::PI);
      else
        return n_away == 2 ? dihedral_angle(mesh, v[0], v[1], v[2], v[3]) / (2 * numbers::PI) :
                             solid_angle(mesh, v[0], {{v[1], v[2], v[3]}}) / (4 * numbers::PI);
    }
  } // namespace

  template <int dim>
  double SimplexGrid<dim>::share_inside(Point<dim> &x) const
  {
    const unsigned int first = this->partition.find_here(x.begin_raw());
    if (first == none)
      return 0;
    // All cells that hold x, through the faces on which it lies.
    std::vector<unsigned int> cells = {first};
    double                    share = 0;
    for (unsigned int i = 0; i < cells.size(); ++i)
    {
      share += share_of_cell(mesh(), cells[i], x.begin_raw());
      const auto B = mesh().barycentric(cells[i], x.begin_raw());
      for (unsigned int k = 0; k <= dim; ++k)
        if (const unsigned int next = mesh().neighbours[cells[i]][k];
            B[k] <= near && next != Mesh<dim>::missing && std::find(cells.begin(), cells.end(), next) == cells.end())
          cells.push_back(next);
    }
    return share > 1 - near ? 1 : share;
  }

  template double SimplexGrid<2>::share_inside(Point<2> &) const;
  template double SimplexGrid<3>::share_inside(Point<3> &) const;
} // namespace Talus

#include "../check.h"
#include "meshes.h"

#include <talus/kernels/mesh/c1_partition.h>

using namespace Talus;

namespace
{
  using namespace Test;

  /** The shares at a point, by node, with their gradients. */
  template <int dim>
  struct Shares
  {
    Shares(const Mesh<dim> &mesh, const unsigned int cell, const Coordinates<dim> &x) :
      nodes(mesh.nodes[cell]), eta(mesh.n_nodes(), 0.), gradient(mesh.n_nodes(), Coordinates<dim>{})
    {
      const auto grad_B = mesh.gradients(cell);
      const auto shares = c1_shares(feet_of<dim>(grad_B), mesh.barycentric(cell, x.data()));
      for (unsigned int i = 0; i <= dim; ++i)
      {
        eta[nodes[i]] = shares.eta[i];
        for (unsigned int c = 0; c <= dim; ++c)
          for (unsigned int d = 0; d < dim; ++d)
            gradient[nodes[i]][d] += shares.slope[i][c] * grad_B[c][d];
      }
    }
    typename Mesh<dim>::Corners   nodes;
    std::vector<double>           eta;
    std::vector<Coordinates<dim>> gradient;
  };

  double ramp(const double t) { return t * t * (3 - 2 * t); }

  template <int dim>
  void check_sums(const std::string &name, const Mesh<dim> &mesh)
  {
    double sum_error = 0, gradient_sum = 0, least = 0;
    for_points(mesh, 5, [&](const unsigned int c, const auto &x) {
      const Shares<dim> at(mesh, c, x);
      double            sum = -1;
      Coordinates<dim>  total{};
      for (const unsigned int v : at.nodes)
      {
        sum += at.eta[v];
        least = std::min(least, at.eta[v]);
        for (unsigned int d = 0; d < dim; ++d)
          total[d] += at.gradient[v][d] * mesh.longest_edge;
      }
      raise(sum_error, sum);
      for (const double t : total)
        raise(gradient_sum, t);
    });
    check(name + ": sum of shares", sum_error, 1e-14);
    check(name + ": sum of gradients", gradient_sum, 1e-12);
    check(name + ": no share is negative", least, 1e-14);
  }

  /** Inside: differences. Formulas hold beyond a cell's faces, so that both points may use the same cell. */
  template <int dim>
  void check_differences(const std::string &name, const Mesh<dim> &mesh)
  {
    double       difference = 0;
    std::mt19937 random(9);
    const double e = 1e-6 * mesh.longest_edge;
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
    {
      const auto        x = point(mesh, c, barycentric<dim>(random));
      const Shares<dim> here(mesh, c, x);
      for (unsigned int d = 0; d < dim; ++d)
      {
        auto right = x, left = x;
        right[d] += e;
        left[d] -= e;
        const Shares<dim> after(mesh, c, right), before(mesh, c, left);
        for (const unsigned int v : here.nodes)
          raise(difference, mesh.longest_edge * ((after.eta[v] - before.eta[v]) / (2 * e) - here.gradient[v][d]));
      }
    }
    check(name + ": gradient against differences", difference, 1e-7);
  }

  template <int dim>
  void check_faces(const std::string &name, const Mesh<dim> &mesh)
  {
    double jump = 0, gradient_jump = 0;
    for_face_points(mesh, 5, [&](const unsigned int c, const unsigned int beyond, const auto &x) {
      const Shares<dim> one(mesh, c, x), other(mesh, beyond, x);
      for (unsigned int v = 0; v < mesh.n_nodes(); ++v)
      {
        raise(jump, one.eta[v] - other.eta[v]);
        for (unsigned int d = 0; d < dim; ++d)
          raise(gradient_jump, mesh.longest_edge * (one.gradient[v][d] - other.gradient[v][d]));
      }
    });
    check(name + ": jump at faces", jump, 1e-13);
    check(name + ": jump of the gradient at faces", gradient_jump, 1e-12);
  }

  struct EdgeErrors
  {
    double on = 0, along = 0, beside = 0;
  };

  /** On the edge from corner j to i of a cell, and close to it: f, with its gradient along the edge. */
  template <int dim>
  void look_at_edge(const Mesh<dim> &mesh, const unsigned int c, const unsigned int i, const unsigned int j,
                    EdgeErrors &errors)
  {
    typename Mesh<dim>::Barycentric B{};
    B[i]                = .3;
    B[j]                = .7;
    const auto        x = point(mesh, c, B);
    const Shares<dim> at(mesh, c, x);
    const auto       &from = mesh.position[mesh.nodes[c][j]], &to = mesh.position[mesh.nodes[c][i]];
    double            square = 0;
    for (unsigned int d = 0; d < dim; ++d)
      square += std::pow(to[d] - from[d], 2);
    raise(errors.on, at.eta[mesh.nodes[c][i]] - ramp(.3));
    for (unsigned int d = 0; d < dim; ++d)
      raise(errors.along,
            mesh.longest_edge * (at.gradient[mesh.nodes[c][i]][d] - 6 * .3 * .7 * (to[d] - from[d]) / square));
    for (unsigned int k = 0; k <= dim; ++k)
      B[k] += 1e-6 * (1. / (dim + 1) - B[k]);
    const Shares<dim> close(mesh, c, point(mesh, c, B));
    for (unsigned int d = 0; d < dim; ++d)
      raise(errors.beside,
            mesh.longest_edge * (close.gradient[mesh.nodes[c][i]][d] - at.gradient[mesh.nodes[c][i]][d]));
  }

  template <int dim>
  void check_edges(const std::string &name, const Mesh<dim> &mesh)
  {
    EdgeErrors errors;
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      for (unsigned int i = 0; i <= dim; ++i)
        for (unsigned int j = 0; j <= dim; ++j)
          if (i != j)
            look_at_edge(mesh, c, i, j, errors);
    check(name + ": on edges", errors.on, 1e-13);
    check(name + ": gradient on edges", errors.along, 1e-12);
    check(name + ": gradient 1e-6 beside edges", errors.beside, 1e-4);
  }
} // namespace

template <int dim>
void partition()
{
  for (const auto &[name, mesh] : meshes<dim>())
  {
    check_sums(name, mesh);
    check_differences(name, mesh);
    check_faces(name, mesh);
    check_edges(name, mesh);
  }
}

template void partition<1>();
template void partition<2>();
template void partition<3>();

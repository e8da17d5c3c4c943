#include "../check.h"
#include "meshes.h"

#include <map>
#include <set>

namespace
{
  using namespace Test;

  /** Neighbours share all vertices but the two that are opposite; each inner face is seen from both sides. */
  template <int dim>
  void check_neighbours(const std::string &name, const Mesh<dim> &mesh)
  {
    std::map<std::set<unsigned int>, unsigned int> cells_at;
    const auto                                     face = [&](const unsigned int c, const unsigned int k) {
      std::set<unsigned int> vertices(mesh.nodes[c].begin(), mesh.nodes[c].end());
      vertices.erase(mesh.nodes[c][k]);
      return vertices;
    };
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      for (unsigned int k = 0; k <= dim; ++k)
        ++cells_at[face(c, k)];
    unsigned int n_wrong = 0;
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      for (unsigned int k = 0; k <= dim; ++k)
      {
        const unsigned int beyond = mesh.neighbours[c][k];
        n_wrong += (beyond == mesh.missing) != (cells_at[face(c, k)] == 1);
        if (beyond != mesh.missing)
        {
          bool is_shared = false;
          for (unsigned int l = 0; l <= dim; ++l)
            is_shared = is_shared || (mesh.neighbours[beyond][l] == c && face(beyond, l) == face(c, k));
          n_wrong += !is_shared;
        }
      }
    check_true(name + ": neighbours", n_wrong == 0);
  }

  /** Rings, bits and sizes from the list of all edges. */
  template <int dim>
  void check_rings(const std::string &name, const Mesh<dim> &mesh)
  {
    std::vector<std::set<unsigned int>> joined(mesh.n_nodes());
    for (const auto &cell : mesh.nodes)
      for (const unsigned int u : cell)
        joined[u].insert(cell.begin(), cell.end()); // u itself too: A_uu = 1
    unsigned int n_wrong = 0;
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
    {
      std::set<unsigned int> ring, listed;
      for (const unsigned int u : mesh.nodes[c])
        ring.insert(joined[u].begin(), joined[u].end());
      for (unsigned int i = 0; i < mesh.rings.size(c); ++i)
      {
        const unsigned int v = mesh.rings.node[mesh.rings.begin[c] + i];
        listed.insert(v);
        n_wrong += i <= dim && v != mesh.nodes[c][i];
        for (unsigned int u = 0; u <= dim; ++u)
          n_wrong += (mesh.rings.touches[mesh.rings.begin[c] + i] >> u & 1) != joined[mesh.nodes[c][u]].count(v);
      }
      n_wrong += listed != ring || listed.size() != mesh.rings.size(c);
    }
    check_true(name + ": rings", n_wrong == 0);
    // For registers: the same lists, and nodes that touch nothing up to the next multiple of 8.
    n_wrong = mesh.ring_lanes.begin[0] != 0;
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
    {
      const std::size_t begin = mesh.ring_lanes.begin[c], end = mesh.ring_lanes.begin[c + 1];
      n_wrong += begin % 8 != 0 || end < begin + mesh.rings.size(c) || end >= begin + mesh.rings.size(c) + 8;
      for (std::size_t i = begin; i < end; ++i)
      {
        const std::size_t from    = mesh.rings.begin[c] + i - begin;
        const bool        is_real = i - begin < mesh.rings.size(c);
        n_wrong += is_real && mesh.ring_lanes.node[i] != mesh.rings.node[from];
        n_wrong += mesh.ring_lanes.touches[i] != (is_real ? mesh.rings.touches[from] : 0);
        for (unsigned int d = 0; d < dim; ++d)
          n_wrong += mesh.ring_lanes.x[d][i] != mesh.position[mesh.ring_lanes.node[i]][d];
      }
    }
    check_true(name + ": rings for registers", n_wrong == 0);

    double error = 0;
    for (unsigned int v = 0; v < mesh.n_nodes(); ++v)
    {
      double longest = 0;
      for (const unsigned int u : joined[v])
      {
        double square = 0;
        for (unsigned int d = 0; d < dim; ++d)
          square += std::pow(mesh.position[u][d] - mesh.position[v][d], 2);
        longest = std::max(longest, std::sqrt(square));
      }
      raise(error, mesh.size[v] - longest);
    }
    check(name + ": sizes", error, 1e-15);
  }

  /** Barycentric coordinates give back the point, and their gradients its differences. */
  template <int dim>
  void check_coordinates(const std::string &name, const Mesh<dim> &mesh)
  {
    double       error = 0, slope = 0;
    std::mt19937 random(2);
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
    {
      const auto B = barycentric<dim>(random), A = barycentric<dim>(random);
      const auto x = point(mesh, c, B), y = point(mesh, c, A);
      const auto found    = mesh.barycentric(c, x.data());
      const auto gradient = mesh.gradients(c);
      for (unsigned int k = 0; k <= dim; ++k)
      {
        raise(error, found[k] - B[k]);
        double difference = A[k] - B[k];
        for (unsigned int d = 0; d < dim; ++d)
          difference -= gradient[k][d] * (y[d] - x[d]);
        raise(slope, difference);
      }
    }
    check(name + ": barycentric coordinates", error, 1e-14);
    check(name + ": their gradients", slope, 1e-14);
  }
} // namespace

template <int dim>
void tables()
{
  for (const auto &[name, mesh] : meshes<dim>())
  {
    check_neighbours(name, mesh);
    check_rings(name, mesh);
    check_coordinates(name, mesh);
  }
}

template void tables<1>();
template void tables<2>();
template void tables<3>();

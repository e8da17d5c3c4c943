#include <talus/grid/mesh.h>

#include <talus/grid/simplex.h>

#include <algorithm>

namespace Talus
{
  template <int dim>
  void Mesh<dim>::reinit(std::vector<Vector> positions, std::vector<Corners> cells)
  {
    position = std::move(positions);
    nodes    = std::move(cells);
    images.clear();
    owner.assign(n_cells(), 0);
    number.resize(n_cells());
    for (unsigned int c = 0; c < n_cells(); ++c)
      number[c] = c;
    find_inverse_edges();
    find_neighbours();
    find_rings();
    find_sizes();
  }

  template <int dim>
  void Mesh<dim>::find_inverse_edges()
  {
    inverse_edges.resize(n_cells());
    for (unsigned int c = 0; c < n_cells(); ++c)
      inverse_edges[c] = dual(edges<dim>(position, nodes[c]));
  }

  template <int dim>
  void Mesh<dim>::find_neighbours()
  {
    struct Face
    {
      std::array<unsigned int, dim> vertices; // ascending
      unsigned int                  cell, opposite;
    };
    std::vector<Face> faces;
    faces.reserve(n_corners * nodes.size());
    for (unsigned int c = 0; c < n_cells(); ++c)
      for (unsigned int k = 0; k < n_corners; ++k)
      {
        Face face{{}, c, k};
        for (unsigned int i = 0; i < dim; ++i)
          face.vertices[i] = nodes[c][(k + 1 + i) % n_corners];
        std::sort(face.vertices.begin(), face.vertices.end());
        faces.push_back(face);
      }
    std::sort(faces.begin(), faces.end(), [](const Face &a, const Face &b) { return a.vertices < b.vertices; });

    Corners none;
    none.fill(missing);
    neighbours.assign(n_cells(), none);
    for (std::size_t i = 1; i < faces.size(); ++i)
      if (faces[i - 1].vertices == faces[i].vertices)
      {
        neighbours[faces[i].cell][faces[i].opposite]         = faces[i - 1].cell;
        neighbours[faces[i - 1].cell][faces[i - 1].opposite] = faces[i].cell;
      }
  }

  template <int dim>
  void Mesh<dim>::find_rings()
  {
    // The cells around each node.
    std::vector<std::size_t> first(n_nodes() + 1, 0);
    for (const auto &cell : nodes)
      for (const unsigned int v : cell)
        ++first[v + 1];
    for (unsigned int v = 0; v < n_nodes(); ++v)
      first[v + 1] += first[v];
    std::vector<unsigned int> around(first.back());
    auto                      next = first;
    for (unsigned int c = 0; c < n_cells(); ++c)
      for (const unsigned int v : nodes[c])
        around[next[v]++] = c;

    rings.begin.assign(1, 0);
    rings.node.clear();
    rings.touches.clear();
    std::vector<unsigned char> touches(n_nodes(), 0);
    std::vector<unsigned int>  ring;
    for (unsigned int c = 0; c < n_cells(); ++c)
    {
      ring.clear();
      for (unsigned int u = 0; u < n_corners; ++u)
        for (std::size_t i = first[nodes[c][u]]; i < first[nodes[c][u] + 1]; ++i)
          for (const unsigned int v : nodes[around[i]])
          {
            if (touches[v] == 0)
              ring.push_back(v);
            touches[v] |= 1 << u;
          }
      std::sort(ring.begin(), ring.end());
      const auto add = [&](const unsigned int v) {
        rings.node.push_back(v);
        rings.touches.push_back(touches[v]);
        touches[v] = 0;
      };
      for (const unsigned int v : nodes[c])
        add(v);
      for (const unsigned int v : ring)
        if (touches[v] != 0)
          add(v);
      rings.begin.push_back(rings.node.size());
    }
    fill_ring_lanes();
  }

  template <int dim>
  void Mesh<dim>::fill_ring_lanes()
  {
    constexpr unsigned int width = 8;
    auto                  &lanes = ring_lanes;
    lanes.begin.assign(1, 0);
    for (unsigned int c = 0; c < n_cells(); ++c)
      lanes.begin.push_back(lanes.begin[c] + (rings.size(c) + width - 1) / width * width);
    lanes.node.resize(lanes.begin.back());
    lanes.touches.assign(lanes.begin.back(), 0);
    for (auto &coordinates : lanes.x)
      coordinates.resize(lanes.begin.back());
    for (unsigned int c = 0; c < n_cells(); ++c)
      for (std::size_t i = lanes.begin[c]; i < lanes.begin[c + 1]; ++i)
      {
        const std::size_t k       = i - lanes.begin[c];
        const bool        is_real = k < rings.size(c);
        const std::size_t from    = rings.begin[c] + (is_real ? k : 0);
        lanes.node[i]             = rings.node[from];
        lanes.touches[i]          = is_real ? rings.touches[from] : 0;
        for (unsigned int d = 0; d < dim; ++d)
          lanes.x[d][i] = position[lanes.node[i]][d];
      }
  }

  template <int dim>
  void Mesh<dim>::hold(const std::vector<char> &is_held)
  {
    held.assign(n_cells(), 0);
    for (unsigned int c = 0; c < n_cells(); ++c)
    {
      unsigned int mask = 0;
      for (unsigned int u = 0; u < n_corners; ++u)
        mask |= (is_held[nodes[c][u]] ? 1u : 0u) << u;
      held[c] = mask != 0;
      for (std::size_t k = rings.begin[c]; k < rings.begin[c + 1]; ++k)
        if (!is_held[rings.node[k]])
          rings.touches[k] &= ~mask;
    }
    fill_ring_lanes();
  }

  template <int dim>
  void Mesh<dim>::find_sizes()
  {
    size.assign(n_nodes(), 0);
    for (const auto &cell : nodes)
      for (const unsigned int u : cell)
        for (const unsigned int v : cell)
          size[u] = std::max(size[u], distance(position[u], position[v]));
    longest_edge = size.empty() ? 0 : *std::max_element(size.begin(), size.end());
  }

  template struct Mesh<1>;
  template struct Mesh<2>;
  template struct Mesh<3>;
} // namespace Talus

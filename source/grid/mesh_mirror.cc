#include <talus/grid/mesh.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace Talus
{
  namespace
  {
    /** The faces along whose normals velocities are opposite beyond the mirrors of a set: twice opposite is not. */
    template <int dim>
    unsigned char opposite_faces(const std::vector<typename Mesh<dim>::Mirror> &mirrors, const unsigned int set)
    {
      unsigned int faces[dim]       = {};
      bool         is_opposite[dim] = {};
      for (unsigned int m = 0; m < mirrors.size(); ++m)
        if (set >> m & 1)
          for (unsigned int d = 0; d < dim; ++d)
            if (d == mirrors[m].axis || !mirrors[m].slips)
            {
              is_opposite[d] = !is_opposite[d];
              faces[d]       = 1u << (2 * d + (mirrors[m].is_upper ? 1 : 0));
            }
      unsigned int all = 0;
      for (unsigned int d = 0; d < dim; ++d)
        if (is_opposite[d])
          all |= faces[d];
      return all;
    }

    /** The image of a place in a set of mirrors. */
    template <int dim>
    typename Mesh<dim>::Vector image_of(typename Mesh<dim>::Vector                     x,
                                        const std::vector<typename Mesh<dim>::Mirror> &mirrors, const unsigned int set)
    {
      for (unsigned int m = 0; m < mirrors.size(); ++m)
        if (set >> m & 1)
          x[mirrors[m].axis] = 2 * mirrors[m].position - x[mirrors[m].axis];
      return x;
    }

    /** Nodes by their places, which are the same within `unit`. */
    template <int dim>
    class NodesByPlace
    {
    public:
      using Vector = typename Mesh<dim>::Vector;

      explicit NodesByPlace(const double unit) : unit(unit) {}

      void insert(const Vector &x, const unsigned int node) { nodes.emplace(key(x), node); }

      unsigned int find(const Vector &x) const
      {
        unsigned int n_keys = 1;
        for (unsigned int d = 0; d < dim; ++d)
          n_keys *= 3;
        for (unsigned int k = 0; k < n_keys; ++k)
        {
          Key          near = key(x);
          unsigned int rest = k;
          for (unsigned int d = 0; d < dim; ++d, rest /= 3)
            near[d] += static_cast<long>((rest + 1) % 3) - 1; // no shift first
          if (const auto found = nodes.find(near); found != nodes.end())
            return found->second;
        }
        return Mesh<dim>::missing;
      }

    private:
      using Key = std::array<long, dim>;

      Key key(const Vector &x) const
      {
        Key result;
        for (unsigned int d = 0; d < dim; ++d)
          result[d] = std::lround(x[d] / unit);
        return result;
      }

      const double                unit;
      std::map<Key, unsigned int> nodes;
    };
  } // namespace

  template <int dim>
  void Mesh<dim>::mirror(const std::vector<Mirror> &mirrors)
  {
    const unsigned int        n = n_nodes();
    std::vector<unsigned int> on(n, 0); // the mirrors on which a node lies, as bits
    for (unsigned int m = 0; m < mirrors.size(); ++m)
      for (unsigned int v = 0; v < n; ++v)
        on[v] |= (mirrors[m].is_on[v] ? 1u : 0u) << m;

    std::map<std::pair<unsigned int, unsigned int>, unsigned int> number; // of the image of a node in a set of mirrors
    const auto image = [&](const unsigned int v, const unsigned int set) {
      const auto [entry, is_new] = number.emplace(std::make_pair(v, set), n + images.size());
      if (is_new)
      {
        const Vector x = image_of<dim>(position[v], mirrors, set);
        position.push_back(x);
        images.push_back({v, opposite_faces<dim>(mirrors, set)});
      }
      return entry->second;
    };

    Rings all;
    all.begin.push_back(0);
    for (unsigned int c = 0; c < n_cells(); ++c)
    {
      std::map<unsigned int, unsigned char> beyond; // images and what they touch
      for (std::size_t k = rings.begin[c]; k < rings.begin[c + 1]; ++k)
      {
        const unsigned int v = rings.node[k];
        all.node.push_back(v);
        all.touches.push_back(rings.touches[k]);
        for (unsigned int u = 0; u < n_corners; ++u)
          if (rings.touches[k] >> u & 1)
            // All sets of mirrors that meet at u of which none holds v: there it is its own image.
            for (unsigned int set = 1; set < 1u << mirrors.size(); ++set)
              if ((set & ~on[nodes[c][u]]) == 0 && (set & on[v]) == 0)
                beyond[image(v, set)] |= 1u << u;
      }
      for (const auto &[v, touches] : beyond)
      {
        all.node.push_back(v);
        all.touches.push_back(touches);
      }
      all.begin.push_back(all.node.size());
    }
    rings = std::move(all);
    fill_ring_lanes();
  }

  template <int dim>
  bool Mesh<dim>::fold(const std::vector<Mirror> &mirrors, const unsigned int n_of_interest, Vector &missing_image)
  {
    const unsigned int        n    = n_nodes();
    const double              unit = 1e-6 * longest_edge;
    std::vector<unsigned int> beyond(n, 0); // the mirrors beyond which a node lies, as bits
    NodesByPlace<dim>         before(unit);
    for (unsigned int v = 0; v < n; ++v)
    {
      for (unsigned int m = 0; m < mirrors.size(); ++m)
        if ((mirrors[m].is_upper ? 1 : -1) * (position[v][mirrors[m].axis] - mirrors[m].position) > unit)
          beyond[v] |= 1u << m;
      if (beyond[v] == 0)
        before.insert(position[v], v);
    }
    std::vector<unsigned int> image(n, missing);
    for (unsigned int v = 0; v < n; ++v)
      if (beyond[v] != 0)
        if (const unsigned int real = before.find(image_of<dim>(position[v], mirrors, beyond[v])); real != missing)
        {
          image[v] = n + images.size();
          position.push_back(position[v]);
          images.push_back({real, opposite_faces<dim>(mirrors, beyond[v])});
        }
    bool is_complete = true;
    for (unsigned int c = 0; c < n_cells(); ++c)
    {
      const bool is_beyond =
        std::any_of(nodes[c].begin(), nodes[c].end(), [&](const unsigned int v) { return beyond[v] != 0; });
      for (std::size_t k = rings.begin[c]; k < rings.begin[c + 1]; ++k)
        if (unsigned int &v = rings.node[k]; v < n && beyond[v] != 0)
        {
          if (image[v] != missing)
            v = image[v];
          else if (!is_beyond && c < n_of_interest)
          {
            missing_image = position[v];
            is_complete   = false;
          }
        }
    }
    fill_ring_lanes();
    return is_complete;
  }

  template bool Mesh<1>::fold(const std::vector<Mirror> &, const unsigned int, Vector &);
  template bool Mesh<2>::fold(const std::vector<Mirror> &, const unsigned int, Vector &);
  template bool Mesh<3>::fold(const std::vector<Mirror> &, const unsigned int, Vector &);
  template void Mesh<1>::mirror(const std::vector<Mirror> &);
  template void Mesh<2>::mirror(const std::vector<Mirror> &);
  template void Mesh<3>::mirror(const std::vector<Mirror> &);
} // namespace Talus

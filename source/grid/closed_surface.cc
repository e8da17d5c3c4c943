#include <talus/core/exceptions.h>
#include <talus/grid/closed_surface.h>

#include <map>
#include <numeric>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    /**
     * Whether the line through x along the first axis meets the part with these corners; if so, `where` is the
     * coordinate. Corners are compared with "<" on one side and ">=" on the other, and the meeting point with an edge
     * is computed from its ends in the same order for both parts: a line meets one of two neighbours, never both or
     * none.
     */
    bool meets(const std::array<Point<2>, 2> &corner, const Point<2> &x, double &where)
    {
      if ((corner[0][1] < x[1]) == (corner[1][1] < x[1]))
        return false;
      const unsigned int a = corner[0][1] < corner[1][1] ? 0 : 1;
      const double       t = (x[1] - corner[a][1]) / (corner[1 - a][1] - corner[a][1]);
      where                = corner[a][0] + t * (corner[1 - a][0] - corner[a][0]);
      return true;
    }

    bool meets(const std::array<Point<3>, 3> &corner, const Point<3> &x, double &where)
    {
      // The part as seen along x is cut by the line z = x[2] at two edges.
      double       y[2], along[2];
      unsigned int n = 0;
      for (unsigned int e = 0; e < 3 && n < 2; ++e)
      {
        const Point<3> &p = corner[e], &q = corner[(e + 1) % 3];
        if ((p[2] < x[2]) == (q[2] < x[2]))
          continue;
        const bool      is_up = p[2] < q[2];
        const Point<3> &low = is_up ? p : q, &high = is_up ? q : p;
        const double    t = (x[2] - low[2]) / (high[2] - low[2]);
        y[n]              = low[1] + t * (high[1] - low[1]);
        along[n]          = low[0] + t * (high[0] - low[0]);
        ++n;
      }
      if (n < 2 || (y[0] < x[1]) == (y[1] < x[1]))
        return false;
      where = along[0] + (x[1] - y[0]) / (y[1] - y[0]) * (along[1] - along[0]);
      return true;
    }

    std::string edge_text(const Point<3> &a, const Point<3> &b)
    {
      return "the edge from " + to_text<3>(a) + " to " + to_text<3>(b);
    }
  } // namespace

  template <int dim>
  ClosedSurface<dim>::ClosedSurface(const std::vector<Point> &corners, const std::string &name)
  {
    AssertDimension(corners.size() % dim, 0);
    merge(corners);
    AssertThrow(!faces.empty(), InputError("the surface in '" + name + "' is empty: it has no part with an extent. " +
                                           "Check the file, and the scale."));
    check_closed(name);
    if constexpr (dim == 2)
      check_crossings(name);

    std::vector<GrowingBox<dim - 1>> boxes(faces.size());
    for (unsigned int f = 0; f < faces.size(); ++f)
      for (const unsigned int v : faces[f])
      {
        std::array<double, dim - 1> across;
        for (unsigned int d = 1; d < dim; ++d)
          across[d - 1] = vertices[v][d];
        boxes[f].add(across);
      }
    columns = std::make_unique<Bins<dim - 1>>(boxes);
    turn_outwards();
    // The divergence theorem, from a corner so that a place far off costs no digits.
    for (const Face &face : faces)
      inner_volume += (vertices[face[0]] - vertices[0]) * area(face) / dim;
    AssertThrow(inner_volume > 0, InputError("the surface in '" + name + "' holds no volume, or runs through itself. " +
                                             "Export one closed surface a body."));
  }

  template <int dim>
  void ClosedSurface<dim>::merge(const std::vector<Point> &corners)
  {
    std::map<std::array<double, dim>, unsigned int> numbers;
    for (unsigned int c = 0; c < corners.size(); c += dim)
    {
      Face face;
      for (unsigned int k = 0; k < dim; ++k)
      {
        std::array<double, dim> x;
        for (unsigned int d = 0; d < dim; ++d)
          x[d] = corners[c + k][d] + 0.; // no -0
        const auto [entry, is_new] = numbers.emplace(x, vertices.size());
        if (is_new)
          vertices.push_back(corners[c + k]);
        face[k] = entry->second;
      }
      bool has_extent = true;
      for (unsigned int k = 0; k < dim; ++k)
        has_extent = has_extent && face[k] != face[(k + 1) % dim];
      if (has_extent)
        faces.push_back(face);
    }
  }

  template <>
  void ClosedSurface<2>::check_closed(const std::string &name) const
  {
    std::vector<unsigned int> begins(vertices.size(), 0), ends(vertices.size(), 0);
    for (const Face &face : faces)
    {
      ++begins[face[0]];
      ++ends[face[1]];
    }
    for (unsigned int v = 0; v < vertices.size(); ++v)
      AssertThrow(begins[v] == 1 && ends[v] == 1,
                  InputError("the surface in '" + name + "' is not closed: at the corner " + to_text<2>(vertices[v]) +
                             " end " + std::to_string(ends[v]) + " edges and begin " + std::to_string(begins[v]) +
                             ". Repeat the first corner of a polygon as its last one, and no other."));
  }

  template <>
  void ClosedSurface<3>::check_closed(const std::string &name) const
  {
    // Of each edge, from its lower to its higher vertex: how many triangles run through it that way, and against it.
    std::map<std::array<unsigned int, 2>, std::array<unsigned int, 2>> edges;
    for (const Face &face : faces)
      for (unsigned int k = 0; k < 3; ++k)
      {
        const unsigned int a = face[k], b = face[(k + 1) % 3];
        ++edges[{{std::min(a, b), std::max(a, b)}}][a < b ? 0 : 1];
      }
    unsigned int n_open = 0;
    std::string  first;
    for (const auto &[edge, count] : edges)
    {
      const std::string where = edge_text(vertices[edge[0]], vertices[edge[1]]);
      AssertThrow(count[0] + count[1] <= 2,
                  InputError("the surface in '" + name + "' branches: " + where + " belongs to " +
                             std::to_string(count[0] + count[1]) + " triangles. Export one closed surface a body."));
      AssertThrow(count[0] < 2 && count[1] < 2,
                  InputError("triangles of the surface in '" + name + "' are turned against each other: both at " +
                             where +
                             " run through it in the same direction. Let the program that made the file unify "
                             "the normals."));
      if (count[0] + count[1] == 1 && n_open++ == 0)
        first = where;
    }
    AssertThrow(n_open == 0, InputError("the surface in '" + name + "' is not closed: " + std::to_string(n_open) +
                                        " edges belong to one triangle only, the first is " + first +
                                        ". Close the holes, and give corners that meet the same coordinates."));
  }

  template <int dim>
  std::vector<unsigned int> ClosedSurface<dim>::shells() const
  {
    // The root of each vertex in a forest that grows together along the faces.
    std::vector<unsigned int> parent(vertices.size());
    std::iota(parent.begin(), parent.end(), 0);
    const auto root = [&](unsigned int v) {
      while (parent[v] != v)
        v = parent[v] = parent[parent[v]];
      return v;
    };
    for (const Face &face : faces)
      for (unsigned int k = 1; k < dim; ++k)
        parent[root(face[k])] = root(face[0]);
    std::vector<unsigned int> shell;
    for (const Face &face : faces)
      shell.push_back(root(face[0]));
    return shell;
  }

  template <int dim>
  void ClosedSurface<dim>::turn_outwards()
  {
    // Each shell by itself, since one may be a hole in another: a point beside its largest part tells.
    const auto                           shell = shells();
    std::map<unsigned int, unsigned int> largest;
    for (unsigned int f = 0; f < faces.size(); ++f)
    {
      const auto entry = largest.emplace(shell[f], f).first;
      if (area(faces[f]).norm() > area(faces[entry->second]).norm())
        entry->second = f;
    }
    std::map<unsigned int, bool> is_turned;
    for (const auto &[number, f] : largest)
    {
      const Tensor<1, dim> normal = area(faces[f]);
      Point                beside;
      for (const unsigned int v : faces[f])
        beside += vertices[v] / dim;
      const double size = std::pow(normal.norm(), 1. / (dim - 1));
      is_turned[number] = contains(beside + 1e-6 * size / normal.norm() * normal);
    }
    for (unsigned int f = 0; f < faces.size(); ++f)
      if (is_turned[shell[f]])
        std::swap(faces[f][0], faces[f][1]);
  }

  template <>
  Tensor<1, 2> ClosedSurface<2>::area(const Face &face) const
  {
    return cross_product_2d(vertices[face[1]] - vertices[face[0]]);
  }

  template <>
  Tensor<1, 3> ClosedSurface<3>::area(const Face &face) const
  {
    return 0.5 * cross_product_3d(vertices[face[1]] - vertices[face[0]], vertices[face[2]] - vertices[face[0]]);
  }

  template <int dim>
  bool ClosedSurface<dim>::contains(const Point &x) const
  {
    std::array<double, dim - 1> across;
    for (unsigned int d = 1; d < dim; ++d)
      across[d - 1] = x[d];
    bool is_inside = false;
    columns->for_near(across, across, [&](const unsigned int f) {
      std::array<Point, dim> corner;
      for (unsigned int k = 0; k < dim; ++k)
        corner[k] = vertices[faces[f][k]];
      double where = 0;
      if (meets(corner, x, where) && where > x[0])
        is_inside = !is_inside;
    });
    return is_inside;
  }

  template <int dim>
  bool ClosedSurface<dim>::may_meet(const Point &lower, const Point &upper) const
  {
    std::array<double, dim - 1> from, to;
    for (unsigned int d = 1; d < dim; ++d)
    {
      from[d - 1] = lower[d];
      to[d - 1]   = upper[d];
    }
    bool meets = false;
    columns->for_near(from, to, [&](const unsigned int f) {
      if (meets)
        return;
      // Apart along an axis, or all corners of the box on one side of the part's plane?
      const Tensor<1, dim> normal = area(faces[f]);
      double               least = 0, most = 0; // of normal . (corner - vertex)
      bool                 is_apart = false;
      for (unsigned int d = 0; d < dim; ++d)
      {
        double a = vertices[faces[f][0]][d], b = a;
        for (const unsigned int v : faces[f])
        {
          a = std::min(a, vertices[v][d]);
          b = std::max(b, vertices[v][d]);
        }
        is_apart         = is_apart || b < lower[d] || a > upper[d];
        const double one = normal[d] * (lower[d] - vertices[faces[f][0]][d]),
                     two = normal[d] * (upper[d] - vertices[faces[f][0]][d]);
        least += std::min(one, two);
        most += std::max(one, two);
      }
      meets = !is_apart && least <= 0 && most >= 0;
    });
    return meets;
  }

  template <int dim>
  dealii::BoundingBox<dim> ClosedSurface<dim>::bounding_box() const
  {
    return dealii::BoundingBox<dim>(vertices);
  }

  template class ClosedSurface<2>;
  template class ClosedSurface<3>;
} // namespace Talus

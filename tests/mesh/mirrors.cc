#include "../check.h"
#include "meshes.h"

#include <talus/grid/nodal_fields.h>
#include <talus/kernels/mesh/c1_umls.h>

#include <map>

using namespace Talus;

namespace
{
  using namespace Test;

  template <int dim>
  using Key = std::array<long, dim>;

  template <int dim>
  Key<dim> key(const Coordinates<dim> &x)
  {
    Key<dim> result;
    for (unsigned int d = 0; d < dim; ++d)
      result[d] = std::lround(1e8 * x[d]);
    return result;
  }

  /** The walls x_d = 0 of the first n axes; that of the first slips. */
  template <int dim>
  std::vector<typename Mesh<dim>::Mirror> walls(const Mesh<dim> &mesh, const unsigned int n)
  {
    std::vector<typename Mesh<dim>::Mirror> mirrors(n);
    for (unsigned int m = 0; m < n; ++m)
    {
      mirrors[m] = {m, false, 0., m == 0, std::vector<char>(mesh.n_nodes())};
      for (unsigned int v = 0; v < mesh.n_nodes(); ++v)
        mirrors[m].is_on[v] = mesh.position[v][m] < 1e-12;
    }
    return mirrors;
  }

  /** The mesh and its images in the planes x_d = 0 of the first n axes; its cells come first. */
  template <int dim>
  Mesh<dim> with_images(const Mesh<dim> &mesh, const unsigned int n)
  {
    std::vector<Coordinates<dim>>            positions;
    std::vector<typename Mesh<dim>::Corners> cells;
    std::map<Key<dim>, unsigned int>         number;
    for (unsigned int set = 0; set < 1u << n; ++set)
      for (const auto &cell : mesh.nodes)
      {
        cells.emplace_back();
        for (unsigned int k = 0; k <= dim; ++k)
        {
          auto x = mesh.position[cell[k]];
          for (unsigned int d = 0; d < n; ++d)
            if (set >> d & 1)
              x[d] *= -1;
          const auto [entry, is_new] = number.emplace(key<dim>(x), positions.size());
          if (is_new)
            positions.push_back(x);
          cells.back()[k] = entry->second;
        }
      }
    Mesh<dim> result;
    result.reinit(positions, cells);
    return result;
  }

  /** Weights and gradients by the places of nodes. */
  template <int dim>
  std::map<Key<dim>, std::array<double, dim + 1>> by_place(const Stencil<dim> &list, const Coordinates<dim> &x)
  {
    std::map<Key<dim>, std::array<double, dim + 1>> result;
    for (unsigned int k = 0; k < list.size; ++k)
    {
      Coordinates<dim> node;
      for (unsigned int d = 0; d < dim; ++d)
        node[d] = x[d] + list.offset[d][k];
      auto &entry = result[key<dim>(node)];
      entry[dim] += list.weight[k];
      for (unsigned int d = 0; d < dim; ++d)
        entry[d] += list.gradient[d][k];
    }
    return result;
  }
} // namespace

/**
 * A mesh with mirrors has the functions of the mesh that goes on beyond them; what nodes carry is that of their images:
 * beyond the slip wall the normal component is opposite, beyond the others all are, beyond both the product of the
 * signs.
 */
template <int dim>
void mirrors()
{
  for (const auto &[name, half] : meshes<dim>())
    for (unsigned int n = 1; n <= dim; ++n)
    {
      const Mesh<dim> whole  = with_images(half, n);
      Mesh<dim>       mirror = half;
      mirror.mirror(walls(half, n));
      double       error = 0, signs = 0;
      unsigned int n_wrong  = 0;
      const auto  &position = half.position;
      const double edge     = half.longest_edge;
      const auto   compare  = [&](const Stencil<dim> &expected, const Stencil<dim> &list, const Coordinates<dim> &x) {
        const auto a = by_place(expected, x), b = by_place(list, x);
        n_wrong += a.size() != b.size();
        for (const auto &[place, values] : a)
          if (const auto found = b.find(place); found == b.end())
            ++n_wrong;
          else
            for (unsigned int d = 0; d <= dim; ++d)
              raise(error, (values[d] - found->second[d]) * (d < dim ? edge : 1.));
        // v_0 = x_0 and v_d = x_0 x_1 ... of the other walls obey these signs.
        for (unsigned int k = 0; k < list.size; ++k)
        {
          const auto   &real = position[list.place[k]];
          const double *sign = NodalFields<dim>::mirror(list.beyond[k]) + NodalFields<dim>::velocity;
          for (unsigned int d = 0; d < dim; ++d)
          {
            double of_image = 1, of_node = 1;
            for (unsigned int m = 0; m < n; ++m)
              if (m == d || m > 0)
              {
                of_image *= real[m];
                of_node *= x[m] + list.offset[m][k];
              }
            raise(signs, sign[d] * of_image - of_node);
          }
        }
      };
      for_points(half, 2, [&](const unsigned int c, const Coordinates<dim> &x) {
        static Stencil<dim>  expected, list;
        const MeshPoint<dim> point{c, x};
        umls<CubicWeight>(whole, 1, &point, {}, &expected);
        umls<CubicWeight>(mirror, 1, &point, {}, &list);
        compare(expected, list, x);
        c1_umls<CubicWeight>(whole, 1, &point, {}, &expected);
        c1_umls<CubicWeight>(mirror, 1, &point, {}, &list);
        compare(expected, list, x);
      });
      const std::string title = name + ", " + std::to_string(n) + " mirrors: ";
      check(title + "nodes that differ", n_wrong, .5);
      check(title + "functions and gradients", error, 1e-12);
      check(title + "signs", signs, 1e-12);
    }
}

/**
 * A uniform mesh that goes on beyond a slip wall in the middle, and a no-slip wall across: its functions stay what they
 * are, and the nodes beyond stand for those at their mirror images. Where there are none the mesh is refused.
 */
template <int dim>
void folded_layers()
{
  const unsigned int n     = 6;
  const auto         whole = kuhn<dim>(n);
  auto               mesh  = whole;
  Coordinates<dim>   missing{};
  check_true("images", mesh.fold({{0, false, .5, true}, {1, true, .5, false}}, mesh.n_cells(), missing));
  double       error = 0, signs = 0;
  unsigned int n_wrong = 0;
  for_points(whole, 2, [&](const unsigned int c, const Coordinates<dim> &x) {
    for (const unsigned int v : whole.nodes[c])
      if (whole.position[v][0] < .5 - 1e-9 || whole.position[v][1] > .5 + 1e-9)
        return;
    static Stencil<dim>  expected, list;
    const MeshPoint<dim> point{c, x};
    umls<CubicWeight>(whole, 1, &point, {}, &expected);
    umls<CubicWeight>(mesh, 1, &point, {}, &list);
    n_wrong += expected.size != list.size;
    for (unsigned int k = 0; k < list.size; ++k)
    {
      raise(error, list.weight[k] - expected.weight[k]);
      const auto   &real = whole.position[list.place[k]];
      const double *sign = NodalFields<dim>::mirror(list.beyond[k]) + NodalFields<dim>::velocity;
      n_wrong += real[0] < .5 - 1e-9 || real[1] > .5 + 1e-9;
      // v_0 = (x_0 - 1/2)(x_1 - 1/2) and v_d = x_1 - 1/2 obey the signs.
      for (unsigned int d = 0; d < dim; ++d)
      {
        const auto v = [d](const double x_0, const double x_1) { return (d == 0 ? x_0 - .5 : 1.) * (x_1 - .5); };
        raise(signs, sign[d] * v(real[0], real[1]) - v(x[0] + list.offset[0][k], x[1] + list.offset[1][k]));
      }
    }
  });
  check("nodes", n_wrong, .5);
  check("functions", error, 1e-13);
  check("signs", signs, 1e-12);

  auto other = whole;
  check_true("no images", !other.fold({{0, false, .45, true}}, other.n_cells(), missing));
}

template void mirrors<2>();
template void mirrors<3>();
template void folded_layers<2>();
template void folded_layers<3>();

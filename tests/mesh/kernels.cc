#include "mesh_kernels.h"

using namespace Talus;

namespace
{
  using namespace Test;

  template <int dim>
  void check_reproduction(const std::string &name, const Mesh<dim> &mesh, const MeshKernel<dim> &kernel)
  {
    double       unity = 0, linear = 0, sum_of_g = 0, identity = 0, offsets = 0;
    const double h = mesh.longest_edge;
    for_points(mesh, 3, [&](const unsigned int c, const Coordinates<dim> &x) {
      const NodeValues<dim>             at(mesh, kernel, c, x);
      double                            sum = -1;
      Coordinates<dim>                  first{}, slope{};
      std::array<Coordinates<dim>, dim> second{};
      for (unsigned int v = 0; v < mesh.n_nodes(); ++v)
      {
        sum += at.weight[v];
        for (unsigned int d = 0; d < dim; ++d)
        {
          first[d] += at.weight[v] * (mesh.position[v][d] - x[d]) / h;
          slope[d] += at.gradient[v][d] * h;
          for (unsigned int e = 0; e < dim; ++e)
            second[d][e] += mesh.position[v][d] * at.gradient[v][e];
        }
      }
      raise(unity, sum);
      raise(offsets, at.offset_error);
      for (unsigned int d = 0; d < dim; ++d)
      {
        raise(linear, first[d]);
        raise(sum_of_g, slope[d]);
        for (unsigned int e = 0; e < dim; ++e)
          raise(identity, second[d][e] - (d == e));
      }
    });
    check(name + ": partition of unity", unity, 1e-12);
    check(name + ": linear fields", linear, 1e-12);
    check(name + ": sum of g", sum_of_g, 1e-12);
    check(name + ": sum of x (x) g", identity, 1e-12);
    check_true(name + ": offsets", offsets == 0);
  }

  /** The greatest jumps of phi and g h where two cells meet. */
  template <int dim>
  std::pair<double, double> jumps(const Mesh<dim> &mesh, const MeshKernel<dim> &kernel, const unsigned int n_points = 3)
  {
    double weight = 0, gradient = 0;
    for_face_points(mesh, n_points, [&](const unsigned int c, const unsigned int beyond, const Coordinates<dim> &x) {
      const NodeValues<dim> one(mesh, kernel, c, x), other(mesh, kernel, beyond, x);
      for (unsigned int v = 0; v < mesh.n_nodes(); ++v)
      {
        raise(weight, one.weight[v] - other.weight[v]);
        for (unsigned int d = 0; d < dim; ++d)
          raise(gradient, mesh.longest_edge * (one.gradient[v][d] - other.gradient[v][d]));
      }
    });
    return {weight, gradient};
  }

  /** The least phi_v(x_v), seen from all cells at v. */
  template <int dim>
  double least_at_own_node(const Mesh<dim> &mesh, const MeshKernel<dim> &kernel)
  {
    double least = 1;
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      for (const unsigned int v : mesh.nodes[c])
        least = std::min(least, NodeValues<dim>(mesh, kernel, c, mesh.position[v]).weight[v]);
    return least;
  }
} // namespace

template <int dim>
void reproduction()
{
  for (const auto &[name, mesh] : meshes<dim>())
  {
    check_reproduction(name + ", P1", mesh, p1_kernel(mesh));
    for (const auto &kernels : {paper_kernels(mesh), c1_kernels(mesh)})
      for (const auto &kernel : kernels)
      {
        check_reproduction(name + ", " + kernel.name, mesh, kernel);
        check_range(name + ", " + kernel.name + ": least phi_v(x_v)", least_at_own_node(mesh, kernel),
                    dim == 2 ? .15 : .05, 1.);
      }
  }
}

template <int dim>
void continuity()
{
  for (const auto &[name, mesh] : meshes<dim>())
  {
    check(name + ", P1: jump of phi", jumps(mesh, p1_kernel(mesh)).first, 1e-12);
    for (const auto &kernels : {paper_kernels(mesh), c1_kernels(mesh)})
      for (const auto &kernel : kernels)
      {
        const auto jump = jumps(mesh, kernel);
        check(name + ", " + kernel.name + ": jump of phi", jump.first, 1e-12);
        check(name + ", " + kernel.name + ": jump of g h", jump.second, 1e-12);
      }
  }
}

/** Without gamma a node that leaves the ring takes its weight with it: what gamma is for. */
template <int dim>
void ablation()
{
  const auto mesh = mesh_of(gmsh<dim>());
  const auto jump = jumps(mesh, umls_kernel<CubicWeight>("", mesh, {global, false}), 30);
  check_range("without gamma: jump of phi", jump.first, .05, 1.);
  check_range("without gamma: jump of g h", jump.second, .1, 10.);
}

template <int dim>
void true_gradient()
{
  for (const auto &[name, mesh] : meshes<dim>())
    for (const auto &kernel : c1_kernels(mesh))
    {
      double       error = 0;
      std::mt19937 random(9);
      const double e = 1e-6 * mesh.longest_edge;
      for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      {
        const auto            x = point(mesh, c, barycentric<dim>(random));
        const NodeValues<dim> here(mesh, kernel, c, x);
        for (unsigned int d = 0; d < dim; ++d)
        {
          auto right = x, left = x;
          right[d] += e;
          left[d] -= e;
          const NodeValues<dim> after(mesh, kernel, c, right), before(mesh, kernel, c, left);
          for (unsigned int v = 0; v < mesh.n_nodes(); ++v)
            raise(error, mesh.longest_edge * ((after.weight[v] - before.weight[v]) / (2 * e) - here.gradient[v][d]));
        }
      }
      check(name + ", " + kernel.name + ": gradient against differences", error, 1e-7);
    }
}

/** On a line of cells of length 1, the functions of the paper in closed form. */
void line()
{
  Mesh<1>      mesh   = kuhn<1>(5, [](Coordinates<1> x) { return Coordinates<1>{{5 * x[0]}}; });
  const auto   kernel = umls_kernel<CubicWeight>("cubic", mesh, {local, true});
  const double phi[] = {.058013, .634568, .306827, .000593}, g[] = {-.223399, -.549439, .769076, .003763};
  for (const double xi : {0., .25, .6, 1.})
  {
    const NodeValues<1> at(mesh, kernel, 2, {{2 + xi}});
    // M and its inverse by hand, from w in closed form.
    const auto   w0  = [](const double t) { return 2. / 3 - t * t + t * t * t / 2; };
    const double w[] = {std::pow(1 - xi, 4) / 6, w0(xi), w0(1 - xi), std::pow(xi, 4) / 6};
    double       m0 = 0, m1 = 0, m2 = 0;
    for (int i = 0; i < 4; ++i)
    {
      const double d = i - 1 - xi;
      m0 += w[i];
      m1 += w[i] * d;
      m2 += w[i] * d * d;
    }
    double error = 0, slope_error = 0, table = 0;
    for (int i = 0; i < 4; ++i)
    {
      const double d = i - 1 - xi, determinant = m0 * m2 - m1 * m1;
      raise(error, at.weight[i + 1] - w[i] * (m2 - m1 * d) / determinant);
      raise(slope_error, at.gradient[i + 1][0] - w[i] * (m0 * d - m1) / determinant);
      if (xi == .25)
      {
        raise(table, at.weight[i + 1] - phi[i]);
        raise(table, at.gradient[i + 1][0] - g[i]);
      }
    }
    check("weights at xi = " + std::to_string(xi), error, 1e-13);
    check("coefficients", slope_error, 1e-13);
    check("printed values", table, 5e-7);
  }
}

/** Where the nodes of a wall are held, the functions of all others vanish on it, whatever the mesh; the sums remain. */
template <int dim>
void held()
{
  for (const auto &[name, of_name] : meshes<dim>())
  {
    Mesh<dim>         mesh = of_name;
    std::vector<char> is_held(mesh.n_nodes());
    for (unsigned int v = 0; v < mesh.n_nodes(); ++v)
      is_held[v] = mesh.position[v][0] < 1e-9;
    mesh.hold(is_held);
    for (const auto &kernel : {umls_kernel<CubicWeight>("UMLS", mesh, {local, true}),
                               c1_kernel<CubicWeight>("C1 UMLS", mesh, {local, true})})
    {
      double unity = 0, linear = 0, at_wall = 0;
      for_points(mesh, 2, [&](const unsigned int c, const Coordinates<dim> &x) {
        const NodeValues<dim> at(mesh, kernel, c, x);
        double                sum = -1, first = 0;
        for (unsigned int v = 0; v < mesh.n_nodes(); ++v)
        {
          sum += at.weight[v];
          for (unsigned int d = 0; d < dim; ++d)
            first += at.weight[v] * (mesh.position[v][d] - x[d]);
          if (x[0] < 1e-12 && !is_held[v])
            raise(at_wall, at.weight[v]);
        }
        raise(unity, sum);
        raise(linear, first);
      });
      check(name + ", " + kernel.name + ": functions at the wall", at_wall, 1e-6);
      check(name + ", " + kernel.name + ": partition of unity", unity, 1e-6);
      check(name + ", " + kernel.name + ": linear fields", linear, 1e-6);
    }
  }
}

template void reproduction<2>();
template void reproduction<3>();
template void continuity<1>();
template void continuity<2>();
template void continuity<3>();
template void ablation<2>();
template void ablation<3>();
template void true_gradient<1>();
template void true_gradient<2>();
template void true_gradient<3>();
template void held<2>();
template void held<3>();

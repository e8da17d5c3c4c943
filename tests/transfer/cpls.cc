#include "transfer.h"

#include <cmath>

using namespace Test;
using namespace dealii;

namespace
{
  /** v_d = exp(k_d . x), of which no derivative vanishes anywhere and no part is odd or even. */
  constexpr double k[3][3] = {{1, 0.5, -0.7}, {0.6, -1, 0.4}, {-0.5, 0.8, 1}};

  /** The momenta of nodes and particles in a box of edge 1, two particles a cell and direction, with the velocity
   * above. */
  template <int dim>
  struct Momenta
  {
    explicit Momenta(const unsigned int cells);

    Tensor<1, dim> of_nodes, of_particles;
    double         magnitudes = 0; // sum_p m_p |v_p|
  };

  template <int dim>
  Momenta<dim>::Momenta(const unsigned int cells)
  {
    const std::string edges  = dim == 2 ? "-0.5, -0.5" : "-0.5, -0.5, -0.5",
                      others = dim == 2 ? "1.5, 1.5" : "1.5, 1.5, 1.5";
    Setup<dim> setup(section("Grid", set("Lower corner", edges) + set("Upper corner", others) +
                                       set("Spacing", std::to_string(1. / cells))) +
                     section("Kernel", set("Type", "CPDI")) + transfer_text("CPLS") +
                     box_body<dim>({{0, 0, 0}}, {{1, 1, 1}}, 0));
    auto      &particles = setup.particles;
    const auto v         = [&](const unsigned int p, const unsigned int d) {
      double exponent = 0;
      for (unsigned int e = 0; e < dim; ++e)
        exponent += k[d][e] * setup.position(p)[e];
      return std::exp(exponent);
    };
    setup.fill(particles.velocity, v);
    setup.fill(particles.grad_v,
               [&](const unsigned int p, const unsigned int c) { return k[c / dim][c % dim] * v(p, c / dim); });
    setup.scatter();
    setup.grid.fields.add_copies_to_owners();
    setup.transfer->complete(setup.grid);

    for (unsigned int i = 0; i < setup.grid.fields.n_owned(); ++i)
      of_nodes += node_vector(setup, i, NodalFields<dim>::momentum);
    for (unsigned int p = 0; p < particles.size(); ++p)
    {
      const double m = particles.component(particles.mass, 0)[p];
      of_particles += m * velocity(setup, p);
      magnitudes += m * velocity(setup, p).norm();
    }
    for (unsigned int d = 0; d < dim; ++d)
    {
      of_nodes[d]     = sum(of_nodes[d]);
      of_particles[d] = sum(of_particles[d]);
    }
    magnitudes = sum(magnitudes);
  }

  /** The integral of the Laplacian of v_d over the unit box. */
  template <int dim>
  Tensor<1, dim> integrated_laplacian()
  {
    Tensor<1, dim> result;
    for (unsigned int d = 0; d < dim; ++d)
    {
      double square = 0, integral = 1;
      for (unsigned int e = 0; e < dim; ++e)
      {
        square += k[d][e] * k[d][e];
        integral *= (std::exp(k[d][e]) - 1) / k[d][e];
      }
      result[d] = square * integral;
    }
    return result;
  }
} // namespace

/** An affine velocity is exact at all nodes that have mass. */
template <int dim>
void cpls_affine()
{
  const std::string velocity =
    dim == 2 ? "0.3 + 2*x - y; 1 - 0.5*x + 3*y" : "0.3 + 2*x - y + z; 1 - 0.5*x + 3*y; 0.2*x - y + 0.4*z";
  const std::string gradient = dim == 2 ? "2, -1, -0.5, 3" : "2, -1, 1, -0.5, 3, 0, 0.2, -1, 0.4";
  Setup<dim> setup(skewed_grid<dim>({{8, 8, 6}}) + section("Kernel", set("Type", "CPDI")) + transfer_text("CPLS") +
                   body_text(set("Shape", "ball") + set("Centre", coordinates<dim>({{0.1, 1.02, 0.57}})) +
                             set("Radius", "0.2") + set("Velocity", velocity) + set("Velocity gradient", gradient)));
  setup.scatter();
  setup.grid.fields.add_copies_to_owners();
  setup.transfer->complete(setup.grid);
  double       error = 0;
  unsigned int n     = 0;
  for (unsigned int i = 0; i < setup.grid.fields.n_owned(); ++i)
  {
    const double *node = setup.grid.fields[i];
    if (!(node[0] > setup.grid.mass_floor))
      continue;
    ++n;
    const auto   x       = setup.grid.node_position(i);
    const double A[3][3] = {{2, -1, dim == 3 ? 1. : 0.}, {-0.5, 3, 0}, {0.2, -1, 0.4}}, b[3] = {0.3, 1, 0};
    for (unsigned int d = 0; d < dim; ++d)
    {
      double v = b[d];
      for (unsigned int e = 0; e < dim; ++e)
        v += A[d][e] * x[e];
      raise(error, node[NodalFields<dim>::momentum + d] / node[0] - v);
    }
  }
  check("nodes with mass", sum(n) > 20 ? 0. : 2., 1.);
  check("affine velocity", error, 1e-12);
}

/**
 * The nodes' momentum less that of the particles. With half edges r = h/4 and domains that fill the cells, along each
 * axis
 *
 *   sum_i N_ip v(x_i) = v_p + v'' / 2 (r^2 + mean of s (1 - s) h^2),    s = 0, 1/2 where corners are in their cells,
 *   v_i               = v(x_i) + v'' / 2 (h^2 / 3 - f r^2),
 *
 * 1/3 being the second moment of cubic B-splines, and f = 2^dim / (1 + 2^dim) the share of the data that are at
 * corners, where the affine value lacks v'' r^2 / 2. The defect is the sum of both, C h^2 times the integral of rho
 * laplace(v), with C = (1/16 + 1/8 + 1/3 - f/16) / 2, and of third order what nodes near the surface, with one-sided
 * fits, add.
 */
template <int dim>
void cpls_momentum()
{
  const std::vector<unsigned int> cells =
    dim == 2 ? std::vector<unsigned int>{8, 16, 32, 64} : std::vector<unsigned int>{4, 8, 16};
  const double         f = (1 << dim) / (1. + (1 << dim)), density = 3;
  const Tensor<1, dim> leading = 0.5 * (1. / 16 + 1. / 8 + 1. / 3 - f / 16) * density * integrated_laplacian<dim>();
  std::vector<double>  defects, shares;
  for (const unsigned int n : cells)
  {
    const Momenta<dim>   momenta(n);
    const Tensor<1, dim> defect = momenta.of_nodes - momenta.of_particles;
    defects.push_back(defect.norm() / momenta.magnitudes);
    shares.push_back(defect * leading / leading.norm_square() * n * n);
    check("h = 1/" + std::to_string(n) + ", defect over the momenta = " + std::to_string(defects.back()) +
            ": its share of the leading term, less 1, over h",
          (shares.back() - 1) * n, 2);
  }
  const unsigned int last  = cells.size() - 1;
  const auto         order = [&](const unsigned int k) { return std::log2(defects[k - 1] / defects[k]); };
  check_range("order, extrapolated to h = 0", 2 * order(last) - order(last - 1), 1.95, 2.05);
  check_range("share of the leading term, extrapolated to h = 0", 2 * shares[last] - shares[last - 1], 0.995, 1.005);
}

template void cpls_affine<2>();
template void cpls_affine<3>();
template void cpls_momentum<2>();
template void cpls_momentum<3>();

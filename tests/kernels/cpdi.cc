#include <talus/particles/lattice/corners.h>

#include "points.h"

#include <map>

using namespace Test;

namespace
{
  template <int dim>
  using Edges = std::array<dealii::Tensor<1, dim>, dim>;

  /** The corner with the signs of the bits of c. */
  template <int dim>
  dealii::Point<dim> corner(const dealii::Point<dim> &x, const Edges<dim> &r, const unsigned int c)
  {
    dealii::Point<dim> result = x;
    for (unsigned int e = 0; e < dim; ++e)
      result += (c >> e & 1 ? 1. : -1.) * r[e];
    return result;
  }

  /** (1/V) int N_i n dS over the faces of the domain, on which N_i is the mean of its corners' hats. */
  template <int dim, class Hat>
  dealii::Tensor<1, dim> surface_integral(const dealii::Point<dim> &x, const Edges<dim> &r, const Hat &hat)
  {
    const auto area = [&](const unsigned int e) { // of the face in the direction of half edge e
      if constexpr (dim == 2)
      {
        const auto &along = r[1 - e];
        return dealii::Tensor<1, dim>({(e == 0 ? 2. : -2.) * along[1], (e == 0 ? -2. : 2.) * along[0]});
      }
      else
        return 4. * cross_product_3d(r[(e + 1) % 3], r[(e + 2) % 3]);
    };
    dealii::Tensor<1, dim> sum;
    const double           V = 2. * (r[0] * area(0));
    for (unsigned int e = 0; e < dim; ++e)
      for (unsigned int c = 0; c < 1u << dim; ++c)
        sum += (c >> e & 1 ? 1. : -1.) * hat(corner<dim>(x, r, c)) * area(e) / (V * (1u << (dim - 1)));
    return sum;
  }

  template <int dim>
  struct Domain
  {
    dealii::Point<dim>     x;
    Edges<dim>             r0, r; // at first, and now
    dealii::Tensor<2, dim> F;
  };

  /** Anywhere in the grid, sheared and stretched, and stretched much if `is_long`. */
  template <int dim>
  Domain<dim> random_domain(const Lattice<dim> &lattice, const bool is_long, std::mt19937 &random)
  {
    std::uniform_real_distribution<double> uniform(-1, 1);
    Domain<dim>                            domain;
    for (unsigned int d = 0; d < dim; ++d)
    {
      domain.x[d]     = lattice.origin[d] + lattice.h[d] * lattice.n_cells[d] * 0.5 * (1 + uniform(random));
      domain.r0[d][d] = 0.5 * lattice.h[d];
      for (unsigned int e = 0; e < dim; ++e)
        domain.F[d][e] = (d == e ? 1. : 0.) + 0.5 * uniform(random);
    }
    if (is_long)
      domain.F[0] *= 5;
    for (unsigned int e = 0; e < dim; ++e)
      domain.r[e] = domain.F * domain.r0[e];
    return domain;
  }

  /** Whether it may be: not inside out, nor beyond the grid. */
  template <int dim>
  bool is_good(const Lattice<dim> &lattice, const Domain<dim> &domain)
  {
    bool is_inside = determinant(domain.F) > 0.1;
    for (unsigned int c = 0; c < 1u << dim; ++c)
      for (unsigned int d = 0; d < dim; ++d)
        is_inside = is_inside && lattice.is_inside(lattice.coordinate(corner<dim>(domain.x, domain.r, c)[d], d), d);
    return is_inside;
  }

  /** Stencils of one particle. */
  template <int dim>
  class DomainSetup : public Setup<dim>
  {
  public:
    DomainSetup() :
      Setup<dim>(skewed_grid<dim>({{6, 5, 4}}) +
                 section("Kernel", Test::set("Type", "CPDI") + Test::set("Layers", "4")))
    {
      this->kernel->add_fields(set);
      field = Corners<dim>::add_field(set);
      set.resize(1);
    }

    Stencil<dim> at(const Domain<dim> &domain)
    {
      for (unsigned int d = 0; d < dim; ++d)
      {
        set.component(set.position, d)[0] = domain.x[d];
        for (unsigned int e = 0; e < dim; ++e)
        {
          set.component(field, dim * e + d)[0] = domain.r0[e][d];
          set.component(set.F, dim * d + e)[0] = domain.F[d][e];
        }
      }
      Stencil<dim> stencil;
      this->kernel->evaluate(set, 0, 1, &stencil);
      return stencil;
    }

  private:
    WorkingSet<dim> set;
    unsigned int    field;
  };

  struct DomainErrors
  {
    double unity = 0, position = 0, gradients = 0, identity = 0, values = 0, slopes = 0;
  };

  template <int dim>
  void look_at_sums(const Lattice<dim> &lattice, const Stencil<dim> &stencil, DomainErrors &errors)
  {
    double                 sum = 0;
    dealii::Tensor<1, dim> mean, sum_gradient;
    dealii::Tensor<2, dim> moment;
    for (unsigned int k = 0; k < stencil.size; ++k)
    {
      dealii::Tensor<1, dim> offset, gradient;
      for (unsigned int d = 0; d < dim; ++d)
      {
        offset[d]   = stencil.offset[d][k];
        gradient[d] = stencil.gradient[d][k];
      }
      sum += stencil.weight[k];
      mean += stencil.weight[k] * offset;
      sum_gradient += gradient;
      moment += outer_product(offset, gradient);
    }
    raise(errors.unity, sum - 1);
    raise(errors.position, mean.norm());
    raise(errors.gradients, sum_gradient.norm() * lattice.h[0]);
    raise(errors.identity, (moment - dealii::Tensor<2, dim>(dealii::unit_symmetric_tensor<dim>())).norm());
  }

  /** Each node against the definition; several entries of a stencil may be of one node. */
  template <int dim>
  void look_at_nodes(const Lattice<dim> &lattice, const Domain<dim> &domain, const Stencil<dim> &stencil,
                     DomainErrors &errors)
  {
    std::map<unsigned int, std::pair<double, dealii::Tensor<1, dim>>> nodes;
    for (unsigned int k = 0; k < stencil.size; ++k)
    {
      auto &node = nodes[stencil.place[k]];
      node.first += stencil.weight[k];
      for (unsigned int d = 0; d < dim; ++d)
        node.second[d] += stencil.gradient[d][k];
    }
    for (const auto &[place, found] : nodes)
    {
      const auto index = lattice.table_entry(place);
      const auto hat   = [&](const dealii::Point<dim> &y) {
        double value = 1;
        for (unsigned int d = 0; d < dim; ++d)
          value *= std::max(0., 1 - std::abs(lattice.coordinate(y[d], d) - index[d]));
        return value;
      };
      double expected = 0;
      for (unsigned int c = 0; c < 1u << dim; ++c)
        expected += hat(corner<dim>(domain.x, domain.r, c)) / (1u << dim);
      raise(errors.values, found.first - expected);
      raise(errors.slopes, (found.second - surface_integral<dim>(domain.x, domain.r, hat)).norm() * lattice.h[0]);
    }
  }
} // namespace

/** Sheared and stretched domains: the sums that every kernel needs, and each node against the definition. */
template <int dim>
void cpdi()
{
  DomainSetup<dim> setup;
  const auto      &lattice = setup.grid.lattice;
  DomainErrors     errors;
  unsigned int     n_small = 0, n_large = 0;
  std::mt19937     random(3);
  while (n_small < 300 || n_large < 20)
  {
    // Some domains are so long that their nodes are not merged.
    const bool is_long = n_small >= 300;
    const auto domain  = random_domain(lattice, is_long, random);
    if (!is_good(lattice, domain))
      continue;
    ++(is_long ? n_large : n_small);
    const auto stencil = setup.at(domain);
    look_at_sums(lattice, stencil, errors);
    look_at_nodes(lattice, domain, stencil, errors);
  }
  check("partition of unity", errors.unity, 1e-12);
  check("sum phi x_i = x_p", errors.position, 1e-12);
  check("sum of gradients", errors.gradients, 1e-12);
  check("sum x_i (x) grad phi = I", errors.identity, 1e-12);
  check("mean of the hats at the corners", errors.values, 1e-14);
  check("gradient by the divergence theorem", errors.slopes, 1e-12);
}

template void cpdi<2>();
template void cpdi<3>();

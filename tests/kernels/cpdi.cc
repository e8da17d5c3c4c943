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
} // namespace

/** Sheared and stretched domains: the sums that every kernel needs, and each node against the definition. */
template <int dim>
void cpdi()
{
  Setup<dim>      setup(skewed_grid<dim>({{6, 5, 4}}) + section("Kernel", set("Type", "CPDI") + set("Layers", "4")));
  const auto     &lattice = setup.grid.lattice;
  WorkingSet<dim> set;
  setup.kernel->add_fields(set);
  const unsigned int field = Corners<dim>::add_field(set);
  set.resize(1);

  double                                 unity = 0, position = 0, gradients = 0, identity = 0, values = 0, slopes = 0;
  unsigned int                           n_small = 0, n_large = 0;
  std::mt19937                           random(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  while (n_small < 300 || n_large < 20)
  {
    // Some domains are so long that their nodes are not merged.
    const bool             is_long = n_small >= 300;
    dealii::Point<dim>     x;
    Edges<dim>             r0;
    dealii::Tensor<2, dim> F;
    for (unsigned int d = 0; d < dim; ++d)
    {
      x[d]     = lattice.origin[d] + lattice.h[d] * lattice.n_cells[d] * 0.5 * (1 + uniform(random));
      r0[d][d] = 0.5 * lattice.h[d];
      for (unsigned int e = 0; e < dim; ++e)
        F[d][e] = (d == e ? 1. : 0.) + 0.5 * uniform(random);
    }
    if (is_long)
      F[0] *= 5;
    Edges<dim> r;
    bool       is_inside = determinant(F) > 0.1;
    for (unsigned int e = 0; e < dim; ++e)
      r[e] = F * r0[e];
    for (unsigned int c = 0; c < 1u << dim; ++c)
      for (unsigned int d = 0; d < dim; ++d)
        is_inside = is_inside && lattice.is_inside(lattice.coordinate(corner<dim>(x, r, c)[d], d), d);
    if (!is_inside)
      continue;
    ++(is_long ? n_large : n_small);
    for (unsigned int d = 0; d < dim; ++d)
    {
      set.component(set.position, d)[0] = x[d];
      for (unsigned int e = 0; e < dim; ++e)
      {
        set.component(field, dim * e + d)[0] = r0[e][d];
        set.component(set.F, dim * d + e)[0] = F[d][e];
      }
    }
    Stencil<dim> stencil;
    setup.kernel->evaluate(set, 0, 1, &stencil);

    double                                                            sum = 0;
    dealii::Tensor<1, dim>                                            mean, sum_gradient;
    dealii::Tensor<2, dim>                                            moment;
    std::map<unsigned int, std::pair<double, dealii::Tensor<1, dim>>> nodes;
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
      auto &node = nodes[stencil.place[k]];
      node.first += stencil.weight[k];
      node.second += gradient;
    }
    raise(unity, sum - 1);
    raise(position, mean.norm());
    raise(gradients, sum_gradient.norm() * lattice.h[0]);
    raise(identity, (moment - dealii::Tensor<2, dim>(dealii::unit_symmetric_tensor<dim>())).norm());
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
        expected += hat(corner<dim>(x, r, c)) / (1u << dim);
      raise(values, found.first - expected);
      raise(slopes, (found.second - surface_integral<dim>(x, r, hat)).norm() * lattice.h[0]);
    }
  }
  check("partition of unity", unity, 1e-12);
  check("sum phi x_i = x_p", position, 1e-12);
  check("sum of gradients", gradients, 1e-12);
  check("sum x_i (x) grad phi = I", identity, 1e-12);
  check("mean of the hats at the corners", values, 1e-14);
  check("gradient by the divergence theorem", slopes, 1e-12);
}

template void cpdi<2>();
template void cpdi<3>();

#include <talus/particles/material_range.h>
#include <talus/postprocess/energies.h>

#include <deal.II/base/symmetric_tensor.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    /** o cross v, given the matrix v (x) o: component i is eps_ijk A_kj; in 2D the one about z. */
    template <int dim>
    typename Totals<dim>::Rotation rotation(const Tensor<2, dim> &A)
    {
      typename Totals<dim>::Rotation value;
      if constexpr (dim == 2)
        value[0] = A[1][0] - A[0][1];
      else
        for (unsigned int i = 0; i < 3; ++i)
        {
          const unsigned int j = (i + 1) % 3, k = (i + 2) % 3;
          value[i] = A[k][j] - A[j][k];
        }
      return value;
    }

    /** Visits all sums under their names: one list serves message and table. */
    template <class AnyTotals, class Visitor>
    void visit(AnyTotals &totals, const Visitor &visitor)
    {
      constexpr unsigned int dim = std::decay_t<decltype(totals.momentum)>::dimension;
      const std::string      spin("mass length^2/time");
      visitor("mass", "mass", totals.mass);
      visitor("volume", "volume", totals.volume);
      visitor("kinetic energy", "energy", totals.kinetic_energy);
      visitor("strain energy", "energy", totals.strain_energy);
      for (unsigned int d = 0; d < dim; ++d)
        visitor(std::string("momentum ") + "xyz"[d], "mass length/time", totals.momentum[d]);
      for (unsigned int i = 0; i < totals.n_rotations; ++i)
        visitor(std::string("angular momentum ") + "xyz"[dim == 2 ? 2 : i], spin, totals.angular_momentum[i]);
      for (unsigned int i = 0; i < totals.n_rotations; ++i)
        visitor(std::string("total angular momentum ") + "xyz"[dim == 2 ? 2 : i], spin,
                totals.total_angular_momentum[i]);
    }

    template <int dim>
    void add_energies(WorkingSet<dim> &particles, const std::vector<std::unique_ptr<Material>> &materials,
                      Totals<dim> &sum)
    {
      const auto          volume = particles.component(particles.volume, 0);
      std::vector<double> densities;
      for (unsigned int m = 0; m < materials.size(); ++m)
      {
        const MaterialRange range = material_range(particles, m, /* dt = */ 0.);
        densities.resize(range.end - range.begin);
        materials[m]->strain_energy_densities(range, densities.data());
        for (unsigned int p = range.begin; p < range.end; ++p)
          sum.strain_energy += volume[p] * densities[p - range.begin];
        materials[m]->plastic_work_densities(range, densities.data());
        for (unsigned int p = range.begin; p < range.end; ++p)
          sum.plastic_work += volume[p] * densities[p - range.begin];
      }
    }
  } // namespace

  template <int dim>
  void Totals<dim>::add_to(Reduction &reduction)
  {
    visit(*this, [&](const auto &, const auto &, double &value) { reduction.sum(value); });
    reduction.sum(plastic_work);
    reduction.max(greatest_speed);
    for (auto *position : {&least, &greatest})
      for (unsigned int d = 0; d < dim; ++d)
        reduction.max((*position)[d]);
  }

  template <int dim>
  void Totals<dim>::add_to(Table &table) const
  {
    visit(*this, [&](const auto &name, const auto &unit, const double &value) { table.add(name, unit, value); });
    table.add("plastic work", "energy", plastic_work);
    table.add("greatest speed", "length/time", greatest_speed);
    for (unsigned int d = 0; d < dim; ++d)
    {
      table.add(std::string("least ") + "xyz"[d], "length", least[d]);
      table.add(std::string("greatest ") + "xyz"[d], "length", greatest[d]);
    }
  }

  template <int dim>
  Totals<dim> totals(WorkingSet<dim> &particles, const Transfer<dim> &transfer,
                     const std::vector<std::unique_ptr<Material>> &materials, const Communicator &communicator)
  {
    const auto x      = particles.template components<dim>(particles.position);
    const auto v      = particles.template components<dim>(particles.velocity);
    const auto mass   = particles.component(particles.mass, 0);
    const auto volume = particles.component(particles.volume, 0);

    Totals<dim>    sum;
    Tensor<1, dim> least_negated;
    for (unsigned int d = 0; d < dim; ++d)
      sum.greatest[d] = least_negated[d] = -std::numeric_limits<double>::infinity();
    double greatest_square = 0;
    for (unsigned int p = 0; p < particles.size(); ++p)
    {
      Tensor<1, dim> x_p, v_p;
      for (unsigned int d = 0; d < dim; ++d)
      {
        x_p[d]           = x[d][p];
        v_p[d]           = v[d][p];
        least_negated[d] = std::max(least_negated[d], -x_p[d]);
        sum.greatest[d]  = std::max(sum.greatest[d], x_p[d]);
      }
      const double square = v_p.norm_square();
      greatest_square     = std::max(greatest_square, square);
      sum.mass += mass[p];
      sum.volume += volume[p];
      sum.kinetic_energy += 0.5 * mass[p] * square;
      sum.momentum += mass[p] * v_p;
      const auto orbital = mass[p] * rotation(outer_product(v_p, x_p));
      sum.angular_momentum += orbital;
      sum.total_angular_momentum += orbital + mass[p] * rotation(transfer.affine_moment(particles, p));
    }
    add_energies(particles, materials, sum);

    sum.greatest_speed = std::sqrt(greatest_square);
    sum.least          = least_negated;
    Reduction reduction;
    sum.add_to(reduction);
    reduction.run(communicator);
    for (unsigned int d = 0; d < dim; ++d)
    {
      const bool has_particles = std::isfinite(sum.greatest[d]);
      sum.least[d]             = has_particles ? -sum.least[d] : 0.;
      sum.greatest[d]          = has_particles ? sum.greatest[d] : 0.;
    }
    return sum;
  }

  template struct Totals<2>;
  template struct Totals<3>;
  template Totals<2> totals(WorkingSet<2> &, const Transfer<2> &, const std::vector<std::unique_ptr<Material>> &,
                            const Communicator &);
  template Totals<3> totals(WorkingSet<3> &, const Transfer<3> &, const std::vector<std::unique_ptr<Material>> &,
                            const Communicator &);
} // namespace Talus

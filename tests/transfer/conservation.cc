#include "transfer.h"

using namespace Test;

namespace
{
  /** Sums of m and m v over particles, of m_i and m_i v_i over nodes. */
  template <int dim>
  struct Sums
  {
    double                 mass = 0;
    dealii::Tensor<1, dim> momentum;
    double                 magnitude = 0; // sum |m v|, the scale of round-off

    void add(const double m, const dealii::Tensor<1, dim> &mv)
    {
      mass += m;
      momentum += mv;
      magnitude += mv.norm();
    }
    void reduce()
    {
      mass      = sum(mass);
      momentum  = dealii::Utilities::MPI::sum(momentum, MPI_COMM_WORLD);
      magnitude = sum(magnitude);
    }
  };

  template <int dim>
  Sums<dim> of_particles(const Setup<dim> &setup)
  {
    Sums<dim> sums;
    for (unsigned int p = 0; p < setup.particles.size(); ++p)
    {
      const double m = setup.particles.component(setup.particles.mass, 0)[p];
      sums.add(m, m * velocity(setup, p));
    }
    sums.reduce();
    return sums;
  }

  template <int dim>
  Sums<dim> of_nodes(const Setup<dim> &setup, const bool holds_velocity)
  {
    Sums<dim> sums;
    for (unsigned int i = 0; i < setup.grid.fields.n_owned(); ++i)
    {
      const double m = setup.grid.fields[i][NodalFields<dim>::mass];
      sums.add(m, (holds_velocity ? m : 1.) * node_vector(setup, i, NodalFields<dim>::momentum));
    }
    sums.reduce();
    return sums;
  }

  /** sum m (x (x) v - v (x) x), with the particles' own share from B. */
  template <int dim>
  dealii::Tensor<2, dim> angular_momentum(const Setup<dim> &setup)
  {
    dealii::Tensor<2, dim> L;
    for (unsigned int p = 0; p < setup.particles.size(); ++p)
      L += setup.particles.component(setup.particles.mass, 0)[p] *
           (outer_product(setup.position(p), velocity(setup, p)) +
            transpose(setup.transfer->affine_moment(setup.particles, p)));
    return dealii::Utilities::MPI::sum(L - transpose(L), MPI_COMM_WORLD);
  }

  template <int dim>
  dealii::Tensor<2, dim> nodal_angular_momentum(const Setup<dim> &setup)
  {
    dealii::Tensor<2, dim> L;
    for (unsigned int i = 0; i < setup.grid.fields.n_owned(); ++i)
      L += setup.grid.fields[i][NodalFields<dim>::mass] *
           outer_product(setup.grid.node_position(i), node_vector(setup, i, NodalFields<dim>::velocity));
    return dealii::Utilities::MPI::sum(L - transpose(L), MPI_COMM_WORLD);
  }
} // namespace

/** Any treatment is a partition of unity but `none`; the corrected ones and the affine terms keep the momentum. */
template <int dim>
void mass_and_momentum()
{
  for (const std::string treatment : {"WLS", "WLS separable", "WLS everywhere", "MLS"})
    for (const std::string transfer : {"FLIP", "PIC", "blend", "APIC", "TPIC"})
    {
      Setup<dim> setup(full_box<dim>("quadratic B-spline", treatment, transfer));
      randomize_motion(setup);
      const auto before = of_particles(setup);
      setup.scatter();
      setup.grid.fields.add_copies_to_owners();
      const auto        grid = of_nodes(setup, false);
      const std::string name = transfer + ", " + treatment;
      check(name + ": mass on the grid", grid.mass / before.mass - 1, 1e-13);
      check(name + ": momentum on the grid", (grid.momentum - before.momentum).norm() / before.magnitude, 1e-13);
      setup.step(1e-3);
      const auto after = of_particles(setup);
      check(name + ": mass", after.mass / before.mass - 1, 1e-13);
      check(name + ": momentum", (after.momentum - before.momentum).norm() / before.magnitude, 1e-13);
    }
}

/** With linear reproduction, sum phi (x_i - x_p) = 0, APIC keeps the sum of x (x) m v and B both ways. */
template <int dim>
void angular_momentum_of_apic()
{
  for (const std::string kernel : {"linear", "quadratic B-spline", "cubic B-spline", "uGIMP"})
    for (const std::string treatment : {"WLS", "WLS separable", "WLS everywhere", "MLS"})
    {
      Setup<dim> setup(full_box<dim>(kernel, treatment, "APIC"));
      randomize_motion(setup);
      const auto before = angular_momentum(setup);
      setup.step(1e-3);
      const auto        grid = nodal_angular_momentum(setup), after = angular_momentum(setup);
      const std::string name = kernel + ", " + treatment;
      check(name + ": on the grid", (grid - before).norm() / before.norm(), 1e-12);
      check(name + ": after the step", (after - before).norm() / before.norm(), 1e-12);
    }
}

template void mass_and_momentum<2>();
template void mass_and_momentum<3>();
template void angular_momentum_of_apic<2>();
template void angular_momentum_of_apic<3>();

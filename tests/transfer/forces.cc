#include "transfer.h"

using namespace Test;
using namespace dealii;

namespace
{
  const std::vector<std::string> transfers  = {"FLIP", "PIC", "blend", "APIC", "TPIC"};
  const std::vector<std::string> treatments = {"none", "Steffen", "WLS", "WLS separable", "WLS everywhere", "MLS"};

  /** sum phi_ip times a vector of the nodes. */
  template <int dim>
  Tensor<1, dim> gather(const Setup<dim> &setup, const Stencil<dim> &stencil, const unsigned int lane)
  {
    Tensor<1, dim> sum;
    for (unsigned int k = 0; k < stencil.size; ++k)
      sum += stencil.weight[k] * node_vector(setup, setup.node(stencil, k), lane);
    return sum;
  }

  /** The condition that moves all nodes of the grid, or those of its lower face in y. */
  template <int dim>
  std::string moving_nodes(const bool all)
  {
    const std::string where =
      all ? set("Lower corner", coordinates<dim>({{-9, -9, -9}})) + set("Upper corner", coordinates<dim>({{9, 9, 9}})) :
            set("Boundary ids", "2");
    return section(
      "Conditions",
      set("Names", "nodes") +
        section("nodes", set("Type", "velocity") + set("Velocity", coordinates<dim>({{0.3, -0.2, 0.1}}, ";")) + where));
  }
} // namespace

/** Without force and condition the increment of every node is zero. */
template <int dim>
void flip_keeps_velocity()
{
  for (const auto &treatment : treatments)
  {
    Setup<dim> setup(full_box<dim>("quadratic B-spline", treatment, "FLIP"));
    setup.randomize(setup.particles.velocity, 1);
    setup.step(1e-3);
    double error = 0;
    for (unsigned int p = 0; p < setup.particles.size(); ++p)
      for (unsigned int d = 0; d < dim; ++d)
        raise(error, velocity(setup, p)[d] - hashed_jitter(1, setup.particles.id[p], d));
    check(treatment, error, 1e-14);
  }
}

/**
 * The acceleration is (v^{n+1} - v^n)/dt with v^{n+1} after the condition: when all nodes are carried from the
 * bodies' velocity to that of the condition, so are the particles. Next to one face it is compared with the sum.
 */
template <int dim>
void flip_after_condition()
{
  const std::string box = full_box<dim>("quadratic B-spline", "WLS", "FLIP");
  {
    Setup<dim> setup(box + moving_nodes<dim>(true));
    setup.fill(setup.particles.velocity, [](unsigned int, const unsigned int d) { return 1. + d; });
    setup.step(1e-3);
    double error = 0;
    for (unsigned int p = 0; p < setup.particles.size(); ++p)
      for (unsigned int d = 0; d < dim; ++d)
        raise(error, velocity(setup, p)[d] - (d == 0 ? 0.3 : d == 1 ? -0.2 : 0.1));
    check("all nodes", error, 1e-13);
  }
  for (const std::string transfer : {"FLIP", "blend"})
  {
    Setup<dim> setup(full_box<dim>("quadratic B-spline", "WLS", transfer) + moving_nodes<dim>(false));
    setup.randomize(setup.particles.velocity, 1);
    setup.randomize(setup.particles.stress, 2);
    std::vector<Stencil<dim>> stencils;
    for (unsigned int p = 0; p < setup.particles.size(); ++p)
      stencils.push_back(setup.stencil(p));
    setup.step(1e-3);
    // The nodes' velocities before the step: the same particles, no force in no time, no condition.
    Setup<dim> before(full_box<dim>("quadratic B-spline", "WLS", transfer));
    before.randomize(before.particles.velocity, 1);
    before.scatter(0);
    before.grid.fields.add_copies_to_owners();
    before.grid.update_velocity(0);
    before.grid.fields.update_copies();
    using Fields = NodalFields<dim>;
    double error = 0;
    for (unsigned int p = 0; p < setup.particles.size(); ++p)
    {
      const auto     v_new = gather(setup, stencils[p], Fields::velocity);
      Tensor<1, dim> v     = v_new - gather(before, stencils[p], Fields::velocity);
      for (unsigned int d = 0; d < dim; ++d)
        v[d] += hashed_jitter(1, setup.particles.id[p], d);
      const double xi = transfer == "FLIP" ? 1 : 0.95;
      raise(error, (velocity(setup, p) - xi * v - (1 - xi) * v_new).norm());
    }
    check(transfer + ": one face", error, 1e-13);
  }
}

/** x moves with sum phi v^{n+1} in all schemes; grad v is sum v (x) grad phi. */
template <int dim>
void motion()
{
  for (const auto &transfer : transfers)
  {
    Setup<dim> setup(full_box<dim>("quadratic B-spline", "WLS", transfer));
    randomize_motion(setup);
    setup.randomize(setup.particles.stress, 4);
    std::vector<Stencil<dim>> stencils;
    std::vector<Point<dim>>   x;
    for (unsigned int p = 0; p < setup.particles.size(); ++p)
    {
      stencils.push_back(setup.stencil(p));
      x.push_back(setup.position(p));
    }
    const double dt = 1e-3;
    setup.step(dt);
    double x_error = 0, gradient_error = 0;
    for (unsigned int p = 0; p < setup.particles.size(); ++p)
    {
      const auto v = gather(setup, stencils[p], NodalFields<dim>::velocity);
      raise(x_error, (setup.position(p) - x[p] - dt * v).norm() / dt);
      Tensor<2, dim> L;
      for (unsigned int k = 0; k < stencils[p].size; ++k)
        for (unsigned int d = 0; d < dim; ++d)
          for (unsigned int e = 0; e < dim; ++e)
            L[d][e] += setup.grid.fields.at_place(stencils[p].place[k])[NodalFields<dim>::velocity + d] *
                       stencils[p].gradient[e][k];
      raise(gradient_error, (matrix(setup, setup.particles.grad_v, p) - L).norm() / L.norm());
    }
    check(transfer + ": position", x_error, 1e-12); // round-off of x over dt
    check(transfer + ": grad v", gradient_error, 1e-13);
  }
}

/** f_i = -sum V sigma grad phi + sum m phi b(x, t), summed here node by node. */
template <int dim>
void nodal_force()
{
  const std::vector<std::string> bodies = dim == 2 ?
                                            std::vector<std::string>{"0; 0", "0.5; -2", "x*y + t; y - 2*t"} :
                                            std::vector<std::string>{"0; 0; 0", "0.5; -2; 1", "x*y + t; y - 2*t; x*z"};
  for (const auto &transfer : transfers)
    for (unsigned int b = 0; b < 3; ++b)
    {
      Setup<dim> setup(full_box<dim>("quadratic B-spline", "WLS", transfer));
      randomize_motion(setup);
      setup.randomize(setup.particles.stress, 4);
      setup.accelerate(bodies[b]);
      const double time = 0.7;
      setup.scatter(time);
      auto                       &particles = setup.particles;
      std::vector<Tensor<1, dim>> force(setup.grid.fields.n_local());
      for (unsigned int p = 0; p < particles.size(); ++p)
      {
        const auto     stencil = setup.stencil(p);
        const auto     x       = setup.position(p);
        Tensor<2, dim> sigma;
        for (unsigned int d = 0; d < dim; ++d)
          sigma[d][d] = particles.component(particles.stress, d)[p];
        sigma[0][1] = sigma[1][0] = particles.component(particles.stress, 3)[p];
        Tensor<1, dim> a;
        if (b == 1)
          a[0] = 0.5, a[1] = -2;
        else if (b == 2)
          a[0] = x[0] * x[1] + time, a[1] = x[1] - 2 * time;
        if constexpr (dim == 3)
        {
          sigma[0][2] = sigma[2][0] = particles.component(particles.stress, 4)[p];
          sigma[1][2] = sigma[2][1] = particles.component(particles.stress, 5)[p];
          a[2]                      = b == 0 ? 0. : b == 1 ? 1. : x[0] * x[2];
        }
        for (unsigned int k = 0; k < stencil.size; ++k)
        {
          Tensor<1, dim> gradient;
          for (unsigned int d = 0; d < dim; ++d)
            gradient[d] = stencil.gradient[d][k];
          force[setup.node(stencil, k)] += particles.component(particles.mass, 0)[p] * stencil.weight[k] * a -
                                           particles.component(particles.volume, 0)[p] * (sigma * gradient);
        }
      }
      double error = 0, largest = 0;
      for (unsigned int i = 0; i < force.size(); ++i)
      {
        raise(error, (node_vector(setup, i, NodalFields<dim>::force) - force[i]).norm());
        raise(largest, force[i].norm());
      }
      check(transfer + ", b = (" + bodies[b] + ")", error / largest, 1e-13);
    }
}

template void flip_keeps_velocity<2>();
template void flip_keeps_velocity<3>();
template void flip_after_condition<2>();
template void flip_after_condition<3>();
template void motion<2>();
template void motion<3>();
template void nodal_force<2>();
template void nodal_force<3>();

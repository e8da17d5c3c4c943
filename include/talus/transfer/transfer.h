#pragma once

#include <talus/core/body_force.h>
#include <talus/grid/grid.h>
#include <talus/kernels/kernel.h>
#include <talus/particles/working_set.h>

namespace Talus
{
  /**
   * Carries mass, momentum and force to the nodes and motion back to the
   * particles. A transfer owns its passes over the particles.
   */
  template <int dim>
  class Transfer : public dealii::ParameterAcceptor
  {
  public:
    using dealii::ParameterAcceptor::ParameterAcceptor;

    /** Adds what the transfer stores on particles beyond the common fields. */
    virtual void add_fields(WorkingSet<dim> &) {}

    /** Makes the added fields consistent with the initial velocity gradient. */
    virtual void initialize(const Kernel<dim> &, WorkingSet<dim> &) const {}

    /**
     * A lone particle of a fluid is stable while dt^2 c^2 sum_d (a S_d + b q_d) / h_d^2 <= 1, see
     * Kernel::greatest_stiffness(): the scheme's a and b. Theory: doc/walls.md.
     */
    virtual std::array<double, 2> stiffness_factors() const { return {{0.5, 0.}}; }

    /** What particles may ask of the grid around them. */
    virtual Reach reach(const Kernel<dim> &kernel) const { return kernel.reach(); }

    /** Eqs. (11)-(16): adds m_i, m_i v_i and f_i of this rank's particles to the nodes, copies included. */
    virtual void particle_to_grid(const WorkingSet<dim> &particles, const Kernel<dim> &kernel,
                                  const BodyForce<dim> &acceleration, const double time, Grid<dim> &grid) = 0;

    /** Changes the sums at the nodes once their owners have all of them: velocities that are not momentum over mass.
     * Collective. */
    virtual void complete(Grid<dim> &) {}

    /**
     * Eqs. (22)-(26), (31) for the particles begin .. end - 1: new velocity, position, velocity gradient and
     * what the transfer stores. Returns the largest displacement along an axis [spacing].
     */
    virtual double grid_to_particle(const Grid<dim> &grid, const Kernel<dim> &kernel, const double dt,
                                    WorkingSet<dim> &particles, const unsigned int begin,
                                    const unsigned int end) const = 0;

    /** The same for all particles. */
    double grid_to_particle(const Grid<dim> &grid, const Kernel<dim> &kernel, const double dt,
                            WorkingSet<dim> &particles) const
    {
      return grid_to_particle(grid, kernel, dt, particles, 0, particles.size());
    }

    /** sum_i phi_ip v_i (x) (x_i - x_p) of a particle where the transfer keeps it: its share of angular momentum. */
    virtual dealii::Tensor<2, dim> affine_moment(const WorkingSet<dim> &, const unsigned int /*p*/) const { return {}; }

    /** Through stencils as lists, whatever the kernel: slow, and the reference of the compiled loops. */
    bool is_plain = false;
  };
} // namespace Talus

#pragma once

#include <talus/transfer/transfer.h>

#include <algorithm>

namespace Talus
{
  /** What a particle gathers from its nodes; `B` only where the scheme asks for it. */
  template <int dim>
  struct Gathered
  {
    dealii::Tensor<1, dim> velocity;  // sum phi v^{n+1}, Eq. (23)
    dealii::Tensor<1, dim> increment; // sum phi (v^{n+1} - v^n) = dt sum phi a, after the conditions
    dealii::Tensor<2, dim> grad_v;    // sum v^{n+1} (x) grad phi, Eq. (26)
    dealii::Tensor<2, dim> B;         // sum phi v^{n+1} (x) (x_i - x_p), Eq. (25)
  };

  /**
   * All schemes that scatter v_p + C_p (x_i - x_p), Eqs. (15)-(19), and gather
   * once. A `Scheme<dim>` states how they differ:
   * - is_affine, gathers_B: constants,
   * - affine(particles, p, stencil): C_p [1/time], called only if is_affine,
   * - update(particles, p, gathered): sets the particle's velocity and what the
   *   scheme stores (position and velocity gradient are the same for all),
   * - add_parameters(object), add_fields(particles), initialize(...), affine_moment(...).
   */
  template <int dim, template <int> class Scheme>
  class AffineTransfer : public Transfer<dim>
  {
  public:
    explicit AffineTransfer(const std::string &section) : Transfer<dim>(section) { scheme.add_parameters(*this); }

    void add_fields(WorkingSet<dim> &particles) override { scheme.add_fields(particles); }

    void initialize(const Kernel<dim> &kernel, WorkingSet<dim> &particles) const override
    {
      for_each_stencil(particles, kernel, [&](const unsigned int p, const Stencil<dim> &stencil) {
        scheme.initialize(particles, p, stencil);
      });
    }

    void particle_to_grid(const WorkingSet<dim> &particles, const Kernel<dim> &kernel,
                          const ParsedVector<dim> &acceleration, const double time, Grid<dim> &grid) const override
    {
      const auto x = particles.template components<dim>(particles.position);
      auto       b = acceleration.value({}, time);
      for_each_stencil(particles, kernel, [&](const unsigned int p, const Stencil<dim> &stencil) {
        if (acceleration.depends_on_space())
        {
          dealii::Point<dim> x_p;
          for (unsigned int d = 0; d < dim; ++d)
            x_p[d] = x[d][p];
          b = acceleration.value(x_p, time);
        }
        scatter(contribution(particles, p, stencil, b), stencil, grid.fields);
      });
    }

    void grid_to_particle(const Grid<dim> &grid, const Kernel<dim> &kernel, const double dt,
                          WorkingSet<dim> &particles) const override
    {
      const auto x      = particles.template components<dim>(particles.position);
      const auto grad_v = particles.template components<dim * dim>(particles.grad_v);
      for_each_stencil(particles, kernel, [&](const unsigned int p, const Stencil<dim> &stencil) {
        const Gathered<dim> sum = gather(stencil, grid.fields);
        for (unsigned int d = 0; d < dim; ++d)
        {
          x[d][p] += dt * sum.velocity[d]; // Eq. (31), for FLIP as well
          for (unsigned int e = 0; e < dim; ++e)
            grad_v[d * dim + e][p] = sum.grad_v[d][e];
        }
        scheme.update(particles, p, sum);
      });
    }

    dealii::Tensor<2, dim> affine_moment(const WorkingSet<dim> &particles, const unsigned int p) const override
    {
      return scheme.affine_moment(particles, p);
    }

  private:
    using Fields = NodalFields<dim>;
    using Lanes  = typename Fields::Lanes;

    /** What a particle adds to the lanes of a node: phi (constant + linear . offset) + flux . grad phi. */
    struct Contribution
    {
      Lanes constant{}, linear[dim]{}, flux[dim]{};
    };

    Contribution contribution(const WorkingSet<dim> &particles, const unsigned int p, const Stencil<dim> &stencil,
                              const dealii::Tensor<1, dim> &b) const
    {
      const double m = particles.component(particles.mass, 0)[p], V = particles.component(particles.volume, 0)[p];
      Contribution add;
      add.constant[Fields::mass] = m; // Eq. (13)
      for (unsigned int d = 0; d < dim; ++d)
      {
        add.constant[Fields::momentum + d] = m * particles.component(particles.velocity, d)[p]; // Eq. (15)
        add.constant[Fields::force + d]    = m * b[d];                                          // Eq. (12)
        for (unsigned int e = 0; e < dim; ++e)
        {
          // xy, xz, yz follow the three diagonal components.
          const double stress            = particles.component(particles.stress, d == e ? d : 2 + d + e)[p];
          add.flux[e][Fields::force + d] = -V * stress; // Eq. (11)
        }
      }
      if constexpr (Scheme<dim>::is_affine)
      {
        const dealii::Tensor<2, dim> C = scheme.affine(particles, p, stencil);
        for (unsigned int d = 0; d < dim; ++d)
          for (unsigned int e = 0; e < dim; ++e)
            add.linear[e][Fields::momentum + d] = m * C[d][e]; // Eqs. (17), (19)
      }
      return add;
    }

    /** The lanes of a node are treated alike, so that one vector instruction serves them all. */
    static void scatter(const Contribution &add, const Stencil<dim> &stencil, Fields &fields)
    {
      for (unsigned int k = 0; k < stencil.size; ++k)
      {
        Lanes constant = add.constant, flux{};
        for (unsigned int e = 0; e < dim; ++e)
        {
          if constexpr (Scheme<dim>::is_affine)
            constant += add.linear[e] * stencil.offset[e][k];
          flux += add.flux[e] * stencil.gradient[e][k];
        }
        fields.lanes(stencil.node[k]) += stencil.weight[k] * constant + flux;
      }
    }

    static Gathered<dim> gather(const Stencil<dim> &stencil, const Fields &fields)
    {
      Lanes value{}, gradient[dim]{}, moment[dim]{};
      for (unsigned int k = 0; k < stencil.size; ++k)
      {
        const Lanes node = fields.lanes(stencil.node[k]);
        value += stencil.weight[k] * node;
        for (unsigned int e = 0; e < dim; ++e)
        {
          gradient[e] += stencil.gradient[e][k] * node;
          if constexpr (Scheme<dim>::gathers_B)
            moment[e] += (stencil.weight[k] * stencil.offset[e][k]) * node;
        }
      }
      Gathered<dim> sum;
      for (unsigned int d = 0; d < dim; ++d)
      {
        sum.velocity[d]  = value[Fields::velocity + d];
        sum.increment[d] = value[Fields::increment + d];
        for (unsigned int e = 0; e < dim; ++e)
        {
          sum.grad_v[d][e] = gradient[e][Fields::velocity + d];
          sum.B[d][e]      = moment[e][Fields::velocity + d];
        }
      }
      return sum;
    }

    /** Evaluates the kernel for a few particles at a time, so that their stencils stay in the cache. */
    template <class Body>
    static void for_each_stencil(const WorkingSet<dim> &particles, const Kernel<dim> &kernel, const Body &body)
    {
      constexpr unsigned int batch = 8;
      Stencil<dim>           stencils[batch];
      for (unsigned int begin = 0; begin < particles.size(); begin += batch)
      {
        const unsigned int end = std::min(begin + batch, particles.size());
        kernel.evaluate(particles, begin, end, stencils);
        for (unsigned int p = begin; p < end; ++p)
          body(p, stencils[p - begin]);
      }
    }

    Scheme<dim> scheme;
  };

  /** What a scheme has unless it says otherwise. */
  template <int dim>
  struct SchemeDefaults
  {
    static constexpr bool is_affine = false;
    static constexpr bool gathers_B = false;

    void                   add_parameters(dealii::ParameterAcceptor &) {}
    void                   add_fields(WorkingSet<dim> &) {}
    void                   initialize(WorkingSet<dim> &, const unsigned int, const Stencil<dim> &) const {}
    dealii::Tensor<2, dim> affine_moment(const WorkingSet<dim> &, const unsigned int) const { return {}; }

    static void set_velocity(WorkingSet<dim> &particles, const unsigned int p, const dealii::Tensor<1, dim> &v)
    {
      for (unsigned int d = 0; d < dim; ++d)
        particles.component(particles.velocity, d)[p] = v[d];
    }
  };
} // namespace Talus

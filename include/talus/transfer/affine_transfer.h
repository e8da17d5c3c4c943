#pragma once

#include <talus/transfer/transfer.h>

#include <algorithm>

namespace Talus
{
  /** What a particle gathers from its nodes; `increment` and `B` only where the scheme asks for them. */
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
   * - is_affine, gathers_increment, gathers_B: constants,
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
      for_each_stencil(particles, kernel,
                       [&](const unsigned int p, const Stencil<dim> &stencil)
                       { scheme.initialize(particles, p, stencil); });
    }

    void particle_to_grid(const WorkingSet<dim> &particles, const Kernel<dim> &kernel,
                          const ParsedVector<dim> &acceleration, const double time, Grid<dim> &grid) const override
    {
      using Fields      = NodalFields<dim>;
      const auto x      = particles.template components<dim>(particles.position);
      const auto v      = particles.template components<dim>(particles.velocity);
      const auto stress = particles.template components<WorkingSet<dim>::n_stress>(particles.stress);
      const auto mass   = particles.component(particles.mass, 0);
      const auto volume = particles.component(particles.volume, 0);
      auto       b      = acceleration.value({}, time);

      for_each_stencil(particles, kernel,
                       [&](const unsigned int p, const Stencil<dim> &stencil)
                       {
                         const double m = mass[p], V = volume[p];
                         // The stress times volume; xy, xz, yz follow the three diagonal entries.
                         double V_sigma[dim][dim];
                         for (unsigned int d = 0; d < dim; ++d)
                           for (unsigned int e = 0; e < dim; ++e)
                             V_sigma[d][e] = V * stress[d == e ? d : 2 + d + e][p];
                         double v_p[dim], C[dim][dim];
                         for (unsigned int d = 0; d < dim; ++d)
                           v_p[d] = v[d][p];
                         if constexpr (Scheme<dim>::is_affine)
                         {
                           const dealii::Tensor<2, dim> affine = scheme.affine(particles, p, stencil);
                           for (unsigned int d = 0; d < dim; ++d)
                             for (unsigned int e = 0; e < dim; ++e)
                               C[d][e] = affine[d][e];
                         }
                         if (acceleration.depends_on_space())
                         {
                           dealii::Point<dim> x_p;
                           for (unsigned int d = 0; d < dim; ++d)
                             x_p[d] = x[d][p];
                           b = acceleration.value(x_p, time);
                         }

                         for (unsigned int k = 0; k < stencil.size; ++k)
                         {
                           double      *node = grid.fields[stencil.node[k]];
                           const double m_ip = m * stencil.weight[k];
                           node[Fields::mass] += m_ip; // Eq. (13)
                           for (unsigned int d = 0; d < dim; ++d)
                           {
                             double v_ip = v_p[d];
                             double f_ip = m_ip * b[d]; // Eq. (12)
                             for (unsigned int e = 0; e < dim; ++e)
                             {
                               if constexpr (Scheme<dim>::is_affine)
                                 v_ip += C[d][e] * stencil.offset[e][k];       // Eqs. (17), (19)
                               f_ip -= V_sigma[d][e] * stencil.gradient[e][k]; // Eq. (11)
                             }
                             node[Fields::momentum + d] += m_ip * v_ip; // Eq. (16)
                             node[Fields::force + d] += f_ip;
                           }
                         }
                       });
    }

    void grid_to_particle(const Grid<dim> &grid, const Kernel<dim> &kernel, const double dt,
                          WorkingSet<dim> &particles) const override
    {
      using Fields      = NodalFields<dim>;
      const auto x      = particles.template components<dim>(particles.position);
      const auto grad_v = particles.template components<dim * dim>(particles.grad_v);

      for_each_stencil(particles, kernel,
                       [&](const unsigned int p, const Stencil<dim> &stencil)
                       {
                         Gathered<dim> sum;
                         for (unsigned int k = 0; k < stencil.size; ++k)
                         {
                           const double *node = grid.fields[stencil.node[k]];
                           for (unsigned int d = 0; d < dim; ++d)
                           {
                             const double v_i = node[Fields::velocity + d];
                             sum.velocity[d] += stencil.weight[k] * v_i;
                             for (unsigned int e = 0; e < dim; ++e)
                               sum.grad_v[d][e] += v_i * stencil.gradient[e][k];
                             if constexpr (Scheme<dim>::gathers_increment)
                               sum.increment[d] += stencil.weight[k] * (v_i - node[Fields::old_velocity + d]);
                             if constexpr (Scheme<dim>::gathers_B)
                               for (unsigned int e = 0; e < dim; ++e)
                                 sum.B[d][e] += stencil.weight[k] * v_i * stencil.offset[e][k];
                           }
                         }
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
    static constexpr bool is_affine         = false;
    static constexpr bool gathers_increment = false;
    static constexpr bool gathers_B         = false;

    void                   add_parameters(dealii::ParameterAcceptor &) {}
    void                   add_fields(WorkingSet<dim> &) {}
    void                   initialize(WorkingSet<dim> &, const unsigned int, const Stencil<dim> &) const {}
    dealii::Tensor<2, dim> affine_moment(const WorkingSet<dim> &, const unsigned int) const { return {}; }

    static void set_velocity(WorkingSet<dim> &particles, const unsigned int p, const dealii::Tensor<1, dim> &v)
    {
      for (unsigned int d = 0; d < dim; ++d)
        particles.component(particles.velocity, d)[p] = v[d];
    }
    static dealii::Tensor<1, dim> velocity(const WorkingSet<dim> &particles, const unsigned int p)
    {
      dealii::Tensor<1, dim> v;
      for (unsigned int d = 0; d < dim; ++d)
        v[d] = particles.component(particles.velocity, d)[p];
      return v;
    }
    static dealii::Tensor<2, dim> matrix(const WorkingSet<dim> &particles, const unsigned int field,
                                         const unsigned int p)
    {
      dealii::Tensor<2, dim> value;
      for (unsigned int c = 0; c < dim * dim; ++c)
        value[c / dim][c % dim] = particles.component(field, c)[p];
      return value;
    }
  };
} // namespace Talus

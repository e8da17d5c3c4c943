#pragma once

#include <talus/core/body_force.h>
#include <talus/particles/batch_access.h>
#include <talus/particles/working_set.h>

#include <deal.II/base/parameter_acceptor.h>

namespace Talus
{
  /** The arrays that transfers read and write. */
  template <int dim>
  struct TransferArrays
  {
    explicit TransferArrays(WorkingSet<dim> &particles) :
      position(particles.template components<dim>(particles.position)),
      velocity(particles.template components<dim>(particles.velocity)),
      grad_v(particles.template components<dim * dim>(particles.grad_v)),
      stress(particles.template components<WorkingSet<dim>::n_stress>(particles.stress)),
      initial_position(particles.template components<dim>(particles.initial_position)),
      mass(particles.component(particles.mass, 0)), volume(particles.component(particles.volume, 0)),
      F(particles.template components<dim * dim>(particles.F))
    {
    }

    std::array<double *, dim>                       position, velocity;
    std::array<double *, dim * dim>                 grad_v;
    std::array<double *, WorkingSet<dim>::n_stress> stress;
    std::array<double *, dim>                       initial_position;
    double                                         *mass, *volume;
    std::array<double *, dim * dim>                 F;   // not read: what follows the gather does
    std::array<double *, dim * dim>                 B{}; // the affine moment, where a scheme stores it
  };

  /** What particles gather from their nodes; `B` and `increment` only where the scheme asks for them. */
  template <int dim, typename Number>
  struct Gathered
  {
    dealii::Tensor<1, dim, Number> velocity;  // sum phi v^{n+1}, Eq. (23)
    dealii::Tensor<1, dim, Number> increment; // sum phi (v^{n+1} - v^n) = dt sum phi a, after the conditions
    dealii::Tensor<2, dim, Number> grad_v;    // sum v^{n+1} (x) grad phi, Eq. (26)
    dealii::Tensor<2, dim, Number> B;         // sum phi v^{n+1} (x) (x_i - x_p), Eq. (25)
  };

  /**
   * C - (I - n n^T) C n n^T for the normals n of the axes where `is_at_slip_wall`. Next to a slip wall the correction
   * of a kernel makes d v_t / d n a difference of the last two nodes, which grows when it is handed back to them:
   * doc/quiet_floor.md. Momentum does not change.
   */
  template <int dim, typename Number, class Mask>
  dealii::Tensor<2, dim, Number> without_wall_shear(dealii::Tensor<2, dim, Number> C, const Mask &is_at_slip_wall)
  {
    for (unsigned int n = 0; n < dim; ++n)
      for (unsigned int t = 0; t < dim; ++t)
        if (t != n)
          C[t][n] = select(is_at_slip_wall[n], Number(0.), C[t][n]);
    return C;
  }

  /**
   * How the schemes that scatter v_p + C_p (x_i - x_p), Eqs. (15)-(19), and gather
   * once differ. What is here holds unless a scheme says otherwise; its functions
   * are templates on the batch, one particle or several.
   */
  template <int dim>
  struct Scheme
  {
    static constexpr bool is_affine         = false; // C_p is not zero: affine(arrays, batch, D, h) gives it [1/time]
    static constexpr bool needs_D           = false; // affine() reads D, Eq. (18)
    static constexpr bool gathers_B         = false;
    static constexpr bool gathers_increment = false;

    // See Transfer::stiffness_factors(); these for schemes that lose velocity differences within a particle in each
    // step.
    static constexpr std::array<double, 2> stiffness_factors = {{0.5, 0.}};

    /** Leaves d v_t / d n out of C_p of particles at slip walls; for affine schemes: see without_wall_shear(). */
    bool projects_slip = false;

    void                   add_parameters(dealii::ParameterAcceptor &) {}
    void                   add_fields(WorkingSet<dim> &) {}
    void                   bind(WorkingSet<dim> &, TransferArrays<dim> &) const {} // sets arrays of own fields
    dealii::Tensor<2, dim> affine_moment(const WorkingSet<dim> &, const unsigned int) const { return {}; }

    /** Sets own fields from grad v and D before the first step, if the scheme needs D. */
    void initialize(const TransferArrays<dim> &, const SingleBatch &, const dealii::SymmetricTensor<2, dim> &) const {}

    // template <class Batch>
    // void update(arrays, batch, gathered) const: the new velocity and what the scheme stores.
  };

  /** The body force per mass on each particle of a batch. */
  template <int dim>
  dealii::Tensor<1, dim, Simd<native_width>> body_force(const BodyForce<dim>                             &acceleration,
                                                        const dealii::Tensor<1, dim, Simd<native_width>> &x,
                                                        const double                                      time)
  {
    dealii::Tensor<1, dim, Simd<native_width>> b;
    for (unsigned int l = 0; l < native_width; ++l)
    {
      dealii::Point<dim> x_p;
      for (unsigned int d = 0; d < dim; ++d)
        x_p[d] = x[d][l];
      const auto b_p = acceleration.value(x_p, time);
      for (unsigned int d = 0; d < dim; ++d)
        b[d].set(l, b_p[d]);
    }
    return b;
  }

  /** The same for batch after batch, at one time; quick where the body force is uniform. */
  template <int dim>
  class BodyForceOnBatch
  {
  public:
    BodyForceOnBatch(const BodyForce<dim> &acceleration, const TransferArrays<dim> &arrays, const double time) :
      acceleration(acceleration), uniform(acceleration.uniform_value(time)),
      is_uniform(!acceleration.depends_on_space()), time(time),
      place(acceleration.is_of_initial_position() ? arrays.initial_position : arrays.position)
    {
    }

    template <class Batch>
    [[gnu::always_inline]] dealii::Tensor<1, dim, typename Batch::Number> operator()(const Batch &batch) const
    {
      dealii::Tensor<1, dim, typename Batch::Number> b;
      for (unsigned int d = 0; d < dim; ++d)
        b[d] = uniform[d];
      if (!is_uniform)
        b = body_force(acceleration, load_vector<dim>(batch, place), time);
      return b;
    }

  private:
    const BodyForce<dim>            &acceleration;
    const dealii::Tensor<1, dim>     uniform;
    const bool                       is_uniform;
    const double                     time;
    const std::array<double *, dim> &place;
  };

  /** What a batch does with what it has gathered; returns the largest displacement along an axis [spacing]. */
  template <int dim, class Scheme, class Batch>
  [[gnu::always_inline]] inline typename Batch::Number advance(const Scheme &scheme, const TransferArrays<dim> &arrays,
                                                               const Batch                                 &batch,
                                                               const Gathered<dim, typename Batch::Number> &sum,
                                                               const double dt, const double *inverse_spacing)
  {
    const auto x = load_vector<dim>(batch, arrays.position);
    store_vector<dim>(batch, arrays.position, x + dt * sum.velocity); // Eq. (31), for FLIP as well
    store_matrix<dim>(batch, arrays.grad_v, sum.grad_v);
    scheme.update(arrays, batch, sum);
    typename Batch::Number displacement = 0.;
    for (unsigned int d = 0; d < dim; ++d)
      displacement = max(displacement, abs(sum.velocity[d]) * (dt * inverse_spacing[d]));
    return displacement;
  }
} // namespace Talus

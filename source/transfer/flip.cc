#include <talus/core/registry.h>
#include <talus/transfer/affine_transfer.h>

namespace Talus
{
  namespace
  {
    /** FLIP, Eq. (22): the velocity changes by the grid's acceleration. */
    template <int dim>
    struct Flip : SchemeDefaults<dim>
    {
      void update(WorkingSet<dim> &particles, const unsigned int p, const Gathered<dim> &sum) const
      {
        this->set_velocity(particles, p, particles.vector(particles.velocity, p) + sum.increment);
      }
    };

    /** PIC, Eq. (23): the velocity is that of the grid. */
    template <int dim>
    struct Pic : SchemeDefaults<dim>
    {
      void update(WorkingSet<dim> &particles, const unsigned int p, const Gathered<dim> &sum) const
      {
        this->set_velocity(particles, p, sum.velocity);
      }
    };

    /** Eq. (24): xi FLIP + (1 - xi) PIC. */
    template <int dim>
    struct Blend : SchemeDefaults<dim>
    {
      void add_parameters(dealii::ParameterAcceptor &object)
      {
        object.add_parameter("FLIP fraction", flip_fraction, "xi of Eq. (24): 1 is FLIP, 0 is PIC [1].", object.prm,
                             dealii::Patterns::Double(0, 1));
      }
      void update(WorkingSet<dim> &particles, const unsigned int p, const Gathered<dim> &sum) const
      {
        const auto flip = particles.vector(particles.velocity, p) + sum.increment;
        this->set_velocity(particles, p, flip_fraction * flip + (1 - flip_fraction) * sum.velocity);
      }

      double flip_fraction = 0.95;
    };

    template <int dim>
    using FlipTransfer = AffineTransfer<dim, Flip>;
    template <int dim>
    using PicTransfer = AffineTransfer<dim, Pic>;
    template <int dim>
    using BlendTransfer = AffineTransfer<dim, Blend>;

    const RegisterDimensions<Transfer, FlipTransfer>  flip("FLIP",
                                                           "velocity increments of the grid: little dissipation, noisy");
    const RegisterDimensions<Transfer, PicTransfer>   pic("PIC", "velocity of the grid: stable, very dissipative");
    const RegisterDimensions<Transfer, BlendTransfer> blend("blend", "weighted mean of FLIP and PIC");
  } // namespace
} // namespace Talus

#include <talus/core/registry.h>
#include <talus/transfer/flip.h>

namespace Talus
{
  namespace
  {
    /** PIC, Eq. (23): the velocity is that of the grid. */
    template <int dim>
    struct Pic : Scheme<dim>
    {
      template <class Batch>
      void update(const TransferArrays<dim> &arrays, const Batch &batch,
                  const Gathered<dim, typename Batch::Number> &sum) const
      {
        store_vector<dim>(batch, arrays.velocity, sum.velocity);
      }
    };

    /** Eq. (24): xi FLIP + (1 - xi) PIC. */
    template <int dim>
    struct Blend : Scheme<dim>
    {
      static constexpr bool gathers_increment = true;

      void add_parameters(dealii::ParameterAcceptor &object)
      {
        object.add_parameter("FLIP fraction", flip_fraction, "xi of Eq. (24): 1 is FLIP, 0 is PIC [1].", object.prm,
                             dealii::Patterns::Double(0, 1));
      }

      template <class Batch>
      void update(const TransferArrays<dim> &arrays, const Batch &batch,
                  const Gathered<dim, typename Batch::Number> &sum) const
      {
        const auto flip = load_vector<dim>(batch, arrays.velocity) + sum.increment;
        store_vector<dim>(batch, arrays.velocity, flip_fraction * flip + (1 - flip_fraction) * sum.velocity);
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

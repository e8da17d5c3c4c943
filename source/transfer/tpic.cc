#include <talus/core/registry.h>
#include <talus/transfer/affine_transfer.h>

namespace Talus
{
  namespace
  {
    /** Taylor PIC, Eq. (19): the affine field is the first-order Taylor series, C = grad v. */
    template <int dim>
    struct Tpic : Scheme<dim>
    {
      static constexpr bool is_affine = true;

      static constexpr std::array<double, 2> stiffness_factors = {{0.25, 0.}};

      template <class Batch, class Moment>
      auto affine(const TransferArrays<dim> &arrays, const Batch &batch, const Moment &, const double) const
      {
        return load_matrix<dim>(batch, arrays.grad_v);
      }

      template <class Batch>
      void update(const TransferArrays<dim> &arrays, const Batch &batch,
                  const Gathered<dim, typename Batch::Number> &sum) const
      {
        store_vector<dim>(batch, arrays.velocity, sum.velocity);
      }
    };

    template <int dim>
    using TpicTransfer = AffineTransfer<dim, Tpic>;

    const RegisterDimensions<Transfer, TpicTransfer> registration("TPIC", "Taylor PIC: keeps the velocity gradient");
  } // namespace
} // namespace Talus

#include <talus/core/registry.h>
#include <talus/transfer/affine_transfer.h>

namespace Talus
{
  namespace
  {
    /** Taylor PIC, Eq. (19): the affine field is the first-order Taylor series, C = grad v. */
    template <int dim>
    struct Tpic : SchemeDefaults<dim>
    {
      static constexpr bool is_affine = true;

      dealii::Tensor<2, dim> affine(const WorkingSet<dim> &particles, const unsigned int p, const Stencil<dim> &) const
      {
        return particles.matrix(particles.grad_v, p);
      }
      void update(WorkingSet<dim> &particles, const unsigned int p, const Gathered<dim> &sum) const
      {
        this->set_velocity(particles, p, sum.velocity);
      }
    };

    template <int dim>
    using TpicTransfer = AffineTransfer<dim, Tpic>;

    const RegisterDimensions<Transfer, TpicTransfer> registration("TPIC", "Taylor PIC: keeps the velocity gradient");
  } // namespace
} // namespace Talus

#include <talus/core/registry.h>
#include <talus/transfer/affine_transfer.h>

#include <deal.II/base/symmetric_tensor.h>

#include <cmath>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    /**
     * Affine PIC, Eqs. (17)-(18), (25): stores B and forms C = B D^{-1} with the
     * weights of the step that scatters, which is what conserves angular momentum.
     */
    template <int dim>
    struct Apic : SchemeDefaults<dim>
    {
      static constexpr bool is_affine = true;
      static constexpr bool gathers_B = true;

      void add_fields(WorkingSet<dim> &particles) { B = particles.add_field("affine moment", dim * dim); }

      /** B = grad v D: the scatter of the first step then carries the initial velocity gradient. */
      void initialize(WorkingSet<dim> &particles, const unsigned int p, const Stencil<dim> &stencil) const
      {
        const Tensor<2, dim> grad_v = particles.matrix(particles.grad_v, p);
        store(particles, p, grad_v * Tensor<2, dim>(second_moment(stencil)));
      }

      Tensor<2, dim> affine(const WorkingSet<dim> &particles, const unsigned int p, const Stencil<dim> &stencil) const
      {
        const SymmetricTensor<2, dim> D = second_moment(stencil);
        const Tensor<2, dim>          B = affine_moment(particles, p);

        double h_squared = 0;
        for (unsigned int d = 0; d < dim; ++d)
          for (unsigned int k = 0; k < stencil.size; ++k)
            h_squared = std::max(h_squared, stencil.offset[d][k] * stencil.offset[d][k]);
        const double smallest = 1e-12 * h_squared;
        // det / trace^(dim-1) is a lower bound of the smallest eigenvalue of a positive definite D.
        const double det = determinant(D), tr = trace(D);
        bool         is_positive = tr > 0 && det > smallest * std::pow(tr, dim - 1);
        for (unsigned int d = 0; d < dim; ++d)
          is_positive = is_positive && D[d][d] > 0;
        if (is_positive && second_invariant(D) > 0)
          return B * Tensor<2, dim>(invert(D));

        // A direction in which all nodes lie in the particle's plane, at a wall, takes C = grad v.
        const Tensor<2, dim> grad_v = particles.matrix(particles.grad_v, p);
        Tensor<2, dim>       C;
        for (const auto &[eigenvalue, e] : eigenvectors(D))
          C += outer_product(eigenvalue < smallest ? grad_v * e : B * e / eigenvalue, e);
        return C;
      }

      void update(WorkingSet<dim> &particles, const unsigned int p, const Gathered<dim> &sum) const
      {
        this->set_velocity(particles, p, sum.velocity);
        store(particles, p, sum.B);
      }

      Tensor<2, dim> affine_moment(const WorkingSet<dim> &particles, const unsigned int p) const
      {
        return particles.matrix(B, p);
      }

    private:
      /** D, Eq. (18). */
      static SymmetricTensor<2, dim> second_moment(const Stencil<dim> &stencil)
      {
        SymmetricTensor<2, dim> D;
        for (unsigned int d = 0; d < dim; ++d)
          for (unsigned int e = 0; e <= d; ++e)
            for (unsigned int k = 0; k < stencil.size; ++k)
              D[d][e] += stencil.weight[k] * stencil.offset[d][k] * stencil.offset[e][k];
        return D;
      }

      /** Sum of the products of two eigenvalues; in 2D the determinant. Negative for some indefinite D. */
      static double second_invariant(const SymmetricTensor<2, dim> &D)
      {
        const double tr = trace(D);
        return 0.5 * (tr * tr - D * D);
      }

      void store(WorkingSet<dim> &particles, const unsigned int p, const Tensor<2, dim> &value) const
      {
        for (unsigned int c = 0; c < dim * dim; ++c)
          particles.component(B, c)[p] = value[c / dim][c % dim];
      }

      unsigned int B = 0;
    };

    template <int dim>
    using ApicTransfer = AffineTransfer<dim, Apic>;

    const RegisterDimensions<Transfer, ApicTransfer> registration("APIC", "affine PIC: conserves angular momentum");
  } // namespace
} // namespace Talus

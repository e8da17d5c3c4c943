#include <talus/core/eigen.h>
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
     * B D^{-1} of one particle. D has a direction of zero length where all nodes lie
     * in the particle's plane, at a wall: it takes C = grad v.
     */
    template <int dim>
    Tensor<2, dim> divide(const Tensor<2, dim> &B, const SymmetricTensor<2, dim> &D, const Tensor<2, dim> &grad_v,
                          const double smallest)
    {
      if (D.norm() < smallest)
        return grad_v;
      Tensor<2, dim> C;
      const auto     system = eigen_system<dim>(D);
      for (unsigned int a = 0; a < dim; ++a)
      {
        Tensor<1, dim> e;
        for (unsigned int d = 0; d < dim; ++d)
          e[d] = system.vector[d][a];
        C += outer_product(system.value[a] < smallest ? grad_v * e : B * e / system.value[a], e);
      }
      return C;
    }

    /**
     * Affine PIC, Eqs. (17)-(18), (25): stores B and forms C = B D^{-1} with the
     * weights of the step that scatters, which is what conserves angular momentum.
     */
    template <int dim>
    struct Apic : Scheme<dim>
    {
      static constexpr bool is_affine = true;
      static constexpr bool needs_D   = true;
      static constexpr bool gathers_B = true;

      static constexpr std::array<double, 2> stiffness_factors = {{0.5, -0.25}};

      void add_fields(WorkingSet<dim> &particles) { B = particles.add_field("affine moment", dim * dim); }
      void bind(WorkingSet<dim> &particles, TransferArrays<dim> &arrays) const
      {
        arrays.B = particles.template components<dim * dim>(B);
      }

      /** B = grad v D: the scatter of the first step then carries the initial velocity gradient. */
      void initialize(const TransferArrays<dim> &arrays, const SingleBatch &one, const SymmetricTensor<2, dim> &D) const
      {
        store_matrix<dim>(one, arrays.B, load_matrix<dim>(one, arrays.grad_v) * Tensor<2, dim>(D));
      }

      template <class Batch, typename Number = typename Batch::Number>
      Tensor<2, dim, Number> affine(const TransferArrays<dim> &arrays, const Batch &batch,
                                    const SymmetricTensor<2, dim, Number> &D, const double h) const
      {
        const double smallest = 1e-12 * h * h;
        const auto   moment   = load_matrix<dim>(batch, arrays.B);
        const Number det = determinant(D), tr = trace(D);
        // det / trace^(dim - 1) is a lower bound of the smallest eigenvalue of a positive definite D.
        Number bound = smallest;
        for (unsigned int d = 1; d < dim; ++d)
          bound *= tr;
        auto is_regular = det > bound;
        for (unsigned int d = 0; d < dim; ++d)
          is_regular = is_regular & (D[d][d] > Number(0.));
        is_regular = is_regular & (tr * tr > D * D); // the sum of the products of two eigenvalues is positive

        auto C = moment * Tensor<2, dim, Number>(adjugate(D)) / det;
        if (any(!is_regular))
        {
          const auto grad_v = load_matrix<dim>(batch, arrays.grad_v);
          for (unsigned int l = 0; l < batch.size(); ++l)
            if (!lane(is_regular, l))
            {
              SymmetricTensor<2, dim> D_p;
              for (unsigned int c = 0; c < D_p.n_independent_components; ++c)
                D_p.access_raw_entry(c) = lane(D.access_raw_entry(c), l);
              const auto C_p = divide(lane(moment, l), D_p, lane(grad_v, l), smallest);
              for (unsigned int c = 0; c < dim * dim; ++c)
                set_lane(C[c / dim][c % dim], l, C_p[c / dim][c % dim]);
            }
        }
        return C;
      }

      /** The same where D is diagonal; its numbers may be the same for the whole batch. */
      template <class Batch, typename Number>
      [[gnu::always_inline]] auto affine(const TransferArrays<dim> &arrays, const Batch &batch,
                                         const Tensor<1, dim, Number> &D, const double h) const
      {
        const Number smallest = 1e-12 * h * h;
        auto         C        = load_matrix<dim>(batch, arrays.B);
        for (unsigned int e = 0; e < dim; ++e)
        {
          const auto   is_regular = D[e] > smallest;
          const Number inverse    = 1. / select(is_regular, D[e], Number(1.));
          for (unsigned int d = 0; d < dim; ++d)
            C[d][e] *= inverse;
          if (any(!is_regular))
            for (unsigned int d = 0; d < dim; ++d)
              C[d][e] = select(is_regular, C[d][e], batch.load(arrays.grad_v[d * dim + e]));
        }
        return C;
      }

      template <class Batch>
      void update(const TransferArrays<dim> &arrays, const Batch &batch,
                  const Gathered<dim, typename Batch::Number> &sum) const
      {
        store_vector<dim>(batch, arrays.velocity, sum.velocity);
        store_matrix<dim>(batch, arrays.B, sum.B);
      }

      Tensor<2, dim> affine_moment(const WorkingSet<dim> &particles, const unsigned int p) const
      {
        return particles.matrix(B, p);
      }

    private:
      /** D^{-1} det D. */
      template <typename Number>
      static SymmetricTensor<2, dim, Number> adjugate(const SymmetricTensor<2, dim, Number> &D)
      {
        SymmetricTensor<2, dim, Number> result;
        if constexpr (dim == 2)
        {
          result[0][0] = D[1][1];
          result[1][1] = D[0][0];
          result[0][1] = -D[0][1];
        }
        else
          for (unsigned int i = 0; i < 3; ++i)
          {
            const unsigned int j = (i + 1) % 3, k = (i + 2) % 3;
            result[i][i] = D[j][j] * D[k][k] - D[j][k] * D[j][k];
            result[i][j] = D[i][k] * D[k][j] - D[i][j] * D[k][k];
          }
        return result;
      }

      unsigned int B = 0;
    };

    template <int dim>
    using ApicTransfer = AffineTransfer<dim, Apic>;

    const RegisterDimensions<Transfer, ApicTransfer> registration("APIC", "affine PIC: conserves angular momentum");
  } // namespace
} // namespace Talus

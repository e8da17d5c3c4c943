#pragma once

#include <talus/grid/lattice.h>
#include <talus/particles/batch_access.h>
#include <talus/particles/working_set.h>

namespace Talus
{
  /**
   * The domains of particles as parallelograms or parallelepipeds: half edges r_e = F r0_e, corners
   * x_p +- r_1 +- r_2 (+- r_3). Corner c has the sign of bit e of c along r_e: minus where it is 0.
   */
  template <int dim>
  class Corners
  {
  public:
    using Number = Simd<native_width>;
    using Vector = dealii::Tensor<1, dim, Number>;
    using Matrix = dealii::Tensor<2, dim, Number>;

    static constexpr unsigned int n = 1u << dim;

    /** The field of r0: its component dim e + d is the d-th coordinate of half edge e [length]. */
    static unsigned int add_field(WorkingSet<dim> &particles) { return particles.add_half_edges(); }

    Corners(const WorkingSet<dim> &particles, const unsigned int field) :
      x(particles.template components<dim>(particles.position)),
      F(particles.template components<dim * dim>(particles.F)), r0(particles.template components<dim * dim>(field))
    {
    }

    /** The half edges of the particles of a batch, one in each row. */
    template <class Batch>
    Matrix half_edges(const Batch &batch) const
    {
      return load_matrix<dim>(batch, r0) * transpose(load_matrix<dim>(batch, F));
    }

    /** Corner c, from the particle's position. */
    static Vector arm(const Matrix &half_edges, const unsigned int c)
    {
      Vector arm;
      for (unsigned int e = 0; e < dim; ++e)
        arm += (c >> e & 1 ? 1. : -1.) * half_edges[e];
      return arm;
    }

    template <class Batch>
    Vector position(const Batch &batch) const
    {
      return load_vector<dim>(batch, x);
    }

    /**
     * Lattice coordinates of a point; what lies beyond a face of the domain by round-off is put on it, and what lies
     * farther out as well: that nothing does has been seen to before.
     */
    static Vector coordinates(const Lattice<dim> &lattice, const Vector &point)
    {
      Vector result;
      for (unsigned int d = 0; d < dim; ++d)
        result[d] =
          min(max((point[d] - lattice.origin[d]) * lattice.inverse_h[d], Number(0.)), Number(1. * lattice.n_cells[d]));
      return result;
    }

    /** Calls `body(p, index)` for all corners of the particles begin .. end - 1: floor(lattice coordinates - shift). */
    template <class Body>
    void for_each(const Lattice<dim> &lattice, const double shift, const unsigned int begin, const unsigned int end,
                  const Body &body) const
    {
      for_each_batch(begin, end, [&](const auto batch) {
        const auto r = half_edges(batch);
        for (unsigned int c = 0; c < n; ++c)
        {
          const auto coordinate = coordinates(lattice, position(batch) + arm(r, c));
          for (unsigned int l = 0; l < batch.size(); ++l)
          {
            typename Lattice<dim>::Index index;
            for (unsigned int d = 0; d < dim; ++d)
              index[d] = static_cast<int>(std::floor(coordinate[d][l] - shift));
            body(batch.p + l, index);
          }
        }
      });
    }

  private:
    std::array<const double *, dim>       x;
    std::array<const double *, dim * dim> F, r0;
  };
} // namespace Talus

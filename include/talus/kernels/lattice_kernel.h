#pragma once

#include <talus/core/exceptions.h>
#include <talus/kernels/kernel.h>

#include <cmath>

namespace Talus
{
  /**
   * A kernel that is a product over the axes of one function of the distance,
   * Eq. (52). `Function` gives
   * - n: how many nodes per axis can have non-zero weight,
   * - shift: the first of them is floor(lattice coordinate - shift),
   * - support(): beyond this distance the function is zero [h],
   * - evaluate(s, weight, derivative): values at the n nodes of a particle at
   *   distance s from the first [h], and derivatives in s [1/h],
   * - boundary_scale: Steffen's factor, 0 where there is none.
   */
  template <int dim, class Function>
  class LatticeKernel : public Kernel<dim>
  {
  public:
    explicit LatticeKernel(const std::string &section) : Kernel<dim>(section) { function.add_parameters(*this); }

    void attach(const Lattice<dim> &lattice, std::unique_ptr<Treatment<dim>> treatment) override
    {
      if (treatment->needs_boundary_scale() && Function::boundary_scale == 0)
        throw EntryError(this->get_section_name(), "Boundary treatment",
                         "this treatment is defined for linear kernels and B-splines only. Use 'none' or 'WLS'.");
      Kernel<dim>::attach(lattice, std::move(treatment));
    }

    void evaluate(const WorkingSet<dim> &particles, const unsigned int begin, const unsigned int end,
                  Stencil<dim> *stencils) const override
    {
      const auto x = particles.template components<dim>(particles.position);
      for (unsigned int p = begin; p < end; ++p)
      {
        Stencil<dim>                &stencil = stencils[p - begin];
        typename Lattice<dim>::Index base;
        std::array<Axis, dim>        axes;
        bool                         is_truncated = false, is_at_boundary = false;
        for (unsigned int d = 0; d < dim; ++d)
        {
          base[d] = evaluate_axis(x[d][p], d, axes[d]);
          is_at_boundary |= axes[d].has_lower_boundary || axes[d].has_upper_boundary;
          stencil.is_at_slip_wall[d] = false;
        }
        if (is_at_boundary)
        {
          const unsigned int slip = this->lattice->slip_faces[this->lattice->table_index(base)];
          for (unsigned int d = 0; d < dim; ++d)
          {
            meet_slip_walls(slip >> 2 * d & 1, slip >> (2 * d + 1) & 1, axes[d], stencil.is_at_slip_wall[d]);
            is_truncated |= axes[d].is_truncated;
          }
          this->treatment->correct_axes(axes);
          multiply<false>(axes, base, stencil);
        }
        else
          multiply<true>(axes, base, stencil);
        // Two nodes per axis leave least squares no choice: it would return the kernel itself, or 0/0 at a node.
        if (is_truncated || (Function::n > 2 && this->treatment->is_everywhere()))
          this->treatment->correct_stencil(stencil, this->lattice->inverse_h);
      }
    }

    unsigned int n_nodes() const override { return Function::n; }
    double       shift() const override { return Function::shift; }

    std::optional<LatticeFunction> lattice_function() const override { return function; }

  private:
    /** Fills the factors of axis `d` and returns the lattice index of the stencil's first node. */
    int evaluate_axis(const double x, const unsigned int d, Axis &axis) const
    {
      const double coordinate = this->lattice->coordinate(x, d);
      const int    base       = static_cast<int>(std::floor(coordinate - Function::shift));
      const double s          = coordinate - base;
      const int    last       = this->lattice->n_cells[d];
      function.evaluate(s, axis.weight, axis.derivative);
      for (unsigned int k = 0; k < Function::n; ++k)
      {
        axis.derivative[k] *= this->lattice->inverse_h[d];
        axis.offset[k] = (k - s) * this->lattice->h[d];
      }
      axis.begin              = std::max(0, -base);
      axis.end                = std::min<int>(Function::n, last + 1 - base);
      axis.has_lower_boundary = base <= 0;
      axis.has_upper_boundary = base + static_cast<int>(Function::n) > last;
      axis.boundary_scale     = Function::boundary_scale;

      axis.misses_lower = axis.misses_upper = false;
      if (axis.has_lower_boundary || axis.has_upper_boundary)
      {
        // Round-off must not make a node at the very end of the support count as missing.
        const double reach = function.support() - 1e-12;
        axis.misses_lower  = coordinate + 1 < reach;
        axis.misses_upper  = last + 1 - coordinate < reach;
      }
      axis.is_truncated = axis.misses_lower || axis.misses_upper;
      return base;
    }

    /** Lets an axis go on beyond slip walls where the treatment mirrors it. */
    void meet_slip_walls(const bool lower, const bool upper, Axis &axis, bool &is_at_slip_wall) const
    {
      is_at_slip_wall = (axis.misses_lower && lower) || (axis.misses_upper && upper);
      if (!this->treatment->is_mirror())
        return;
      if (lower)
        axis.begin = 0;
      if (upper)
        axis.end = Function::n;
      axis.is_truncated = (axis.misses_lower && !lower) || (axis.misses_upper && !upper);
    }

    /** The product over the axes; a complete stencil has loops of fixed length. */
    template <bool is_complete>
    void multiply(const std::array<Axis, dim> &axes, const typename Lattice<dim>::Index &base,
                  Stencil<dim> &stencil) const
    {
      const auto begin = [&](const unsigned int d) { return is_complete ? 0u : axes[d].begin; };
      const auto end   = [&](const unsigned int d) { return is_complete ? Function::n : axes[d].end; };

      const Axis  &x = axes[0], &y = axes[1], &z = axes[dim - 1];
      const auto  *nodes  = this->lattice->node.data() + this->lattice->table_index(base);
      const auto  &stride = this->lattice->stride;
      unsigned int i      = 0;
      for (unsigned int c = (dim == 3 ? begin(dim - 1) : 0); c < (dim == 3 ? end(dim - 1) : 1); ++c)
        for (unsigned int b = begin(1); b < end(1); ++b)
        {
          const double wz    = dim == 3 ? z.weight[c] : 1.;
          const double wyz   = y.weight[b] * wz;
          const double dy_wz = y.derivative[b] * wz;
          const double wy_dz = dim == 3 ? y.weight[b] * z.derivative[c] : 0.;
          const auto  *row   = nodes + b * stride[1] + (dim == 3 ? c * stride[dim - 1] : 0);
          for (unsigned int a = begin(0); a < end(0); ++a)
          {
            stencil.node[i]   = row[a];
            stencil.beyond[i] = 0;
            if (!is_complete && row[a] == Lattice<dim>::missing)
            {
              const auto place = row + a - this->lattice->node.data();
              if (this->lattice->image[place] == Lattice<dim>::missing)
                continue; // at the very end of the support
              stencil.node[i]   = this->lattice->node[this->lattice->image[place]];
              stencil.beyond[i] = this->lattice->beyond[place];
            }
            stencil.weight[i]      = x.weight[a] * wyz;
            stencil.gradient[0][i] = x.derivative[a] * wyz;
            stencil.gradient[1][i] = x.weight[a] * dy_wz;
            stencil.offset[0][i]   = x.offset[a];
            stencil.offset[1][i]   = y.offset[b];
            if constexpr (dim == 3)
            {
              stencil.gradient[2][i] = x.weight[a] * wy_dz;
              stencil.offset[2][i]   = z.offset[c];
            }
            ++i;
          }
        }
      stencil.size = i;
    }

    Function function;
  };
} // namespace Talus

#pragma once

#include <talus/grid/grid.h>
#include <talus/grid/lattice.h>
#include <talus/kernels/lattice/functions.h>
#include <talus/transfer/lattice/imls_basis.h>

#include <talus/core/simd.h>

namespace Talus
{
  /**
   * Improved moving least squares on the nodes of a lattice, Tran et al. (2019): each node fits its data, values of a
   * vector at points within two spacings of it along each axis, weighted by cubic B-splines, and takes the fit's value.
   * See ImlsBasis for what the data do not determine. Near faces of the domain the fit is one-sided. A node's sums
   * stand side by side; a datum adds the same registers, made of factors of one axis each, to its 4^dim nodes.
   */
  template <int dim, unsigned int order>
  class Imls
  {
    using Basis = ImlsBasis<dim, order>;

  public:
    static constexpr unsigned int n_numbers   = Basis::n_moments + dim * Basis::n;
    static constexpr unsigned int n_registers = (n_numbers + 7) / 8;
    using Array                               = NodalArray<8 * n_registers>;

    Imls()
    {
      // Exponents of what a lane sums, and whether it is a moment or belongs to a component of the right-hand side.
      for (unsigned int lane = 0; lane < 8 * n_registers; ++lane)
      {
        const bool         is_moment = lane < Basis::n_moments;
        const unsigned int rest      = lane - Basis::n_moments;
        const bool         is_used   = lane < n_numbers;
        for (unsigned int d = 0; d < dim; ++d)
          exponent[d][lane] = is_used ? 1. * Basis::monomials[is_moment ? lane : rest / dim][d] : 0.;
        component[lane] = is_used && !is_moment ? rest % dim : (is_used ? dim : dim + 1);
      }
    }

    /** Starts afresh. */
    void clear(const Grid<dim> &grid)
    {
      if (sums.is_empty())
        sums.reinit(grid.nodes);
      sums.clear(grid.active_nodes);
    }

    /** Adds the datum `value` at the point with these lattice coordinates. */
    void add(const Lattice<dim> &lattice, const double *coordinate, const dealii::Tensor<1, dim> &value)
    {
      constexpr int n = CubicBSpline::n;
      int           first[dim], begin[dim], end[dim];
      Register      factor[dim][n][n_registers];
      int           place = 0;
      for (unsigned int d = 0; d < dim; ++d)
      {
        const double base = std::floor(coordinate[d] - CubicBSpline::shift), s = coordinate[d] - base;
        first[d] = static_cast<int>(base);
        begin[d] = std::max(0, -first[d]);
        end[d]   = std::min(n, lattice.n_cells[d] + 1 - first[d]);
        place += (first[d] - lattice.first[d]) * lattice.stride[d];
        double weight[n], derivative[n];
        CubicBSpline().evaluate(s, weight, derivative);
        for (int k = begin[d]; k < end[d]; ++k)
          for (unsigned int r = 0; r < n_registers; ++r)
            factor[d][k][r] = power(s - k, weight[k], exponent[d] + 8 * r);
      }
      alignas(64) double of_lane[8 * n_registers];
      double             values[dim + 2];
      for (unsigned int d = 0; d < dim; ++d)
        values[d] = value[d];
      values[dim]     = 1;
      values[dim + 1] = 0;
      for (unsigned int lane = 0; lane < 8 * n_registers; ++lane)
        of_lane[lane] = values[component[lane]];

      for (int c = dim == 3 ? begin[dim - 1] : 0; c < (dim == 3 ? end[dim - 1] : 1); ++c)
        for (int b = begin[1]; b < end[1]; ++b)
        {
          Register across[n_registers];
          for (unsigned int r = 0; r < n_registers; ++r)
          {
            across[r] = Register::load(of_lane + 8 * r) * factor[1][b][r];
            if constexpr (dim == 3)
              across[r] *= factor[dim - 1][c][r];
          }
          const int row = place + b * lattice.stride[1] + (dim == 3 ? c * lattice.stride[dim - 1] : 0);
          for (int a = begin[0]; a < end[0]; ++a)
          {
            double *node = sums.at_place(row + a);
            for (unsigned int r = 0; r < n_registers; ++r)
              (Register::load(node + 8 * r) + across[r] * factor[0][a][r]).store(node + 8 * r);
          }
        }
    }

    /** The sums, for those who add to them in another way. */
    Array &numbers() { return sums; }

    /** Brings the sums to the nodes' owners. Collective. */
    void collect() { sums.add_copies_to_owners(); }

    /** The fit at an owned node; zero without data. */
    dealii::Tensor<1, dim> value(const unsigned int node) const
    {
      const double          *numbers = sums[node];
      dealii::Tensor<1, dim> result;
      if (!(numbers[0] > 0))
        return result;
      const auto c = Basis::value_weights(numbers);
      for (unsigned int j = 0; j < Basis::n; ++j)
        for (unsigned int d = 0; d < dim; ++d)
          result[d] += c[j] * numbers[Basis::n_moments + dim * j + d];
      return result;
    }

  private:
    using Register = Simd<8>;

    /** w z^e in each lane, e up to 2 order. */
    static Register power(const double z, const double w, const double *exponent)
    {
      const Register e      = Register::load(exponent);
      Register       result = w;
      for (unsigned int k = 0; k < 2 * order; ++k)
        result *= select(e > Register(1. * k), Register(z), Register(1.));
      return result;
    }

    Array sums;
    alignas(64) double exponent[dim][8 * n_registers];
    unsigned int component[8 * n_registers]; // of the value; dim: 1, dim + 1: 0
  };
} // namespace Talus

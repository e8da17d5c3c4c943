#pragma once

#include <talus/core/transpose.h>
#include <talus/transfer/lattice/imls.h>

namespace Talus
{
  /**
   * What the domains of a batch of particles add to the sums of Imls for linear functions, one particle in each lane:
   * data at n_points points of each, with the values of an affine field. Moments of the points about a node come first,
   * a product of factors of one axis each; with v_q = A + H z_q, z_q = x_q - x_i, the right-hand sides follow from
   * them,
   * @f[ R_0 = A S_0 + \sum_b H_b S_b , \qquad R_a = A S_a + \sum_b H_b S_{ab} . @f]
   * The same sums as Imls::add() of all data, in a third of the time. Domains that lie together, as those of the
   * particles of one cell, share one box of nodes, and are summed before they are stored.
   */
  template <int dim, unsigned int n_points>
  class ImlsDomains
  {
  public:
    using Number = Simd<native_width>;
    using Vector = dealii::Tensor<1, dim, Number>;
    using Matrix = dealii::Tensor<2, dim, Number>;

    Vector point[n_points]; // lattice coordinates
    Vector value;           // of the field at the first point
    Matrix gradient;        // H: derivatives along the lattice coordinates

    /** Of the first `size` lanes. False for domains that reach too far: theirs are added point by point. */
    bool find(const Lattice<dim> &lattice, const unsigned int size)
    {
      Vector lowest, highest;
      this->size = size;
      for (unsigned int d = 0; d < dim; ++d)
      {
        lowest[d] = highest[d] = point[0][d];
        for (unsigned int q = 1; q < n_points; ++q)
        {
          lowest[d]  = min(lowest[d], point[q][d]);
          highest[d] = max(highest[d], point[q][d]);
        }
        first[d]          = floor(lowest[d]) - 1.;
        const Number size = floor(highest[d]) + 3. - first[d];
        n[d]              = static_cast<int>(*std::max_element(size.data(), size.data() + native_width));
        if (n[d] > max_n)
          return false;
      }
      find_common_box(highest);
      alignas(64) int index[dim][native_width];
      for (unsigned int d = 0; d < dim; ++d)
        store_integers(first[d], index[d]);
      for (unsigned int l = 0; l < native_width; ++l)
      {
        place[l] = 0;
        for (unsigned int d = 0; d < dim; ++d)
          place[l] += (index[d][l] - lattice.first[d]) * lattice.stride[d];
      }
      Number is_used = 0.;
      for (unsigned int l = 0; l < size; ++l)
        is_used.set(l, 1.);
      for (unsigned int q = 0; q < n_points; ++q)
        for (unsigned int d = 0; d < dim; ++d)
          for (int k = 0; k < n[d]; ++k)
          {
            const Number z = point[q][d] - first[d] - 1. * k, r = abs(z), far = max(2. - r, Number(0.));
            Number      *f = factor[d][k][q];
            f[0]           = select(r < Number(1.), 2. / 3. + r * r * (0.5 * r - 1.), far * far * far * (1. / 6.));
            if (d == 0)
              f[0] *= is_used;
            f[1] = f[0] * z;
            f[2] = f[1] * z;
          }
      return true;
    }

    /** Adds the sums to the nodes. */
    template <class Array>
    void add(const Lattice<dim> &lattice, Array &sums) const
    {
      for (int c = 0; c < (dim == 3 ? n[dim - 1] : 1); ++c)
        for (int b = 0; b < n[1]; ++b)
        {
          Number across[n_points][n_across];
          for (unsigned int q = 0; q < n_points; ++q)
            multiply(factor[1][b][q], factor[dim - 1][c][q], across[q]);
          int a = 0;
          for (; a + together <= n[0]; a += together)
            add_nodes<together>({{a, b, c}}, across, lattice, sums);
          for (; a < n[0]; ++a)
            add_nodes<1>({{a, b, c}}, across, lattice, sums);
        }
    }

  private:
    /** One box for all, if it is not much larger than those of the lanes. */
    void find_common_box(const Vector &highest)
    {
      int      common[dim];
      Vector   lower;
      unsigned n_common = 1, n_apart = 1;
      for (unsigned int d = 0; d < dim; ++d)
      {
        const double least = *std::min_element(first[d].data(), first[d].data() + size),
                     most  = *std::max_element(highest[d].data(), highest[d].data() + size);
        common[d]          = static_cast<int>(std::floor(most) + 3 - least);
        lower[d]           = least;
        n_common *= std::min(common[d], 2 * max_n);
        n_apart *= n[d];
      }
      has_common_box = 3 * n_common <= 4 * n_apart && *std::max_element(common, common + dim) <= max_n;
      if (!has_common_box)
        return;
      first = lower;
      std::copy_n(common, dim, n);
    }

    static constexpr int max_n = 8;
    // Two nodes at a time keep more sums going than one, which waits for its own; but the sums must fit into registers.
    static constexpr int          together    = dim == 2 || native_width == 8 ? 2 : 1;
    static constexpr unsigned int n_across    = dim == 2 ? 3 : 6;
    static constexpr unsigned int n_moments   = ImlsBasis<dim, 1>::n_moments;
    static constexpr unsigned int n_registers = Imls<dim, 1>::n_registers;

    /** Weights of the axes but the first times 1, y, (z,) y^2, (y z, z^2). */
    static void multiply(const Number *y, [[maybe_unused]] const Number *z, Number *across)
    {
      if constexpr (dim == 2)
        std::copy_n(y, 3, across);
      else
      {
        across[0] = y[0] * z[0];
        across[1] = y[1] * z[0];
        across[2] = y[0] * z[1];
        across[3] = y[2] * z[0];
        across[4] = y[1] * z[1];
        across[5] = y[0] * z[2];
      }
    }

    using Numbers = Number[8 * n_registers]; // of a node: the moments, and the right-hand sides

    /** Moments of nodes a, a + 1, .. in the order of ImlsBasis: 1; x, y(, z); x^2, xy(, xz), y^2(, yz, z^2). */
    template <int count>
    void moments(const int a, const Number (&across)[n_points][n_across], Numbers (&result)[count]) const
    {
      Number S[count][n_moments]; // in registers
      for (int i = 0; i < count; ++i)
        for (unsigned int m = 0; m < n_moments; ++m)
          S[i][m] = 0.;
      for (unsigned int q = 0; q < n_points; ++q)
        for (int i = 0; i < count; ++i)
        {
          const Number *x = factor[0][a + i][q], *w = across[q];
          S[i][0] += x[0] * w[0];
          S[i][1] += x[1] * w[0];
          for (unsigned int d = 1; d < dim; ++d)
            S[i][1 + d] += x[0] * w[d];
          S[i][1 + dim] += x[2] * w[0];
          for (unsigned int d = 1; d < dim; ++d)
            S[i][1 + dim + d] += x[1] * w[d];
          for (unsigned int k = dim; k < n_across; ++k)
            S[i][1 + dim + k] += x[0] * w[k];
        }
      for (int i = 0; i < count; ++i)
        std::copy_n(S[i], n_moments, result[i]);
    }

    template <int count, class Array>
    void add_nodes(const std::array<int, 3> &k, const Number (&across)[n_points][n_across], const Lattice<dim> &lattice,
                   Array &sums) const
    {
      Numbers numbers[count];
      moments<count>(k[0], across, numbers);
      for (int i = 0; i < count; ++i)
      {
        set_right_hand_sides({{k[0] + i, k[1], k[2]}}, numbers[i]);
        store({{k[0] + i, k[1], k[2]}}, numbers[i], lattice, sums);
      }
    }

    [[gnu::always_inline]] void set_right_hand_sides(const std::array<int, 3> &k, Numbers &numbers) const
    {
      Vector A = value;
      for (unsigned int a = 0; a < dim; ++a)
      {
        const Number o = first[a] + 1. * k[a] - point[0][a];
        for (unsigned int d = 0; d < dim; ++d)
          A[d] += gradient[d][a] * o;
      }
      for (unsigned int j = 0; j <= dim; ++j)
        for (unsigned int d = 0; d < dim; ++d)
        {
          Number R = A[d] * numbers[j];
          for (unsigned int a = 0; a < dim; ++a)
            R += gradient[d][a] * numbers[ImlsBasis<dim, 1>::products[j][1 + a]];
          numbers[n_moments + dim * j + d] = R;
        }
      for (unsigned int i = n_moments + dim * (dim + 1); i < 8 * n_registers; ++i)
        numbers[i] = 0.;
    }

    template <class Array>
    [[gnu::always_inline]] void store(const std::array<int, 3> &k, const Numbers &numbers, const Lattice<dim> &lattice,
                                      Array &sums) const
    {
      int step = k[0] + k[1] * lattice.stride[1];
      if constexpr (dim == 3)
        step += k[2] * lattice.stride[2];
      if (has_common_box)
      {
        // Those beyond the domain do not exist.
        if (lattice.node[place[0] + step] == Lattice<dim>::missing)
          return;
        double *node = sums.at_place(place[0] + step);
        for (unsigned int r = 0; r < n_registers; ++r)
        {
          const auto added = sums_of_lanes<native_width>(reinterpret_cast<const Number(&)[8]>(numbers[8 * r]));
          (Simd<8>::load(node + 8 * r) + added).store(node + 8 * r);
        }
        return;
      }
      Simd<8> vectors[n_registers][native_width];
      for (unsigned int r = 0; r < n_registers; ++r)
        lanes_to_vectors<native_width>(reinterpret_cast<const Number(&)[8]>(numbers[8 * r]), vectors[r]);
      for (unsigned int l = 0; l < size; ++l)
      {
        // Nodes that no datum reaches may lie anywhere.
        if (!(numbers[0].data()[l] > 0) || lattice.node[place[l] + step] == Lattice<dim>::missing)
          continue;
        double *node = sums.at_place(place[l] + step);
        for (unsigned int r = 0; r < n_registers; ++r)
          (Simd<8>::load(node + 8 * r) + vectors[r][l]).store(node + 8 * r);
      }
    }

    unsigned int size           = 0;
    bool         has_common_box = false;

    Vector first; // lattice index of the first node
    int    n[dim];
    int    place[native_width];
    Number factor[dim][max_n][n_points][3];
  };
} // namespace Talus

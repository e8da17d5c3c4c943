#pragma once

#include <talus/core/transpose.h>
#include <talus/grid/simplex.h>

#include <array>

namespace Talus
{
  /** Particles whose moments are inverted together, one in each lane; and nodes in a register. */
  constexpr unsigned int mesh_width = native_width;

  /**
   * `n` sums over the nodes of up to mesh_width particles. A particle's nodes lie in the lanes of registers, and their
   * sums are found one particle after the other; what is made of the sums has one particle in each lane.
   */
  template <unsigned int n>
  class SumsOfParticles
  {
  public:
    using Lanes = Simd<mesh_width>;

    /** The sums over the lanes of `rows` are those of particle l. */
    [[gnu::always_inline]] void set(const unsigned int l, const Lanes (&rows)[n])
    {
      for (unsigned int first = 0; first < n; first += 8)
      {
        Lanes block[8];
        for (unsigned int i = 0; i < 8; ++i)
          block[i] = first + i < n ? rows[first + i] : Lanes(0.);
        const Simd<8> total = sums_of_lanes<mesh_width>(block);
        for (unsigned int i = first; i < n && i < first + 8; ++i)
          value[i][l] = total[i - first];
      }
    }

    /** Gives the particles from `size` on the sums of the first: they are not used, but divided by. */
    void fill(const unsigned int size)
    {
      for (auto &row : value)
        for (unsigned int l = size; l < mesh_width; ++l)
          row[l] = row[0];
    }

    Lanes operator[](const unsigned int i) const { return Lanes::load(value[i]); }

  private:
    alignas(64) double value[n][mesh_width];
  };

  /** M = sum_v w_v p_v p_v^T of the linear basis p = [1, d], added up register by register. */
  template <int dim>
  struct MomentSums
  {
    static constexpr unsigned int n = dim + 1, n_sums = (dim + 1) * (dim + 2) / 2;
    using Lanes = Simd<mesh_width>;

    Lanes rows[n_sums]; // lower triangle of M, row by row

    [[gnu::always_inline]] MomentSums()
    {
      for (auto &row : rows)
        row = 0.;
    }

    [[gnu::always_inline]] void add(const Lanes &weight, const Lanes (&d)[dim])
    {
      rows[0] += weight;
      unsigned int k = 1;
      for (unsigned int i = 0; i < dim; ++i)
      {
        const Lanes first = weight * d[i];
        rows[k++] += first;
        for (unsigned int j = 0; j <= i; ++j)
          rows[k++] += first * d[j];
      }
    }
  };

  /** M^-1 of mesh_width particles, for later one by one: entry ij of particle l. */
  template <int dim>
  class InverseMoments
  {
  public:
    using Lanes = Simd<mesh_width>;

    /**
     * Of a positive definite M, by its block of the second moments about the mean c of d,
     * @f[ S = \sum w\,d d^T - m\,c c^T , \quad M^{-1} =
     *     \begin{pmatrix} 1/m + c^T S^{-1} c & -c^T S^{-1} \\ -S^{-1} c & S^{-1} \end{pmatrix} , \quad m = \sum w . @f]
     */
    [[gnu::always_inline]] explicit InverseMoments(const SumsOfParticles<MomentSums<dim>::n_sums> &sums)
    {
      const Lanes                             m = sums[0], inverse_m = 1. / m;
      Lanes                                   c[dim];
      std::array<std::array<Lanes, dim>, dim> S;
      for (unsigned int i = 0, k = 1; i < dim; ++i)
      {
        c[i] = inverse_m * sums[k++];
        for (unsigned int j = 0; j <= i; ++j)
          S[i][j] = S[j][i] = sums[k++] - m * c[i] * c[j];
      }
      const auto inverse_S = dual(S);
      Lanes      first     = inverse_m;
      for (unsigned int i = 0; i < dim; ++i)
      {
        Lanes shift = 0.;
        for (unsigned int j = 0; j < dim; ++j)
        {
          inverse_S[i][j].store(entry[i + 1][j + 1]);
          shift += inverse_S[i][j] * c[j];
        }
        (-shift).store(entry[i + 1][0]);
        (-shift).store(entry[0][i + 1]);
        first += c[i] * shift;
      }
      first.store(entry[0][0]);
    }

    double operator()(const unsigned int i, const unsigned int j, const unsigned int l) const { return entry[i][j][l]; }
    Lanes  lanes(const unsigned int i, const unsigned int j) const { return Lanes::load(entry[i][j]); }

  private:
    alignas(64) double entry[dim + 1][dim + 1][mesh_width];
  };
} // namespace Talus

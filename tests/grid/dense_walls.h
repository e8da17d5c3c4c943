#pragma once

#include <talus/grid/wall_rows.h>

#include <vector>

namespace Test
{
  using namespace Talus;

  /**
   * The nodes of a small box and its ghosts as one list that every rank has, with the matrix C of all rows: built here
   * once more, a dense row at a time.
   */
  template <int dim>
  class Dense
  {
  public:
    using Index  = typename Lattice<dim>::Index;
    using Vector = std::vector<double>;

    explicit Dense(const Index &n_cells) : n_cells(n_cells)
    {
      size = 1;
      for (unsigned int d = 0; d < dim; ++d)
        size *= n_cells[d] + 3;
      for (unsigned int i = 0; i < size; ++i)
      {
        nodes.push_back(index(i));
        is_real.push_back(true);
        is_at_face.push_back(false);
        for (unsigned int d = 0; d < dim; ++d)
        {
          const int at  = nodes[i][d];
          is_real[i]    = is_real[i] && at >= 0 && at <= n_cells[d];
          is_at_face[i] = is_at_face[i] || at == 0 || at == n_cells[d];
        }
        is_at_face[i] = is_at_face[i] && is_real[i];
      }
      held.assign(size, {});
    }

    unsigned int number(const Index &index) const
    {
      unsigned int i = 0;
      for (unsigned int d = dim; d-- > 0;)
        i = i * (n_cells[d] + 3) + index[d] + 1;
      return i;
    }

    /** Row of a node: coefficients of all nodes of the list. */
    Vector row(const Index &at, const unsigned int c) const
    {
      for (unsigned int d = 0; d < dim; ++d)
        if (at[d] < 0 || at[d] > n_cells[d])
        {
          Index w = at, q = at;
          w[d] = std::min(std::max(at[d], 0), n_cells[d]);
          q[d] = at[d] < 0 ? 1 : n_cells[d] - 1;
          // What the wall is on this line, it is on the line's image inside.
          Index image = w;
          for (unsigned int e = 0; e < dim; ++e)
            image[e] = w[e] < 0 ? 1 : w[e] > n_cells[e] ? n_cells[e] - 1 : w[e];
          const auto &wall = held[number(image)];
          Vector      sum  = row(q, c);
          if (c != d && wall[d] && !wall[c])
            return sum;
          const Vector of_w = row(w, c);
          for (unsigned int i = 0; i < size; ++i)
            sum[i] = 2 * of_w[i] - sum[i];
          return sum;
        }
      Vector unit(size, 0.);
      unit[number(at)] = 1;
      return unit;
    }

    void find_rows()
    {
      for (unsigned int c = 0; c < dim; ++c)
      {
        C[c].clear();
        for (unsigned int i = 0; i < size; ++i)
          C[c].push_back(row(nodes[i], c));
      }
    }

    /** C^T x. */
    Vector fold(const unsigned int c, const Vector &x) const
    {
      Vector sum(size, 0.);
      for (unsigned int i = 0; i < size; ++i)
        for (unsigned int j = 0; j < size; ++j)
          sum[j] += C[c][i][j] * x[i];
      return sum;
    }

    Index                                n_cells;
    unsigned int                         size = 0;
    std::vector<Index>                   nodes;
    std::vector<bool>                    is_real, is_at_face;
    std::vector<std::array<bool, dim>>   held;
    std::array<std::vector<Vector>, dim> C;

  private:
    Index index(unsigned int i) const
    {
      Index result;
      for (unsigned int d = 0; d < dim; ++d, i /= n_cells[d - 1] + 3)
        result[d] = static_cast<int>(i % (n_cells[d] + 3)) - 1;
      return result;
    }
  };
} // namespace Test

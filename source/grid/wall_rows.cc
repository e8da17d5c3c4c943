#include <talus/grid/wall_rows.h>
#include <talus/grid/walls.h>

namespace Talus
{
  template <int dim>
  void Walls<dim>::find_rows()
  {
    const auto &lattice = grid->lattice;
    const auto  real    = [&](const Index &index) { return position[lattice.node_at(index)]; };
    const auto  holds   = [&](const Index &index, const unsigned int c) { return asks(real(index), held, c); };
    is_mirrored.assign(real_node.size(), false);
    is_mirrored_ghost.assign(ghost_place.size(), false);
    for (unsigned int c = 0; c < dim; ++c)
    {
      Rows &of = rows[c];
      of.begin.assign(1, 0);
      of.entries.clear();
      for (unsigned int g = 0; g < ghost_place.size(); ++g)
      {
        const auto row = wall_row<dim>(ghost_index[g], c, lattice.n_cells, holds);
        for (unsigned int d = 0; d < dim; ++d)
          if (ghost_index[g][d] != grid->node_index[real_node[ghost_wall[g]]][d])
            is_mirrored_ghost[g] |= asks(ghost_wall[g], symmetric, d);
        for (unsigned int k = 0; k < row.size; ++k)
        {
          of.entries.push_back({real(row.node[k]), row.coefficient[k]});
          is_mirrored[of.entries.back().real] |= is_mirrored_ghost[g];
        }
        of.begin.push_back(of.entries.size());
      }
      find_blocks(c);
    }
  }

  template <int dim>
  void Walls<dim>::find_blocks(const unsigned int c)
  {
    Rows &of = rows[c];
    of.blocks.clear();
    of.block.assign(real_node.size(), none);
    of.local.assign(real_node.size(), none);

    // Joined are the free nodes of each ghost; where there may be friction, a node is a block of its own at least.
    std::vector<unsigned int> root(real_node.size());
    std::vector<char>         is_joined(real_node.size(), false);
    for (unsigned int r = 0; r < root.size(); ++r)
    {
      root[r]      = r;
      is_joined[r] = !asks(r, held, c) && state[r] >> pressed_below != 0;
    }
    const auto find = [&](unsigned int r) {
      while (root[r] != r)
        r = root[r] = root[root[r]];
      return r;
    };
    for (unsigned int g = 0; g < ghost_place.size(); ++g)
    {
      unsigned int first = none;
      for (unsigned int e = of.begin[g]; e < of.begin[g + 1]; ++e)
      {
        const unsigned int r = of.entries[e].real;
        if (asks(r, held, c))
          continue;
        if (first != none)
        {
          is_joined[first] = is_joined[r] = true;
          root[find(r)]                   = find(first);
        }
        first = r;
      }
    }
    for (const unsigned int r : real_order)
      if (is_joined[r])
      {
        unsigned int &number = of.block[find(r)];
        if (number == none)
        {
          number = of.blocks.size();
          of.blocks.push_back({});
        }
        of.block[r] = number;
        of.local[r] = of.blocks[number].reals.size();
        of.blocks[number].reals.push_back(r);
      }
    for (const unsigned int g : ghost_order)
      for (unsigned int e = of.begin[g]; e < of.begin[g + 1]; ++e)
        if (const unsigned int block = of.block[of.entries[e].real]; block != none)
        {
          of.blocks[block].ghosts.push_back(g);
          break; // all free nodes of a ghost are in one block
        }
  }

#define INSTANTIATE(dim)                                                                                               \
  template void Walls<dim>::find_rows();                                                                               \
  template void Walls<dim>::find_blocks(const unsigned int);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Talus

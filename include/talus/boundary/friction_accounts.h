#pragma once

#include <talus/core/archive.h>
#include <talus/grid/grid.h>

#include <array>
#include <unordered_map>
#include <vector>

namespace Talus
{
  /**
   * Normal impulse that friction has not used yet, of nodes along axes, and the mean of what there is in a step: see
   * Walls::press(). It is kept from one step to the next; a node that is not near any more has none.
   */
  template <int dim>
  class FrictionAccounts
  {
  public:
    using Account = std::array<double, 2>; // account, mean [momentum]

    /** A step begins: what was kept in the last one is what there is. */
    void begin_step()
    {
      if (next.empty())
        return;
      now.swap(next);
      next.clear();
    }

    /** Nothing where there is none. */
    const Account *of(const unsigned int node, const unsigned int axis) const
    {
      const auto found = now.find(key(node, axis));
      return found == now.end() ? nullptr : &found->second;
    }

    void keep(const unsigned int node, const unsigned int axis, const Account &account)
    {
      next[key(node, axis)] = account;
    }

    void forget()
    {
      now.clear();
      next.clear();
    }

    /** By the places of the nodes, which are the same on any number of ranks; `nodes` are those that may have one. */
    void serialize(Archive &archive, const Grid<dim> &grid,
                   const std::vector<const std::vector<unsigned int> *> &nodes);

  private:
    static std::size_t key(const unsigned int node, const unsigned int axis) { return std::size_t{node} * dim + axis; }

    std::unordered_map<std::size_t, Account> now, next;
  };
} // namespace Talus

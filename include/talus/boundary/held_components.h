#pragma once

#include <cstddef>
#include <vector>

namespace Talus
{
  /** Which components of the velocities of this rank's nodes conditions have set in a step. */
  template <int dim>
  class HeldComponents
  {
  public:
    /** Forgets the last step. */
    void clear(const unsigned int n_nodes)
    {
      for (const std::size_t k : held)
        is_held[k] = false;
      held.clear();
      is_held.resize(std::size_t{n_nodes} * dim, false);
    }

    /** This one is set; returns whether it was free until now. */
    bool hold(const unsigned int node, const unsigned int component)
    {
      const std::size_t k        = std::size_t{node} * dim + component;
      const bool        was_free = !is_held[k];
      if (was_free)
        held.push_back(k);
      is_held[k] = true;
      return was_free;
    }

    bool operator()(const unsigned int node, const unsigned int component) const
    {
      return is_held[std::size_t{node} * dim + component];
    }

  private:
    std::vector<char>        is_held; // dim for each node
    std::vector<std::size_t> held;
  };
} // namespace Talus

#pragma once

#include <talus/core/communicator.h>

#include <deal.II/base/index_set.h>
#include <deal.II/base/mpi.h>

#include <vector>

namespace Talus
{
  /**
   * Who owns which node, where its numbers lie in memory, and who has copies of it; one for a grid.
   *
   * Nodes are numbered: those this rank owns, then the copies of nodes that other ranks own. In memory they lie at
   * *places*: on a box those of a lattice that covers the rank's part of the grid, x running fastest, so that the nodes
   * of a stencil are found without a table.
   */
  class Nodes
  {
  public:
    /**
     * `relevant` are the nodes this rank reads, owned or not; `places` has one of the `n_places` places for each node
     * in the order of their numbers. Collective.
     */
    void reinit(const dealii::IndexSet &owned, const dealii::IndexSet &relevant, const Communicator &communicator,
                const std::vector<unsigned int> &places, const std::size_t n_places);

    unsigned int n_owned() const { return n_owned_nodes; }
    unsigned int n_local() const { return places.size(); }
    std::size_t  n_places() const { return n_all_places; }
    unsigned int place(const unsigned int node) const { return places[node]; }

    /** Nodes that this rank shares with another, in the order in which their numbers travel. */
    struct Neighbour
    {
      unsigned int              rank;
      std::vector<unsigned int> nodes;
    };

    /** Grows when nodes are numbered anew. */
    unsigned int numbering() const { return n_numberings; }

    std::vector<Neighbour> copied_by;   // owned nodes of which the neighbour has copies
    std::vector<Neighbour> copied_from; // copies of nodes that the neighbour owns
    Communicator           communicator;

    /** Nodes at the given places; the first of them this rank owns, and who shares which is known. */
    void reinit(const unsigned int n_owned, const std::vector<unsigned int> &places, const std::size_t n_places,
                const std::vector<Neighbour> &copied_by, const std::vector<Neighbour> &copied_from,
                const Communicator &communicator);

  private:
    unsigned int              n_owned_nodes = 0, n_numberings = 0;
    std::size_t               n_all_places = 0;
    std::vector<unsigned int> places; // of each node
  };
} // namespace Talus

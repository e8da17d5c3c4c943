#include <talus/grid/nodes.h>

#include <deal.II/base/partitioner.h>

namespace Talus
{
  using namespace dealii;

  void Nodes::reinit(const IndexSet &owned, const IndexSet &relevant, const Communicator &communicator,
                     const std::vector<unsigned int> &places, const std::size_t n_places)
  {
    const Utilities::MPI::Partitioner partitioner(owned, relevant, communicator);
    this->communicator = communicator;
    this->places       = places;
    n_owned_nodes      = partitioner.locally_owned_size();
    ++n_numberings;
    n_all_places = n_places;
    AssertDimension(places.size(), n_owned_nodes + partitioner.n_ghost_indices());

    copied_by.clear();
    copied_from.clear();
    unsigned int next = n_owned_nodes;
    for (const auto &[rank, n] : partitioner.ghost_targets())
    {
      copied_from.push_back({rank, {}});
      for (unsigned int i = 0; i < n; ++i)
        copied_from.back().nodes.push_back(next++);
    }
    std::vector<unsigned int> sent;
    for (const auto &[begin, end] : partitioner.import_indices())
      for (unsigned int i = begin; i < end; ++i)
        sent.push_back(i);
    auto from = sent.begin();
    for (const auto &[rank, n] : partitioner.import_targets())
    {
      copied_by.push_back({rank, {from, from + n}});
      from += n;
    }
  }

  void Nodes::reinit(const unsigned int n_owned, const std::vector<unsigned int> &places, const std::size_t n_places,
                     const std::vector<Neighbour> &copied_by, const std::vector<Neighbour> &copied_from,
                     const Communicator &communicator)
  {
    n_owned_nodes = n_owned;
    ++n_numberings;
    n_all_places       = n_places;
    this->places       = places;
    this->copied_by    = copied_by;
    this->copied_from  = copied_from;
    this->communicator = communicator;
  }
} // namespace Talus

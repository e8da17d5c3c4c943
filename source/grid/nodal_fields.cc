#include <talus/core/traffic.h>
#include <talus/grid/nodal_fields.h>

#include <algorithm>
#include <new>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    constexpr int message_tag = 7001; // no other part of the program uses it
  }

  template <int dim>
  void NodalFields<dim>::reinit(const IndexSet &owned_nodes, const IndexSet &relevant_nodes, MPI_Comm communicator,
                                const std::vector<unsigned int> &places, const std::size_t n_places)
  {
    static_assert(1 + 2 * dim <= stride, "mass and two vectors must fit");
    partitioner = std::make_shared<Utilities::MPI::Partitioner>(owned_nodes, relevant_nodes, communicator);
    place       = places;
    AssertDimension(place.size(), partitioner->locally_owned_size() + partitioner->n_ghost_indices());

    allocate(n_places);
    owned.clear();
    copies.clear();
    unsigned int next = partitioner->locally_owned_size();
    for (const auto &[rank, n] : partitioner->ghost_targets())
    {
      copies.push_back({rank, {}, std::vector<double>(n * stride)});
      for (unsigned int i = 0; i < n; ++i)
        copies.back().nodes.push_back(next++);
    }
    std::vector<unsigned int> sent;
    for (const auto &[begin, end] : partitioner->import_indices())
      for (unsigned int i = begin; i < end; ++i)
        sent.push_back(i);
    auto from = sent.begin();
    for (const auto &[rank, n] : partitioner->import_targets())
    {
      owned.push_back({rank, {from, from + n}, std::vector<double>(n * stride)});
      from += n;
    }
    requests.resize(owned.size() + copies.size());
  }

  template <int dim>
  void NodalFields<dim>::reinit(const NodalFields &other)
  {
    partitioner = other.partitioner;
    place       = other.place;
    owned       = other.owned;
    copies      = other.copies;
    requests.resize(other.requests.size());
    allocate(other.n_places);
  }

  template <int dim>
  void NodalFields<dim>::allocate(const std::size_t n)
  {
    // Pages that are never touched must not exist: memory from calloc, moved to the begin of a cache line.
    constexpr std::size_t line = 64;
    n_places                   = n;
    memory.reset(std::calloc(n_places * stride * sizeof(double) + line, 1));
    if (memory == nullptr)
      throw std::bad_alloc();
    values = reinterpret_cast<double *>((reinterpret_cast<std::size_t>(memory.get()) + line - 1) / line * line);
  }

  template <int dim>
  void NodalFields<dim>::clear()
  {
    for (unsigned int i = 0; i < n_local(); ++i)
      std::fill_n((*this)[i], stride, 0.);
  }

  template <int dim>
  void NodalFields<dim>::clear_copies()
  {
    for (unsigned int i = n_owned(); i < n_local(); ++i)
      std::fill_n((*this)[i], stride, 0.);
  }

  template <int dim>
  template <class Receive>
  void NodalFields<dim>::exchange(std::vector<Message> &out, std::vector<Message> &in, const Receive &receive)
  {
    const MPI_Comm communicator = partitioner->get_mpi_communicator();
    auto           request      = requests.begin();
    for (Message &message : in)
      MPI_Irecv(message.buffer.data(), message.buffer.size(), MPI_DOUBLE, message.rank, message_tag, communicator,
                &*request++);
    for (Message &message : out)
    {
      double *next = message.buffer.data();
      for (const unsigned int i : message.nodes)
        next = std::copy_n((*this)[i], stride, next);
      MPI_Isend(message.buffer.data(), message.buffer.size(), MPI_DOUBLE, message.rank, message_tag, communicator,
                &*request++);
      Traffic::here().sent(message.buffer.size() * sizeof(double));
    }
    {
      const Traffic::Wait wait;
      MPI_Waitall(requests.size(), requests.data(), MPI_STATUSES_IGNORE);
    }
    // In the order of the ranks and not of arrival: sums are then the same in each run.
    for (const Message &message : in)
    {
      const double *next = message.buffer.data();
      for (const unsigned int i : message.nodes)
      {
        receive((*this)[i], next);
        next += stride;
      }
    }
  }

  template <int dim>
  void NodalFields<dim>::add_copies_to_owners()
  {
    exchange(copies, owned, [](double *node, const double *received) {
      for (unsigned int c = 0; c < stride; ++c)
        node[c] += received[c];
    });
    clear_copies();
  }

  template <int dim>
  void NodalFields<dim>::update_copies()
  {
    exchange(owned, copies, [](double *node, const double *received) { std::copy_n(received, stride, node); });
  }

  template <int dim>
  typename NodalFields<dim>::MirrorFactors NodalFields<dim>::make_mirror_factors()
  {
    MirrorFactors factors;
    for (unsigned int faces = 0; faces < factors.size(); ++faces)
    {
      factors[faces].fill(1.);
      for (unsigned int d = 0; d < dim; ++d)
        if (faces >> 2 * d & 3)
          factors[faces][velocity + d] = factors[faces][increment + d] = -1.;
    }
    return factors;
  }

  template <int dim>
  const typename NodalFields<dim>::MirrorFactors NodalFields<dim>::mirror_factors = make_mirror_factors();

  template class NodalFields<2>;
  template class NodalFields<3>;
} // namespace Talus

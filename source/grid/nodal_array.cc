#include <talus/grid/nodal_array.h>

#include <sys/mman.h>

#include <new>

namespace Talus
{
  namespace
  {
    constexpr int message_tag = 7001; // no other part of the program uses it
  }

  UntouchedMemory::UntouchedMemory(const std::size_t n_doubles) :
    n_bytes(std::max<std::size_t>(1, n_doubles) * sizeof(double))
  {
    void *const memory =
      mmap(nullptr, n_bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (memory == MAP_FAILED)
      throw std::bad_alloc();
    values = static_cast<double *>(memory);
  }

  UntouchedMemory::~UntouchedMemory() { munmap(values, n_bytes); }

  void NodalExchange::reinit(const Nodes &nodes)
  {
    const auto resize = [&](const std::vector<Nodes::Neighbour> &neighbours, Buffers &buffers) {
      buffers.clear();
      for (const auto &neighbour : neighbours)
        buffers.emplace_back(neighbour.nodes.size() * n);
    };
    resize(nodes.copied_by, owned);
    resize(nodes.copied_from, copies);
    requests.resize(owned.size() + copies.size());
  }

  template <class Receive>
  void NodalExchange::exchange(const Nodes &nodes, const std::vector<Nodes::Neighbour> &to, Buffers &out,
                               const std::vector<Nodes::Neighbour> &from, Buffers &in, double *values,
                               const Receive &receive)
  {
    if (requests.empty()) // waiting for nobody would give the processor to others
      return;
    auto request = requests.begin();
    for (unsigned int k = 0; k < from.size(); ++k)
      MPI_Irecv(in[k].data(), in[k].size(), MPI_DOUBLE, from[k].rank, message_tag, nodes.communicator, &*request++);
    for (unsigned int k = 0; k < to.size(); ++k)
    {
      double *next = out[k].data();
      for (const unsigned int i : to[k].nodes)
        next = std::copy_n(values + static_cast<std::size_t>(n) * nodes.place(i), n, next);
      MPI_Isend(out[k].data(), out[k].size(), MPI_DOUBLE, to[k].rank, message_tag, nodes.communicator, &*request++);
      nodes.communicator.sent(out[k].size() * sizeof(double));
    }
    {
      const Communicator::Wait wait(nodes.communicator);
      MPI_Waitall(requests.size(), requests.data(), MPI_STATUSES_IGNORE);
    }
    // In the order of the ranks and not of arrival: sums are then the same in each run.
    for (unsigned int k = 0; k < from.size(); ++k)
    {
      const double *next = in[k].data();
      for (const unsigned int i : from[k].nodes)
      {
        receive(values + static_cast<std::size_t>(n) * nodes.place(i), next);
        next += n;
      }
    }
  }

  void NodalExchange::add_to_owners(const Nodes &nodes, double *values)
  {
    exchange(nodes, nodes.copied_from, copies, nodes.copied_by, owned, values,
             [this](double *node, const double *received) {
               for (unsigned int c = 0; c < n; ++c)
                 node[c] += received[c];
             });
  }

  void NodalExchange::update_copies(const Nodes &nodes, double *values)
  {
    exchange(nodes, nodes.copied_by, owned, nodes.copied_from, copies, values,
             [this](double *node, const double *received) { std::copy_n(received, n, node); });
  }
} // namespace Talus

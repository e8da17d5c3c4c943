#pragma once

#include <talus/grid/nodes.h>

#include <algorithm>
#include <memory>

namespace Talus
{
  /** Zeroed memory of which only what is touched exists, at the begin of a cache line [double]. */
  class UntouchedMemory
  {
  public:
    explicit UntouchedMemory(const std::size_t n_doubles);
    ~UntouchedMemory();
    UntouchedMemory(const UntouchedMemory &)            = delete;
    UntouchedMemory &operator=(const UntouchedMemory &) = delete;

    double *data() const { return values; }

  private:
    const std::size_t n_bytes;
    double           *values;
  };

  /**
   * Numbers of nodes that travel between their owners and those who have copies, some doubles a node side by side. One
   * message per neighbour carries all of them. Test: tests/grid.
   */
  class NodalExchange
  {
  public:
    explicit NodalExchange(const unsigned int n) : n(n) {}

    /** Prepares buffers. */
    void reinit(const Nodes &nodes);

    /** Adds what this rank has in its copies to their owners. Collective. */
    void add_to_owners(const Nodes &nodes, double *values);

    /** Brings the owners' numbers into the copies. Collective. */
    void update_copies(const Nodes &nodes, double *values);

  private:
    using Buffers = std::vector<std::vector<double>>;

    template <class Receive>
    void exchange(const Nodes &nodes, const std::vector<Nodes::Neighbour> &to, Buffers &out,
                  const std::vector<Nodes::Neighbour> &from, Buffers &in, double *values, const Receive &receive);

    unsigned int             n;
    Buffers                  owned, copies;
    std::vector<MPI_Request> requests;
  };

  /**
   * `n` doubles for each node of a grid, at the places of `nodes`. Places without a node are never touched, and the
   * operating system gives them no memory.
   */
  template <unsigned int n>
  class NodalArray
  {
  public:
    static constexpr unsigned int stride = n;

    /** Zeros for all nodes, which must outlive the array. */
    void reinit(const Nodes &nodes)
    {
      this->nodes = &nodes;
      numbering   = nodes.numbering();
      memory      = std::make_unique<UntouchedMemory>(nodes.n_places() * stride);
      values      = memory->data();
      exchange.reinit(nodes);
    }

    void clear()
    {
      for (unsigned int i = 0; i < n_local(); ++i)
        std::fill_n((*this)[i], stride, 0.);
    }

    void clear_copies()
    {
      for (unsigned int i = n_owned(); i < n_local(); ++i)
        std::fill_n((*this)[i], stride, 0.);
    }

    /** Zeros some nodes and all copies. */
    void clear(const std::vector<unsigned int> &some)
    {
      for (const unsigned int i : some)
        std::fill_n((*this)[i], stride, 0.);
      clear_copies();
    }

    /** Adds what this rank has summed into copies to their owners, and zeros the copies. Collective. */
    void add_copies_to_owners()
    {
      exchange.add_to_owners(*nodes, values);
      clear_copies();
    }

    /** Brings the owners' values into the copies. Collective. */
    void update_copies() { exchange.update_copies(*nodes, values); }

    /** Whether there are no numbers, or those of nodes that have been numbered anew since. */
    bool         is_empty() const { return nodes == nullptr || numbering != nodes->numbering(); }
    unsigned int n_owned() const { return nodes->n_owned(); }
    unsigned int n_local() const { return nodes->n_local(); }

    double       *operator[](const unsigned int node) { return at_place(nodes->place(node)); }
    const double *operator[](const unsigned int node) const { return at_place(nodes->place(node)); }

    double       *at_place(const std::size_t place) { return values + stride * place; }
    const double *at_place(const std::size_t place) const { return values + stride * place; }

  private:
    const Nodes                     *nodes     = nullptr;
    unsigned int                     numbering = 0;
    double                          *values    = nullptr;
    std::unique_ptr<UntouchedMemory> memory;
    NodalExchange                    exchange{n};
  };
} // namespace Talus

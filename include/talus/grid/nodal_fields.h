#pragma once

#include <deal.II/base/partitioner.h>

#include <array>
#include <cstdlib>
#include <memory>

namespace Talus
{
  /**
   * What the nodes carry during a step, eight numbers a node side by side (one
   * cache line): the mass and two vectors. A step fills and reads them in order:
   *
   * | lanes             | after particle_to_grid | after update_velocity  |
   * |-------------------|------------------------|------------------------|
   * | 0                 | m_i [mass]             | m_i                    |
   * | 1 .. dim          | momentum m_i v_i^n     | velocity v_i^{n+1}     |
   * | dim+1 .. 2 dim    | force f_i              | v_i^{n+1} - v_i^n      |
   *
   * Nodes are numbered: those this rank owns, then the copies of nodes that other
   * ranks own. In memory they lie at the *places* of a lattice that covers the
   * rank's part of the grid, x running fastest, so that the nodes of a stencil are
   * found without a table. Places without a node are never touched, and the
   * operating system gives them no memory. One message per neighbour exchanges everything.
   */
  template <int dim>
  class NodalFields
  {
  public:
    static constexpr unsigned int stride    = 8;
    static constexpr unsigned int mass      = 0;
    static constexpr unsigned int momentum  = 1;
    static constexpr unsigned int velocity  = 1;
    static constexpr unsigned int force     = 1 + dim;
    static constexpr unsigned int increment = 1 + dim;

    /**
     * `relevant_nodes` are those this rank reads, owned or not; `places` has one of
     * the `n_places` places of the lattice for each node in the order of their numbers. Collective.
     */
    void reinit(const dealii::IndexSet &owned_nodes, const dealii::IndexSet &relevant_nodes, MPI_Comm communicator,
                const std::vector<unsigned int> &places, const std::size_t n_places);

    /** The same nodes at the same places as those of another, with memory and messages of their own. */
    void reinit(const NodalFields &other);

    void clear();
    void clear_copies();

    /**
     * Factors of a node's numbers where it stands for its mirror image in some faces of the box, bit 2 d or 2 d + 1
     * those of axis d: -1 for the components along their normals.
     */
    static const double *mirror(const unsigned int faces) { return mirror_factors[faces].data(); }

    /** Counts the force among a node's numbers that are about to be mirrored; its image gets the opposite of it. */
    void count_mirrored(const double *numbers, const unsigned int faces)
    {
      for (unsigned int f = 0; f < 2 * dim; ++f)
        if (faces >> f & 1)
          mirrored_force[f] += 2 * numbers[force + f / 2];
    }

    /** What each face bears of the last transfer to the nodes, besides its nodes: of this rank's particles [force]. */
    std::array<double, 2 * dim> mirrored_force{};

    /** Adds what this rank has summed into copies to their owners, and zeros the copies. Collective. */
    void add_copies_to_owners();

    /** Brings the owners' values into the copies. Collective. */
    void update_copies();

    unsigned int n_owned() const { return partitioner->locally_owned_size(); }
    unsigned int n_local() const { return place.size(); }

    double       *operator[](const unsigned int node) { return at_place(place[node]); }
    const double *operator[](const unsigned int node) const { return at_place(place[node]); }

    double       *at_place(const std::size_t place) { return values + stride * place; }
    const double *at_place(const std::size_t place) const { return values + stride * place; }

  private:
    using MirrorFactors = std::array<std::array<double, stride>, 1u << (2 * dim)>;
    static MirrorFactors       make_mirror_factors();
    static const MirrorFactors mirror_factors;

    void allocate(const std::size_t n_places);

    /** What one rank sends to another: these nodes, in this order, through its part of a buffer. */
    struct Message
    {
      unsigned int              rank;
      std::vector<unsigned int> nodes;
      std::vector<double>       buffer;
    };

    /** Sends the nodes of `out`; then calls `receive(node, values)` for those of `in`. */
    template <class Receive>
    void exchange(std::vector<Message> &out, std::vector<Message> &in, const Receive &receive);

    struct Free
    {
      void operator()(void *memory) const { std::free(memory); }
    };

    std::shared_ptr<dealii::Utilities::MPI::Partitioner> partitioner;
    std::unique_ptr<void, Free>                          memory;
    double                                              *values   = nullptr;
    std::size_t                                          n_places = 0;
    std::vector<unsigned int>                            place; // of each node
    std::vector<Message>                                 owned, copies; // what neighbours copy; what this rank copies
    std::vector<MPI_Request>                             requests;
  };
} // namespace Talus

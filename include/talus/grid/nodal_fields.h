#pragma once

#include <deal.II/base/index_set.h>
#include <deal.II/lac/la_parallel_vector.h>

#include <array>

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
   * Owned nodes come first, then the copies of nodes that other ranks own; one
   * message per neighbour exchanges everything.
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

    void reinit(const dealii::IndexSet &owned_nodes, const dealii::IndexSet &relevant_nodes, MPI_Comm communicator);

    void clear() { values = 0.; }
    void clear_copies() { values.zero_out_ghost_values(); }

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

    /** Adds what this rank has summed into copies to their owners. */
    void add_copies_to_owners() { values.compress(dealii::VectorOperation::add); }

    /** Brings the owners' values into the copies. */
    void update_copies() { values.update_ghost_values(); }

    unsigned int n_owned() const { return values.locally_owned_size() / stride; }
    unsigned int n_local() const
    {
      return (values.locally_owned_size() + values.get_partitioner()->n_ghost_indices()) / stride;
    }

    double       *operator[](const unsigned int node) { return values.begin() + stride * node; }
    const double *operator[](const unsigned int node) const { return values.begin() + stride * node; }

  private:
    using MirrorFactors = std::array<std::array<double, stride>, 1u << (2 * dim)>;
    static MirrorFactors       make_mirror_factors();
    static const MirrorFactors mirror_factors;

    dealii::LinearAlgebra::distributed::Vector<double> values;
  };
} // namespace Talus

#pragma once

#include <deal.II/base/index_set.h>
#include <deal.II/lac/la_parallel_vector.h>

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
    dealii::LinearAlgebra::distributed::Vector<double> values;
  };
} // namespace Talus

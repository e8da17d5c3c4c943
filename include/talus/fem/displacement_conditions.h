#pragma once

#include <talus/core/parameters.h>
#include <talus/fem/displacement_condition.h>

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/mapping.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/la_parallel_vector.h>

#include <map>
#include <memory>

namespace Talus
{
  /**
   * All prescribed displacements of a body. Where two prescribe the same component of the same node, the last one in
   * the list counts.
   *
   * Throws InputError when they leave the body free to move as a whole, and EntryError when a box holds no node.
   * Test: tests/fem/.
   */
  template <int dim>
  class DisplacementConditions
  {
  public:
    using Vector = dealii::LinearAlgebra::distributed::Vector<double>;

    /** Reads the names and builds the conditions of `section`. */
    DisplacementConditions(Parameters &parameters, const std::string &section);

    /**
     * Finds the degrees of freedom and their values at `time`; always for the same mesh. A body in equilibrium must be
     * held, one with inertia need not. Collective.
     */
    void prescribe(const dealii::Mapping<dim> &mapping, const dealii::DoFHandler<dim> &dof_handler, const double time,
                   const bool must_be_held = true);

    /** Calls `visit(dof, value)` for what is prescribed of this rank's own degrees of freedom. */
    template <class Visitor>
    void for_each_owned(const Visitor &visit) const
    {
      for (const auto &[dof, data] : prescribed)
        if (owned.is_element(dof))
          visit(dof, data.value);
    }

    bool depends_on_time() const;

    /** What is prescribed; with `current` what still has to be added to it. */
    dealii::AffineConstraints<double> constraints(const Vector *current = nullptr) const;

    /** Minus the sum of `residual` over what the condition prescribes: the force of the body on it. Collective. */
    dealii::Tensor<1, dim> force(const std::string &condition, const Vector &residual) const;

    /** The mean over the nodes of what the condition prescribes, 0 for the other components. Collective. */
    dealii::Tensor<1, dim> mean_displacement(const std::string &condition) const;

    /** Square sum of the entries of `residual` where nothing is prescribed. Collective. */
    double free_norm_square(const Vector &residual) const;

    bool                     has(const std::string &condition) const;
    std::vector<std::string> names() const;

  private:
    /** A degree of freedom that a condition prescribes. */
    struct Prescribed
    {
      unsigned int condition, component;
      double       value;
    };

    void         locate_nodes(const dealii::Mapping<dim> &mapping, const dealii::DoFHandler<dim> &dof_handler);
    void         prescribe_faces(const unsigned int k, const dealii::Mapping<dim> &mapping,
                                 const dealii::DoFHandler<dim> &dof_handler, const double time);
    void         prescribe_box(const unsigned int k, const dealii::DoFHandler<dim> &dof_handler, const double time);
    void         check_body_is_held() const;
    unsigned int number_of(const std::string &condition) const;

    const std::string                                             section;
    std::vector<std::unique_ptr<DisplacementCondition<dim>>>      conditions;
    MPI_Comm                                                      communicator = MPI_COMM_NULL;
    dealii::IndexSet                                              owned, relevant;
    dealii::Point<dim>                                            lower; // of the body
    double                                                        size = 0.;
    std::map<dealii::types::global_dof_index, dealii::Point<dim>> positions;
    std::map<dealii::types::global_dof_index, Prescribed>         prescribed; // those relevant on this rank
  };
} // namespace Talus

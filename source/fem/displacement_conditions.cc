#include <talus/fem/displacement_conditions.h>

#include <deal.II/dofs/dof_tools.h>
#include <deal.II/lac/lapack_full_matrix.h>
#include <deal.II/numerics/vector_tools_boundary.h>

#include <algorithm>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    /** A component of the rigid translations and rotations at x. */
    template <int dim>
    std::vector<double> rigid_motions(const Tensor<1, dim> &x, const unsigned int component)
    {
      std::vector<double> motions(dim, 0.);
      motions[component] = 1.;
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = i + 1; j < dim; ++j)
          motions.push_back(component == i ? -x[j] : component == j ? x[i] : 0.);
      return motions;
    }
  } // namespace

  template <int dim>
  DisplacementConditions<dim>::DisplacementConditions(Parameters &parameters, const std::string &section) :
    section(section)
  {
    for (const auto &name : parameters.names(section, "Names of the prescribed displacements. Each has a section of "
                                                      "its name; where two prescribe the same, the last one counts."))
      conditions.push_back(std::make_unique<DisplacementCondition<dim>>(section + "/" + name, name));
  }

  template <int dim>
  void DisplacementConditions<dim>::prescribe(const Mapping<dim> &mapping, const DoFHandler<dim> &dof_handler,
                                              const double time, const bool must_be_held)
  {
    if (size == 0.)
      locate_nodes(mapping, dof_handler);
    prescribed.clear();
    for (unsigned int k = 0; k < conditions.size(); ++k)
    {
      if (!conditions[k]->boundary_ids.empty())
        prescribe_faces(k, mapping, dof_handler, time);
      if (conditions[k]->has_box())
        prescribe_box(k, dof_handler, time);
    }
    if (must_be_held)
      check_body_is_held();
  }

  template <int dim>
  bool DisplacementConditions<dim>::depends_on_time() const
  {
    return std::any_of(conditions.begin(), conditions.end(), [](const auto &c) { return c->depends_on_time(); });
  }

  template <int dim>
  void DisplacementConditions<dim>::locate_nodes(const Mapping<dim> &mapping, const DoFHandler<dim> &dof_handler)
  {
    communicator = dof_handler.get_communicator();
    owned        = dof_handler.locally_owned_dofs();
    relevant     = DoFTools::extract_locally_relevant_dofs(dof_handler);
    DoFTools::map_dofs_to_support_points(mapping, dof_handler, positions);

    std::vector<double> first(dim, std::numeric_limits<double>::max()),
      last(dim, std::numeric_limits<double>::lowest());
    for (const auto &[dof, x] : positions)
      for (unsigned int i = 0; i < dim; ++i)
      {
        first[i] = std::min(first[i], x[i]);
        last[i]  = std::max(last[i], x[i]);
      }
    Utilities::MPI::min(first, communicator, first);
    Utilities::MPI::max(last, communicator, last);
    Point<dim> upper;
    for (unsigned int i = 0; i < dim; ++i)
    {
      lower[i] = first[i];
      upper[i] = last[i];
    }
    size = (upper - lower).norm();
  }

  template <int dim>
  void DisplacementConditions<dim>::prescribe_faces(const unsigned int k, const Mapping<dim> &mapping,
                                                    const DoFHandler<dim> &dof_handler, const double time)
  {
    const auto &condition = *conditions[k];
    for (const unsigned int component : condition.components)
    {
      const VectorFunctionFromScalarFunctionObject<dim> displacement(
        [&](const Point<dim> &x) { return condition.displacement.value(x, time)[component]; }, component, dim);
      std::map<types::boundary_id, const Function<dim> *> functions;
      for (const unsigned int id : condition.boundary_ids)
        functions[id] = &displacement;
      ComponentMask mask(dim, false);
      mask.set(component, true);
      std::map<types::global_dof_index, double> values;
      VectorTools::interpolate_boundary_values(mapping, dof_handler, functions, values, mask);
      for (const auto &[dof, value] : values)
        prescribed[dof] = {k, component, value};
    }
  }

  template <int dim>
  void DisplacementConditions<dim>::prescribe_box(const unsigned int k, const DoFHandler<dim> &dof_handler,
                                                  const double time)
  {
    const auto                          &condition = *conditions[k];
    const auto                          &fe        = dof_handler.get_fe();
    std::vector<types::global_dof_index> dofs(fe.n_dofs_per_cell());
    unsigned int                         is_found = 0;
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (!cell->is_artificial())
      {
        cell->get_dof_indices(dofs);
        for (unsigned int i = 0; i < dofs.size(); ++i)
        {
          const unsigned int component = fe.system_to_component_index(i).first;
          const Point<dim>  &x         = positions.at(dofs[i]);
          if (!condition.holds_for(component) || !condition.is_in_box(x, 1e-10 * size))
            continue;
          prescribed[dofs[i]] = {k, component, condition.displacement.value(x, time)[component]};
          is_found            = 1;
        }
      }
    if (Utilities::MPI::max(is_found, communicator) == 0)
      throw EntryError(condition.get_section_name(), "Lower corner",
                       "no node of the reference lies in this box. Make it at least half a cell wide, or move it so "
                       "that it holds the nodes meant.");
  }

  template <int dim>
  void DisplacementConditions<dim>::check_body_is_held() const
  {
    // The body is held when no rigid motion vanishes on all that is prescribed: their Gram matrix there is regular.
    const unsigned int  n = dim + dim * (dim - 1) / 2;
    std::vector<double> gram(n * n, 0.);
    for (const auto &[dof, data] : prescribed)
      if (owned.is_element(dof))
      {
        const Tensor<1, dim> x       = (positions.at(dof) - lower) / size;
        const auto           motions = rigid_motions(x, data.component);
        for (unsigned int a = 0; a < n; ++a)
          for (unsigned int b = 0; b < n; ++b)
            gram[a * n + b] += motions[a] * motions[b];
      }
    Utilities::MPI::sum(gram, communicator, gram);

    LAPACKFullMatrix<double> matrix(n);
    for (unsigned int a = 0; a < n; ++a)
      for (unsigned int b = 0; b < n; ++b)
        matrix(a, b) = gram[a * n + b];
    matrix.compute_svd();
    AssertThrow(matrix.singular_value(n - 1) > 1e-10 * matrix.singular_value(0),
                EntryError(section, "Names",
                           "the conditions leave the body free to move or turn as a whole. Prescribe more components, "
                           "or another face."));
  }

  template <int dim>
  AffineConstraints<double> DisplacementConditions<dim>::constraints(const Vector *current) const
  {
    AffineConstraints<double> constraints(relevant);
    for (const auto &[dof, data] : prescribed)
    {
      constraints.add_line(dof);
      constraints.set_inhomogeneity(dof, current == nullptr ? data.value : data.value - (*current)[dof]);
    }
    constraints.close();
    return constraints;
  }

  template <int dim>
  Tensor<1, dim> DisplacementConditions<dim>::force(const std::string &condition, const Vector &residual) const
  {
    const unsigned int k = number_of(condition);
    Tensor<1, dim>     force;
    for (const auto &[dof, data] : prescribed)
      if (data.condition == k && owned.is_element(dof))
        force[data.component] -= residual[dof];
    return Utilities::MPI::sum(force, communicator);
  }

  template <int dim>
  Tensor<1, dim> DisplacementConditions<dim>::mean_displacement(const std::string &condition) const
  {
    const unsigned int k = number_of(condition);
    Tensor<1, dim>     sum, n;
    for (const auto &[dof, data] : prescribed)
      if (data.condition == k && owned.is_element(dof))
      {
        sum[data.component] += data.value;
        n[data.component] += 1.;
      }
    sum = Utilities::MPI::sum(sum, communicator);
    n   = Utilities::MPI::sum(n, communicator);
    for (unsigned int i = 0; i < dim; ++i)
      sum[i] /= std::max(n[i], 1.);
    return sum;
  }

  template <int dim>
  double DisplacementConditions<dim>::free_norm_square(const Vector &residual) const
  {
    double sum = 0.;
    for (const auto dof : owned)
      if (prescribed.find(dof) == prescribed.end())
        sum += residual[dof] * residual[dof];
    return Utilities::MPI::sum(sum, communicator);
  }

  template <int dim>
  bool DisplacementConditions<dim>::has(const std::string &condition) const
  {
    return std::any_of(conditions.begin(), conditions.end(), [&](const auto &c) { return c->name == condition; });
  }

  template <int dim>
  std::vector<std::string> DisplacementConditions<dim>::names() const
  {
    std::vector<std::string> names;
    for (const auto &condition : conditions)
      names.push_back(condition->name);
    return names;
  }

  template <int dim>
  unsigned int DisplacementConditions<dim>::number_of(const std::string &condition) const
  {
    const auto         all = names();
    const unsigned int k   = std::find(all.begin(), all.end(), condition) - all.begin();
    if (k == all.size())
    {
      const std::string similar = closest(condition, all);
      throw InputError("The finite element reference has no condition '" + condition + "'." +
                       (similar.empty() ? "" : " Did you mean '" + similar + "'?") +
                       " List it in 'Names' of section '" + section.substr(section.find_first_not_of('/')) +
                       "', or ask for one of those.");
    }
    return k;
  }

  template class DisplacementConditions<2>;
  template class DisplacementConditions<3>;
} // namespace Talus

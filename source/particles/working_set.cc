#include <talus/particles/working_set.h>

#include <deal.II/base/exceptions.h>

namespace Talus
{
  using namespace dealii;

  template <int dim>
  WorkingSet<dim>::WorkingSet()
  {
    position         = add_field("position", dim);
    velocity         = add_field("velocity", dim);
    grad_v           = add_field("velocity gradient", dim * dim);
    F                = add_field("deformation gradient", dim * dim);
    stress           = add_field("stress", n_stress);
    mass             = add_field("mass", 1);
    volume           = add_field("volume", 1);
    initial_position = add_field("initial position", dim);
    for (unsigned int d = 0; d < dim; ++d)
      fields[F].initial[d * dim + d] = 1.;
  }

  template <int dim>
  unsigned int WorkingSet<dim>::add_field(const std::string &name, const unsigned int n_components,
                                          const double initial)
  {
    for (unsigned int f = 0; f < fields.size(); ++f)
      if (fields[f].name == name)
      {
        Assert(fields[f].n_components == n_components, ExcDimensionMismatch(fields[f].n_components, n_components));
        return f;
      }
    Assert(size() == 0, ExcMessage("Fields must be added before particles exist."));
    fields.push_back({name, n_columns(), n_components, std::vector<double>(n_components, initial)});
    columns.resize(columns.size() + n_components);
    return fields.size() - 1;
  }

  template <int dim>
  void WorkingSet<dim>::resize(const unsigned int n_particles)
  {
    id.resize(n_particles);
    body.resize(n_particles);
    for (const auto &field : fields)
      for (unsigned int c = 0; c < field.n_components; ++c)
        columns[field.first + c].resize(n_particles, field.initial[c]);
  }

  template <int dim>
  void WorkingSet<dim>::permute(const std::vector<unsigned int> &order)
  {
    const auto reorder = [&](auto &values) {
      std::decay_t<decltype(values)> ordered(order.size());
      for (unsigned int i = 0; i < order.size(); ++i)
        ordered[i] = values[order[i]];
      values.swap(ordered);
    };
    reorder(id);
    reorder(body);
    for (auto &column : columns)
      reorder(column);
  }

  template class WorkingSet<2>;
  template class WorkingSet<3>;
} // namespace Talus

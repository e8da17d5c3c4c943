#include <talus/particles/working_set.h>

#include <deal.II/base/exceptions.h>

#ifdef __linux__
#include <sys/mman.h>
#endif

#include <cstdint>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    /**
     * Reserves a column, and asks for large pages in it: the first touch of a million small ones takes longer than
     * everything that is written into them.
     */
    void reserve_column(AlignedVector<double> &column, const std::size_t n)
    {
      if (n <= column.capacity())
        return;
      column.reserve(n);
#ifdef __linux__
      constexpr std::uintptr_t page  = 1u << 21;
      const auto               at    = reinterpret_cast<std::uintptr_t>(column.data());
      const auto               begin = (at + page - 1) / page * page, end = (at + n * sizeof(double)) / page * page;
      if (begin < end)
        madvise(reinterpret_cast<void *>(begin), end - begin, MADV_HUGEPAGE); // without it the run is slower, no more
#endif
    }
  } // namespace

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
    if (const auto f = find_field(name))
    {
      Assert(fields[*f].n_components == n_components, ExcDimensionMismatch(fields[*f].n_components, n_components));
      return *f;
    }
    Assert(size() == 0, ExcMessage("Fields must be added before particles exist."));
    fields.push_back({name, n_columns(), n_components, std::vector<double>(n_components, initial)});
    columns.resize(columns.size() + n_components);
    return fields.size() - 1;
  }

  template <int dim>
  std::optional<unsigned int> WorkingSet<dim>::find_field(const std::string &name) const
  {
    for (unsigned int f = 0; f < fields.size(); ++f)
      if (fields[f].name == name)
        return f;
    return {};
  }

  template <int dim>
  void WorkingSet<dim>::add_states(const std::vector<std::string> &names)
  {
    state_fields.emplace_back();
    for (const auto &name : names)
      state_fields.back().push_back(add_field(name, 1));
  }

  template <int dim>
  void WorkingSet<dim>::resize(const unsigned int n_particles)
  {
    id.resize(n_particles);
    body.resize(n_particles);
    if (keeps_places)
      place.resize(n_particles);
    for (const auto &field : fields)
      for (unsigned int c = 0; c < field.n_components; ++c)
        columns[field.first + c].resize(n_particles, field.initial[c]);
  }

  template <int dim>
  void WorkingSet<dim>::reserve(const unsigned int n_particles)
  {
    id.reserve(n_particles);
    body.reserve(n_particles);
    for (auto &column : columns)
      reserve_column(column, n_particles);
  }

  template <int dim>
  void WorkingSet<dim>::permute(const std::vector<unsigned int> &order)
  {
    // Each takes the memory that the one before it has left: touching new memory would take longer than the copy.
    const auto reorder = [&](auto &values, auto &ordered) {
      for (unsigned int i = 0; i < order.size(); ++i)
        ordered[i] = values[order[i]];
      values.swap(ordered);
    };
    decltype(id)   ordered_id(order.size());
    decltype(body) ordered_body(order.size());
    reorder(id, ordered_id);
    reorder(body, ordered_body);
    if (keeps_places)
    {
      decltype(place) ordered_place(order.size());
      reorder(place, ordered_place);
    }
    AlignedVector<double> ordered;
    reserve_column(ordered, order.size());
    for (auto &column : columns)
    {
      ordered.resize_fast(order.size());
      reorder(column, ordered);
    }
  }

  template class WorkingSet<2>;
  template class WorkingSet<3>;
} // namespace Talus

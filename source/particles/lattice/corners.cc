#include <talus/core/exceptions.h>
#include <talus/particles/lattice/corners.h>
#include <talus/particles/particles.h>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    // How far beyond a face a corner may lie by round-off [h].
    constexpr double tolerance = 1e-9;
  } // namespace

  template <int dim>
  void Particles<dim>::update_open_places()
  {
    if (!reach.at_corners)
      return;
    is_open = box->coverage;
    // One axis after the other: true where an entry from i to i + n - 1 of this line is not active.
    const auto       &lattice = box->lattice;
    const int         size    = lattice.node.size();
    std::vector<char> is_closed(size);
    for (int i = 0; i < size; ++i)
      is_closed[i] = lattice.node[i] != lattice.missing && !box->is_active[lattice.node[i]];
    for (unsigned int d = 0; d < dim; ++d)
    {
      const std::vector<char> before = is_closed;
      for (unsigned int k = 1; k < reach.n; ++k)
        // What wraps around an end of a line comes from the tables' padding, where no stencil begins far out.
        for (int i = 0; i + static_cast<int>(k) * lattice.stride[d] < size; ++i)
          is_closed[i] |= before[i + k * lattice.stride[d]];
    }
    for (int i = 0; i < size; ++i)
      is_open[i] = is_open[i] && !is_closed[i];
    are_open_after = is_open;
    for (unsigned int d = 0; d < dim; ++d)
    {
      const std::vector<char> before = are_open_after;
      for (int i = 0; i < size; ++i)
        are_open_after[i] = before[i] && i + lattice.stride[d] < size && before[i + lattice.stride[d]];
    }
  }

  template <int dim>
  void Particles<dim>::look_at_corners(const unsigned int begin, const unsigned int end)
  {
    using Number               = Simd<native_width>;
    const auto        &lattice = box->lattice;
    const Corners<dim> corners(*this, half_edges);
    for_each_batch(begin, end, [&](const auto batch) {
      const auto r          = corners.half_edges(batch);
      const auto x          = corners.position(batch);
      auto       is_outside = Number(1.) < Number(0.), is_far = is_outside;
      Number     place = 0.; // of the lowest corner, in the tables
      for (unsigned int d = 0; d < dim; ++d)
      {
        // The farthest corner along an axis.
        Number extent = 0.;
        for (unsigned int e = 0; e < dim; ++e)
          extent += abs(r[e][d]);
        const Number lower = (x[d] - extent - lattice.origin[d]) * lattice.inverse_h[d],
                     upper = (x[d] + extent - lattice.origin[d]) * lattice.inverse_h[d];
        is_outside = is_outside | !(lower >= Number(-tolerance) & upper <= Number(lattice.n_cells[d] + tolerance));
        const Number shift = reach.shift, first = floor(max(lower, Number(0.)) - shift) - Number(lattice.first[d]),
                     last = floor(min(upper, Number(lattice.n_cells[d])) - shift) - Number(lattice.first[d]);
        is_far = is_far | !((first >= Number(0.)) & (last < Number(lattice.extent[d])) & (last - first <= Number(1.)));
        place += first * Number(lattice.stride[d]);
      }
      if (any(is_outside))
      {
        for (unsigned int l = 0; l < batch.size(); ++l)
          if (is_outside[l])
            outside = std::min(outside, batch.p + l);
      }
      else if (any(is_far) || !are_open(place))
        corners.for_each(lattice, reach.shift, batch.p, batch.p + batch.size(),
                         [&](const unsigned int, const auto &index) {
                           if (!lattice.is_in_table(index) || !box->coverage[lattice.table_index(index)])
                             needs_synchronise = true;
                           else if (!is_open[lattice.table_index(index)])
                             needs_activation = true;
                         });
    });
  }

  template <int dim>
  template <class Number>
  bool Particles<dim>::are_open(const Number &place) const
  {
    alignas(64) int places[Number::n_lanes];
    store_integers(place, places);
    char are_open = 1;
    for (const int at : places)
      are_open &= are_open_after[at];
    return are_open != 0;
  }

  template <int dim>
  void Particles<dim>::check_initial_corners(const std::vector<std::unique_ptr<Body<dim>>> &bodies)
  {
    start_relocation();
    look_at_corners(0, this->size());
    if (outside != none)
    {
      const Body<dim> &its_body = *bodies[this->body[outside]];
      throw EntryError(its_body.get_section_name(), its_body.shape->position_entry(),
                       "the domain of the body's point " +
                         to_text<dim>(Point<dim>(this->vector(this->position, outside))) +
                         " reaches beyond the grid. Move the body, or enlarge the grid.");
    }
    check_corners_are_known();
  }

  template <int dim>
  void Particles<dim>::mark_places_of_corners(std::vector<char> &is_used) const
  {
    if (reach.at_corners)
      Corners<dim>(*this, half_edges)
        .for_each(box->lattice, reach.shift, 0, this->size(),
                  [&](const unsigned int, const auto &index) { is_used[box->lattice.table_index(index)] = 1; });
  }

  template <int dim>
  void Particles<dim>::check_corners_are_known()
  {
    const auto &lattice = box->lattice;
    Corners<dim>(*this, half_edges)
      .for_each(lattice, reach.shift, 0, this->size(), [&](const unsigned int p, const auto &index) {
        AssertThrow(
          lattice.is_in_table(index) && box->coverage[lattice.table_index(index)],
          RunError("The domain of particle " + std::to_string(this->id[p]) + " at " +
                   to_text<dim>(Point<dim>(this->vector(this->position, p))) +
                   " reaches farther beyond the cells of its rank than ranks know the grid. Raise 'Layers' in " +
                   "section 'Kernel', or use fewer ranks; domains that are stretched over several cells also " +
                   "say that CPDI is at its end."));
        brings_new_nodes = brings_new_nodes || !is_open[lattice.table_index(index)];
      });
  }

#define INSTANTIATE(dim)                                                                                               \
  template void Particles<dim>::update_open_places();                                                                  \
  template void Particles<dim>::look_at_corners(const unsigned int, const unsigned int);                               \
  template void Particles<dim>::check_initial_corners(const std::vector<std::unique_ptr<Body<dim>>> &);                \
  template void Particles<dim>::mark_places_of_corners(std::vector<char> &) const;                                     \
  template void Particles<dim>::check_corners_are_known();
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Talus

#include <talus/core/batch.h>
#include <talus/grid/box_grid.h>

namespace Talus
{
  using namespace dealii;

  template <int dim>
  void BoxGrid<dim>::look(const Columns &x, const unsigned int begin, const unsigned int end, unsigned int *,
                          Found &found) const
  {
    using Number = Simd<native_width>;
    bool strays  = false;
    for_each_batch(begin, end, [&](const auto batch) {
      std::array<Number, dim> coordinate;
      const auto              find = [&] {
        auto is_outside = Number(1.) < Number(0.);
        for (unsigned int d = 0; d < dim; ++d)
        {
          coordinate[d] = (batch.load(x[d]) - lattice.origin[d]) * lattice.inverse_h[d];
          is_outside = is_outside | !(coordinate[d] >= Number(0.) & coordinate[d] < Number(lattice.n_cells[d]));
        }
        return is_outside;
      };
      auto is_outside = find();
      if (any(is_outside))
      {
        for (unsigned int l = 0; l < batch.size(); ++l)
          if (is_outside[l])
            put_on_face(x, batch.p + l);
        is_outside = find();
      }
      if (any(is_outside))
      {
        for (unsigned int l = 0; l < batch.size(); ++l)
          if (is_outside[l])
            found.outside.push_back(batch.p + l);
      }
      else if (!knows_all_stencils)
      {
        Number place     = 0.; // in the tables, a whole number below 2^31
        auto   is_beyond = Number(1.) < Number(0.);
        for (unsigned int d = 0; d < dim; ++d)
        {
          const Number index = floor(coordinate[d] - Number(reach.shift)) - Number(lattice.first[d]);
          is_beyond          = is_beyond | (index < Number(0.)) | (index >= Number(lattice.extent[d]));
          place += index * Number(lattice.stride[d]);
        }
        if (any(is_beyond))
          strays = true;
        else
        {
          alignas(64) int places[Number::n_lanes];
          store_integers(place, places);
          bool is_covered = true;
          for (const int at : places)
            is_covered = is_covered & (coverage[at] != 0);
          strays = strays || !is_covered;
        }
      }
    });
    found.strays = found.strays || strays;
  }

  template <int dim>
  void BoxGrid<dim>::put_on_face(const Columns &x, const unsigned int p) const
  {
    Tensor<1, dim> x_p;
    for (unsigned int d = 0; d < dim; ++d)
      x_p[d] = x[d][p];
    if (lattice.enter(x_p))
      for (unsigned int d = 0; d < dim; ++d)
        x[d][p] = x_p[d];
  }

  template <int dim>
  void BoxGrid<dim>::places(const Points &x, const unsigned int *, const unsigned int begin, const unsigned int end,
                            unsigned int *result) const
  {
    for (unsigned int p = begin; p < end; ++p)
    {
      int  entry    = 0;
      bool is_known = true;
      for (unsigned int d = 0; d < dim; ++d)
      {
        const double index = std::floor(lattice.coordinate(x[d][p], d) - reach.shift) - lattice.first[d];
        is_known           = is_known && index >= 0 && index < lattice.extent[d];
        entry += is_known ? static_cast<int>(index) * lattice.stride[d] : 0;
      }
      result[p - begin] = is_known && coverage[entry] ? entry : none;
    }
  }

  template <int dim>
  std::vector<Leaver> BoxGrid<dim>::leavers(const Points &x, const unsigned int *, const unsigned int n) const
  {
    std::vector<Leaver> leavers;
    for_each_batch(0, n, [&](const auto batch) {
      using Number = typename decltype(batch)::Number;
      alignas(64) int cells[dim][Number::n_lanes];
      for (unsigned int d = 0; d < dim; ++d)
        store_integers(floor((batch.load(x[d]) - lattice.origin[d]) * lattice.inverse_h[d]), cells[d]);
      for (unsigned int l = 0; l < batch.size(); ++l)
      {
        typename Lattice<dim>::Index cell;
        for (unsigned int d = 0; d < dim; ++d)
          cell[d] = cells[d][l];
        const unsigned int rank = lattice.is_in_table(cell) ? lattice.owner[lattice.table_index(cell)] : none;
        if (rank != my_rank)
          leavers.push_back({batch.p + l, rank, none});
      }
    });
    find_far_ranks(x, leavers);
    return leavers;
  }

  template <int dim>
  void BoxGrid<dim>::find_far_ranks(const Points &x, std::vector<Leaver> &leavers) const
  {
    std::vector<unsigned int> far;
    std::vector<Point<dim>>   points;
    for (unsigned int i = 0; i < leavers.size(); ++i)
      if (leavers[i].rank == none)
      {
        Point<dim> point;
        for (unsigned int d = 0; d < dim; ++d)
          point[d] = x[d][leavers[i].particle];
        far.push_back(i);
        points.push_back(lattice.inside_cell(point));
      }
    // Seldom: a particle has crossed all cells that this rank knows.
    if (Utilities::MPI::max<unsigned int>(far.size(), communicator) == 0)
      return;
    // The triangulation asks in a function that is not const.
    const auto ranks = const_cast<BoxGrid<dim> *>(this)->p4est.find_point_owner_rank(points);
    for (unsigned int i = 0; i < far.size(); ++i)
      leavers[far[i]].rank = ranks[i] < Utilities::MPI::n_mpi_processes(communicator) ? ranks[i] : none;
  }

  template <int dim>
  void BoxGrid<dim>::activate(const std::vector<char> &first, const unsigned int n)
  {
    AssertDimension(first.size(), lattice.node.size());
    // One axis after the other: true where an entry from i - n to i + 1 of this line is.
    std::vector<char> reached = first;
    for (unsigned int d = 0; d < dim; ++d)
    {
      const std::vector<char> before = reached;
      const int               stride = lattice.stride[d], size = before.size();
      for (int shift = -static_cast<int>(n); shift <= 1; ++shift)
        // What wraps around an end of a line comes from the tables' padding, where no stencil begins far out.
        for (int i = std::max(0, -shift * stride); i < size - std::max(0, shift * stride); ++i)
          reached[i] |= before[i + shift * stride];
    }

    std::vector<char> is_reached(fields.n_local());
    for (unsigned int i = 0; i < fields.n_local(); ++i)
      is_reached[i] = reached[lattice.table_index(node_index[i])];
    this->activate_nodes(std::move(is_reached));
  }

  template <int dim>
  bool BoxGrid<dim>::is_active_around(const typename Lattice<dim>::Index &first, const unsigned int n) const
  {
    unsigned int n_entries = 1;
    for (unsigned int d = 0; d < dim; ++d)
      n_entries *= n + 2;
    for (unsigned int i = 0; i < n_entries; ++i)
    {
      auto index = first;
      for (unsigned int d = 0, rest = i; d < dim; ++d, rest /= n + 2)
        index[d] += static_cast<int>(rest % (n + 2)) - 1;
      if (!lattice.is_in_table(index))
        continue;
      const unsigned int node = lattice.node[lattice.table_index(index)];
      if (node != lattice.missing && !is_active[node])
        return false;
    }
    return true;
  }

#define INSTANTIATE(dim)                                                                                               \
  template void BoxGrid<dim>::put_on_face(const Columns &, const unsigned int) const;                                  \
  template void BoxGrid<dim>::look(const Columns &, const unsigned int, const unsigned int, unsigned int *, Found &)   \
    const;                                                                                                             \
  template void BoxGrid<dim>::places(const Points &, const unsigned int *, const unsigned int, const unsigned int,     \
                                     unsigned int *) const;                                                            \
  template std::vector<Leaver> BoxGrid<dim>::leavers(const Points &, const unsigned int *, const unsigned int) const;  \
  template void                BoxGrid<dim>::activate(const std::vector<char> &, const unsigned int);                  \
  template bool BoxGrid<dim>::is_active_around(const typename Lattice<dim>::Index &, const unsigned int) const;
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Talus

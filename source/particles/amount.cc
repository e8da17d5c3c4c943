#include <talus/core/exceptions.h>
#include <talus/particles/amount.h>

#include <limits>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    /** Throws the error of a body's point outside the grid. */
    template <int dim>
    void refuse(const Grid<dim> &grid, const Body<dim> &body, const Tensor<1, dim> &x)
    {
      throw EntryError(body.get_section_name(), body.shape->position_entry(),
                       "the body's point " + to_text(x) + " lies outside the grid, " + grid.extent() +
                         ". Move the body, or enlarge the grid; 'Clip to grid = true' leaves out what lies outside.");
    }

    /** Calls count(index, point, share of it in the grid, volume) for this rank's part of the points. Collective. */
    template <int dim, class Count>
    void visit_shares(const Grid<dim> &grid, const Body<dim> &body, const Count &count)
    {
      const double n_ranks = Utilities::MPI::n_mpi_processes(grid.communicator);
      const auto   visit   = [&](const typename Shape<dim>::Visitor &visitor) {
        body.shape->visit_part(Utilities::MPI::this_mpi_process(grid.communicator), n_ranks, visitor);
      };
      if (!grid.keeps_places())
      {
        visit([&](const std::uint64_t index, Point<dim> x, const double volume) {
          const Point<dim> given = x;
          const double     share = body.is_clipped ? grid.share_inside(x) : grid.enter(x);
          count(index, given, share, volume);
        });
        return;
      }
      // Where points lie the ranks must ask each other.
      std::vector<std::pair<std::uint64_t, double>> points;
      std::vector<Point<dim>>                       places;
      visit([&](const std::uint64_t index, const Point<dim> &x, const double volume) {
        points.emplace_back(index, volume);
        places.push_back(x);
      });
      const auto are_inside = grid.are_inside(places);
      for (unsigned int i = 0; i < points.size(); ++i)
        count(points[i].first, places[i], are_inside[i] ? 1. : 0., points[i].second);
    }
  } // namespace

  template <int dim>
  Amount amount_of_shape(const Grid<dim> &grid, const Body<dim> &body)
  {
    using First = std::pair<std::uint64_t, std::array<double, dim>>; // index and place of a point
    First      outside(std::numeric_limits<std::uint64_t>::max(), {});
    Amount     amount;
    const auto count = [&](const std::uint64_t index, const Point<dim> &x, const double share, const double volume) {
      if (share > 0)
      {
        ++amount.n;
        amount.volume += share * volume;
      }
      else if (!body.is_clipped && index < outside.first)
      {
        outside.first = index;
        for (unsigned int d = 0; d < dim; ++d)
          outside.second[d] = x[d];
      }
    };
    visit_shares(grid, body, count);
    for (const auto &other : Utilities::MPI::all_gather(grid.communicator, outside))
      outside = std::min(outside, other);
    if (outside.first != std::numeric_limits<std::uint64_t>::max())
    {
      Tensor<1, dim> x;
      for (unsigned int d = 0; d < dim; ++d)
        x[d] = outside.second[d];
      refuse(grid, body, x);
    }
    amount.n      = Utilities::MPI::sum(amount.n, grid.communicator);
    amount.volume = Utilities::MPI::sum(amount.volume, grid.communicator);
    // What a mesh leaves of a point on its boundary, its rank alone can say.
    if (body.is_clipped && grid.keeps_places())
      amount.volume = std::numeric_limits<double>::quiet_NaN();
    return amount;
  }

  template <int dim>
  void check_amount(const Body<dim> &body, const Amount &created, const Amount &wanted)
  {
    if (wanted.n == 0)
      throw EntryError(body.get_section_name(), body.shape->position_entry(),
                       "the body is empty: no particle lies in it. Check its corners, its lattice offset or its "
                       "particles per cell.");
    // Sums in another order.
    constexpr double round_off = 1e-9;
    if (created.n != wanted.n || std::abs(created.volume - wanted.volume) > round_off * wanted.volume)
      throw EntryError(body.get_section_name(), body.shape->position_entry(),
                       "the body has " + std::to_string(wanted.n) + " points of volume " +
                         std::to_string(wanted.volume) + " in all, and " + std::to_string(created.n) + " of volume " +
                         std::to_string(created.volume) +
                         " would become particles. Report this input; moving the body by a thousandth of the spacing "
                         "may help until then.");
  }

#define INSTANTIATE(dim)                                                                                               \
  template Amount amount_of_shape(const Grid<dim> &, const Body<dim> &);                                               \
  template void   check_amount(const Body<dim> &, const Amount &, const Amount &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Talus

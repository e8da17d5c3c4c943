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
                       "the body's point " + to_text(x) + " lies outside the grid, which reaches from " +
                         to_text<dim>(grid.lower) + " to " + to_text<dim>(grid.upper) +
                         ". Move the body, or enlarge the grid; 'Clip to grid = true' leaves out what lies outside.");
    }
  } // namespace

  template <int dim>
  Amount amount_of_shape(const Grid<dim> &grid, const Body<dim> &body)
  {
    using First = std::pair<std::uint64_t, std::array<double, dim>>; // index and place of a point
    First        outside(std::numeric_limits<std::uint64_t>::max(), {});
    Amount       amount;
    const double n_ranks = Utilities::MPI::n_mpi_processes(grid.communicator);
    body.shape->visit_part(Utilities::MPI::this_mpi_process(grid.communicator), n_ranks,
                           [&](const std::uint64_t index, Point<dim> x, const double volume) {
                             const Point<dim> given = x;
                             const double share     = body.is_clipped ? grid.lattice.share_inside(x) :
                                                                        grid.lattice.enter(x);
                             if (share > 0)
                             {
                               ++amount.n;
                               amount.volume += share * volume;
                             }
                             else if (!body.is_clipped && index < outside.first)
                             {
                               outside.first = index;
                               for (unsigned int d = 0; d < dim; ++d)
                                 outside.second[d] = given[d];
                             }
                           });
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
    if (created.n != wanted.n || !(std::abs(created.volume - wanted.volume) <= round_off * wanted.volume))
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

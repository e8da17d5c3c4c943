#include <talus/steppers/fastest_vibration.h>

#include <deal.II/base/mpi.h>

#include <cmath>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    constexpr unsigned int n_iterations = 60;

    /** Numbers of a node: its mass, u, and K u. */
    constexpr unsigned int mass = 0, value = 1, image = 2;
    using Numbers = NodalArray<3>;

    /** Calls body(stencil, volume) for points near the vertices of this rank's cells. */
    template <int dim, class Body>
    void for_each_point(const Kernel<dim> &kernel, const Grid<dim> &grid, const Body &body)
    {
      constexpr unsigned int n = dim + 1;
      WorkingSet<dim>        points;
      points.keeps_places = true;
      points.resize(n);
      Stencil<dim> stencils[n];
      for (const auto &cell : grid.triangulation.active_cell_iterators())
      {
        if (!cell->is_locally_owned())
          continue;
        const Point<dim>   centre = cell->center();
        const unsigned int place  = grid.cell_number(centre);
        for (unsigned int q = 0; q < n; ++q)
        {
          points.place[q] = place;
          for (unsigned int d = 0; d < dim; ++d)
            points.component(points.position, d)[q] = 0.5 * (centre[d] + cell->vertex(q)[d]);
        }
        kernel.evaluate(points, 0, n, stencils);
        for (const auto &stencil : stencils)
          body(stencil, cell->measure() / n);
      }
    }

    /** u <- K u / m of this rank's nodes, and the new norm of u over the old one, squared, in the metric m. */
    template <int dim>
    double iterate(const Kernel<dim> &kernel, const Grid<dim> &grid, const double smallest, Numbers &numbers)
    {
      for (unsigned int i = 0; i < numbers.n_local(); ++i)
        numbers[i][image] = 0;
      for_each_point(kernel, grid, [&](const Stencil<dim> &stencil, const double V) {
        Tensor<1, dim> gradient;
        for (unsigned int k = 0; k < stencil.size; ++k)
          for (unsigned int d = 0; d < dim; ++d)
            gradient[d] += stencil.gradient[d][k] * numbers.at_place(stencil.place[k])[value];
        for (unsigned int k = 0; k < stencil.size; ++k)
          for (unsigned int d = 0; d < dim; ++d)
            numbers.at_place(stencil.place[k])[image] += V * stencil.gradient[d][k] * gradient[d];
      });
      // Masses and values of copies are not to be added.
      for (unsigned int i = numbers.n_owned(); i < numbers.n_local(); ++i)
        numbers[i][mass] = numbers[i][value] = 0;
      numbers.add_copies_to_owners();
      double before = 0, after = 0;
      for (unsigned int i = 0; i < numbers.n_owned(); ++i)
      {
        double      *node = numbers[i];
        const double m    = node[mass];
        before += m > smallest ? m * node[value] * node[value] : 0.;
        node[value] = m > smallest ? node[image] / m : 0.;
        after += m > smallest ? m * node[value] * node[value] : 0.;
      }
      before = Utilities::MPI::sum(before, grid.communicator);
      after  = Utilities::MPI::sum(after, grid.communicator);
      for (unsigned int i = 0; i < numbers.n_owned(); ++i)
        numbers[i][value] /= std::sqrt(after);
      numbers.update_copies();
      return after / before;
    }
  } // namespace

  template <int dim>
  double fastest_vibration(const Kernel<dim> &kernel, const Grid<dim> &grid)
  {
    Numbers numbers;
    numbers.reinit(grid.nodes);
    for_each_point(kernel, grid, [&](const Stencil<dim> &stencil, const double V) {
      for (unsigned int k = 0; k < stencil.size; ++k)
        numbers.at_place(stencil.place[k])[mass] += V * stencil.weight[k];
    });
    numbers.add_copies_to_owners();
    double largest = 0;
    for (unsigned int i = 0; i < numbers.n_owned(); ++i)
    {
      largest = std::max(largest, numbers[i][mass]);
      // Something of all wave lengths.
      double angle = 1;
      for (unsigned int d = 0; d < dim; ++d)
        angle += (97 + 40 * d) * grid.node_position(i)[d] * grid.inverse_spacing[d];
      numbers[i][value] = std::sin(angle);
    }
    // A node at the edge of a mesh may have next to nothing, or less.
    const double smallest = 1e-3 * Utilities::MPI::max(largest, grid.communicator);
    numbers.update_copies();
    double square = 0; // omega^4 / c^4
    for (unsigned int n = 0; n < n_iterations; ++n)
      square = iterate(kernel, grid, smallest, numbers);
    return std::pow(square, 0.25);
  }

  template double fastest_vibration(const Kernel<2> &, const Grid<2> &);
  template double fastest_vibration(const Kernel<3> &, const Grid<3> &);
} // namespace Talus

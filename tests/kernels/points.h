#pragma once

#include "../setup.h"

#include <random>

namespace Test
{
  /** A grid and a kernel, and stencils at any points of this rank's cells. */
  template <int dim>
  class KernelSetup : public Setup<dim>
  {
  public:
    KernelSetup(const std::string &kernel, const std::string &treatment) :
      Setup<dim>(skewed_grid<dim>({{6, 5, 4}}) + kernel_text(kernel, treatment))
    {
      set.resize(1);
    }

    Stencil<dim> at(const dealii::Point<dim> &x)
    {
      for (unsigned int d = 0; d < dim; ++d)
        set.component(set.position, d)[0] = x[d];
      Stencil<dim> stencil;
      this->kernel->evaluate(set, 0, 1, &stencil);
      return stencil;
    }

    /** The point with coordinates `local` in [0, 1] within a cell. */
    dealii::Point<dim> in_cell(const typename Grid<dim>::CellIterator &cell, const std::array<double, dim> &local) const
    {
      dealii::Point<dim> x = cell->vertex(0);
      for (unsigned int d = 0; d < dim; ++d)
      {
        // The domain is half open: the upper wall itself is outside.
        x[d] += local[d] * this->grid.lattice.h[d];
        while (this->grid.lattice.coordinate(x[d], d) >= this->grid.lattice.n_cells[d])
          x[d] = std::nextafter(x[d], this->grid.lower[d]);
      }
      return x;
    }

    /** True in the cells of this rank, which knows all nodes of their kernels; a face belongs to the upper cell. */
    bool is_local(const dealii::Point<dim> &x) const
    {
      const auto                  &lattice = this->grid.lattice;
      typename Lattice<dim>::Index cell;
      for (unsigned int d = 0; d < dim; ++d)
        cell[d] = static_cast<int>(std::floor(lattice.coordinate(x[d], d)));
      return lattice.is_in_table(cell) && this->grid.owns_cell(lattice.table_index(cell));
    }

    template <class Visitor>
    void for_cells(const Visitor &visitor) const
    {
      for (const auto &cell : this->grid.triangulation.active_cell_iterators())
        if (cell->is_locally_owned())
          visitor(cell);
    }

    /** Points anywhere in the cells, and all combinations of walls, knots and points between. */
    template <class Visitor>
    void for_points(const Visitor &visitor)
    {
      const std::vector<double> special = {0, 1e-13, 0.25, 0.375, 0.5, 0.75, 1};
      unsigned int              n       = 1;
      for (unsigned int d = 0; d < dim; ++d)
        n *= special.size();
      for_cells([&](const auto &cell) {
        std::array<double, dim> local;
        for (unsigned int i = 0; i < n; ++i)
        {
          for (unsigned int d = 0, rest = i; d < dim; ++d, rest /= special.size())
            local[d] = special[rest % special.size()];
          const auto x = in_cell(cell, local);
          if (is_local(x))
            visitor(x);
        }
      });
      for_generic_points(20, visitor);
    }

    /** Random points that keep away from all knots (multiples of h/4) by h/80. */
    template <class Visitor>
    void for_generic_points(const unsigned int n, const Visitor &visitor)
    {
      for_cells([&](const auto &cell) {
        std::array<double, dim> local;
        for (unsigned int i = 0; i < n; ++i)
        {
          for (double &l : local)
            l = (static_cast<int>(4 * uniform(random)) + 0.05 + 0.9 * uniform(random)) / 4;
          visitor(in_cell(cell, local));
        }
      });
    }

    /** True where some node of the kernel's support lies beyond the domain. */
    bool is_near_boundary(const dealii::Point<dim> &x, const double support) const
    {
      bool is_near = false;
      for (unsigned int d = 0; d < dim; ++d)
      {
        const double c = this->grid.lattice.coordinate(x[d], d);
        is_near        = is_near || c < support || c > this->grid.lattice.n_cells[d] - support;
      }
      return is_near;
    }

  private:
    WorkingSet<dim>                        set;
    std::mt19937                           random{7};
    std::uniform_real_distribution<double> uniform;
  };
} // namespace Test

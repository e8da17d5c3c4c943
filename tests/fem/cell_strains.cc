#include <talus/fem/cell_strains.h>

#include "check.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/mapping_q.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria.h>

using namespace dealii;
using namespace Talus;

namespace
{
  /** One skewed cell, away from the origin. */
  template <int dim>
  void make_cell(Triangulation<dim> &triangulation)
  {
    GridGenerator::hyper_cube(triangulation, .5, 1.5);
    GridTools::transform(
      [](Point<dim> x) {
        x[0] += .3 * x[1] + .2 * x[0] * x[dim - 1];
        x[1] += .1 * x[0] * x[1];
        return x;
      },
      triangulation);
  }

  template <int dim>
  void check_projection()
  {
    const std::string  name = std::to_string(dim) + "D ";
    Triangulation<dim> triangulation;
    make_cell(triangulation);
    const MappingQ<dim> mapping(2);
    const FESystem<dim> fe(FE_Q<dim>(2), dim);
    DoFHandler<dim>     dof_handler(triangulation);
    dof_handler.distribute_dofs(fe);
    const QGauss<dim> gauss(3);
    CellStrains<dim>  full(mapping, fe, gauss, false), projected(mapping, fe, gauss, true);
    const auto        cell = dof_handler.begin_active();
    full.reinit(cell);
    projected.reinit(cell);
    projected.reinit(cell); // nothing may be left from the cell before
    FEValues<dim> fe_values(mapping, fe, gauss, update_quadrature_points);
    fe_values.reinit(cell);

    double deviators = 0., orthogonality = 0., difference = 0.;
    for (unsigned int i = 0; i < full.n_dofs; ++i)
    {
      std::vector<double> moments(dim + 1, 0.);
      for (unsigned int q = 0; q < full.n_points; ++q)
      {
        const auto change = projected(i, q) - full(i, q);
        deviators         = std::max(deviators, deviator(change).norm());
        difference        = std::max(difference, std::abs(trace(change)));
        for (unsigned int a = 0; a <= dim; ++a)
          moments[a] += trace(change) * full.JxW(q) * (a == 0 ? 1. : fe_values.quadrature_point(q)[a - 1]);
      }
      for (const double moment : moments)
        orthogonality = std::max(orthogonality, std::abs(moment));
    }
    // Shape functions' gradients are of order one here.
    Test::check(name + "deviators stay", deviators, 1e-14);
    Test::check(name + "what is dropped is orthogonal to 1, x, y, z", orthogonality, 1e-13);
    Test::check_true(name + "something is dropped", difference > .1);

    std::map<types::global_dof_index, Point<dim>> positions;
    DoFTools::map_dofs_to_support_points(mapping, dof_handler, positions);
    std::vector<types::global_dof_index> dofs(full.n_dofs);
    cell->get_dof_indices(dofs);
    double affine = 0.;
    for (unsigned int q = 0; q < full.n_points; ++q)
    {
      SymmetricTensor<2, 3> strain;
      for (unsigned int i = 0; i < full.n_dofs; ++i)
      {
        const auto x = positions.at(dofs[i]);
        strain += (fe.system_to_component_index(i).first == 0 ? 2. * x[0] + x[1] : 3. * x[dim - 1]) * projected(i, q);
      }
      // u = (2x + y, 3y) in 2D; (2x + y, 3z, 3z) in 3D.
      SymmetricTensor<2, 3> exact;
      exact[0][0]             = 2.;
      exact[0][1]             = .5;
      exact[dim - 1][dim - 1] = 3.;
      if (dim == 3)
        exact[1][2] = 1.5;
      affine = std::max(affine, (strain - exact).norm());
    }
    Test::check(name + "uniform strain stays", affine, 1e-12);
  }

  /** On the unit square u = (x^2 y/2, 0) is in Q2; its div u = x y goes to (x + y)/2 - 1/4. */
  void check_unit_square()
  {
    Triangulation<2> triangulation;
    GridGenerator::hyper_cube(triangulation);
    const MappingQ<2> mapping(2);
    const FESystem<2> fe(FE_Q<2>(2), 2);
    DoFHandler<2>     dof_handler(triangulation);
    dof_handler.distribute_dofs(fe);
    const QGauss<2> gauss(3);
    CellStrains<2>  strains(mapping, fe, gauss, true);
    strains.reinit(dof_handler.begin_active());
    double error = 0.;
    for (unsigned int q = 0; q < gauss.size(); ++q)
    {
      double divergence = 0.;
      for (unsigned int i = 0; i < strains.n_dofs; ++i)
      {
        const Point<2> x = fe.unit_support_point(i);
        if (fe.system_to_component_index(i).first == 0)
          divergence += .5 * x[0] * x[0] * x[1] * trace(strains(i, q));
      }
      const Point<2> x = gauss.point(q);
      error            = std::max(error, std::abs(divergence - (.5 * (x[0] + x[1]) - .25)));
    }
    Test::check("x y is projected to (x + y)/2 - 1/4", error, 1e-14);
  }
} // namespace

void cell_strains()
{
  check_projection<2>();
  check_projection<3>();
  check_unit_square();
}

// What deal.II takes for a box of 2^n x 2^n cells alone, its triangulation and degrees of freedom: bare_grid [n].
#include <deal.II/distributed/tria.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/grid/grid_generator.h>

#include <iostream>

int main(int argc, char **argv)
{
  using namespace dealii;
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const unsigned int               n_refinements = argc > 1 ? std::stoi(argv[1]) : 10;

  parallel::distributed::Triangulation<2> triangulation(
    MPI_COMM_WORLD, Triangulation<2>::none, parallel::distributed::Triangulation<2>::communicate_vertices_to_p4est);
  GridGenerator::hyper_cube(triangulation);
  triangulation.refine_global(n_refinements);
  FE_Q<2>       fe(1);
  DoFHandler<2> dof_handler(triangulation);
  dof_handler.distribute_dofs(fe);
  std::cout << triangulation.n_global_active_cells() << " cells, " << dof_handler.n_dofs() << " nodes\n";
}

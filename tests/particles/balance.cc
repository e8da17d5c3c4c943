#include "../setup.h"

using namespace Test;
using namespace dealii;

/** Material decides who gets which cells: particles in a corner of a grid that is empty elsewhere are shared out. */
template <int dim>
void balance()
{
  const int    n = dim == 2 ? 32 : 16; // cells along an axis, of which a quarter is filled
  Setup<dim>   setup(section("Grid", set("Cells", coordinates<dim>({{1. * n, 1. * n, 1. * n}}))) +
                     section("Materials", set("Names", "soft") + section("soft", "")) +
                     section("Bodies", set("Names", "corner") +
                                         section("corner", set("Upper corner", coordinates<dim>({{0.25, 0.25, 0.25}})))));
  const double n_ranks = Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD), share = setup.particles.n_global / n_ranks;
  // p4est keeps the 2^dim children of a cell together: their particles are what a rank may have too much.
  check("particles beyond a rank's share", max(setup.particles.size() - share) / std::pow(4, dim), 1.);
}

template void balance<2>();
template void balance<3>();

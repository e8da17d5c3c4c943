#include "../check.h"
#include "meshes.h"

#include <talus/grid/mesh_walk.h>

using namespace Talus;

namespace
{
  using namespace Test;

  template <int dim>
  bool is_in(const Mesh<dim> &mesh, const unsigned int cell, const Coordinates<dim> &x)
  {
    if (cell == mesh.missing)
      return false;
    const auto B = mesh.barycentric(cell, x.data());
    return *std::min_element(B.begin(), B.end()) >= -barycentric_tolerance;
  }

  /** Moves particles at random, a step that leaves the mesh is not made; each must be known in the cell it is in. */
  template <int dim>
  void move_particles(const std::string &name, const Mesh<dim> &mesh, const unsigned int n_particles,
                      const unsigned int n_moves, const double longest_step)
  {
    const CellFinder<dim>                  finder(mesh);
    std::mt19937                           random(8);
    std::uniform_int_distribution<int>     any_cell(0, mesh.n_cells() - 1);
    std::uniform_real_distribution<double> step(-longest_step, longest_step);
    std::vector<Coordinates<dim>>          positions;
    std::vector<unsigned int>              cells;
    unsigned int                           n_wrong = 0, n_left = 0, n_recovered = 0;
    for (unsigned int p = 0; p < n_particles; ++p)
    {
      positions.push_back(point(mesh, any_cell(random), barycentric<dim>(random)));
      cells.push_back(finder.find(positions[p].data()));
      n_wrong += !is_in(mesh, cells[p], positions[p]);
    }
    check_true(name + ": first location", n_wrong == 0);
    for (unsigned int move = 0; move < n_moves; ++move)
      for (unsigned int p = 0; p < n_particles; ++p)
      {
        auto x = positions[p];
        for (double &c : x)
          c += step(random);
        const unsigned int cell = finder.find_from(cells[p], x.data());
        if (cell == mesh.missing)
        {
          // Really outside? The hash grid says so without the walk, and some by all cells.
          n_wrong += finder.find(x.data()) != mesh.missing;
          for (unsigned int c = 0; p % 1000 == 0 && c < mesh.n_cells(); ++c)
            n_wrong += is_in(mesh, c, x);
          ++n_left;
          continue;
        }
        n_recovered += !walk(mesh, cells[p], x.data()).is_found;
        n_wrong += !is_in(mesh, cell, x);
        positions[p] = x;
        cells[p]     = cell;
      }
    check_true(name + ": each is in its cell", n_wrong == 0);
    check_true(name + ": some steps went outside", n_left > 0);
    std::cout << "  " << n_left << " steps outside, " << n_recovered << " recovered by the hash grid\n";
  }
} // namespace

/** Points anywhere, in all cells, on faces, edges and vertices; against all cells. */
template <int dim>
void location()
{
  for (const auto &[name, mesh] : meshes<dim>())
  {
    const CellFinder<dim>              finder(mesh);
    unsigned int                       n_wrong = 0, n_lost = 0;
    std::mt19937                       random(6);
    std::uniform_int_distribution<int> any_cell(0, mesh.n_cells() - 1);
    for_points(mesh, 2, [&, &mesh = mesh](const unsigned int, const Coordinates<dim> &x) {
      n_wrong += !is_in(mesh, finder.find(x.data()), x);
      n_wrong += !is_in(mesh, finder.find_from(any_cell(random), x.data()), x);
    });
    check_true(name + ": points in cells and on faces", n_wrong == 0);

    std::uniform_real_distribution<double> uniform(-.1, 1.1);
    for (unsigned int i = 0; i < 500; ++i)
    {
      Coordinates<dim> x;
      for (double &c : x)
        c = uniform(random);
      bool is_anywhere = false;
      for (unsigned int c = 0; c < mesh.n_cells(); ++c)
        is_anywhere = is_anywhere || is_in(mesh, c, x);
      n_lost += is_in(mesh, finder.find(x.data()), x) != is_anywhere;
      n_lost += is_in(mesh, finder.find_from(any_cell(random), x.data()), x) != is_anywhere;
    }
    check_true(name + ": points anywhere", n_lost == 0);
  }
  move_particles("gmsh", mesh_of(gmsh<dim>()), 1000, 20, .1);
}

template <int dim>
void many_particles()
{
  move_particles("gmsh", mesh_of(gmsh<dim>()), 100000, 1000, .1);
}

template void location<2>();
template void location<3>();
template void many_particles<3>();

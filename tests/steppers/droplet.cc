#include "../setup.h"

#include <set>

using namespace Test;
using namespace dealii;

/**
 * A droplet of about 1000 particles moves by a spacing above a sea of 10^6 (2D) or 10^5 (3D): what activation writes
 * are nodes near the droplet, and the sea's keep their marks and numbers.
 */
template <int dim>
void droplet()
{
  const double      width = dim == 2 ? 1000 : 50, depth = dim == 2 ? 250 : 5, size = dim == 2 ? 16 : 5;
  const std::string box     = set("Particles per cell and direction", "2");
  const auto        corners = [&](const std::array<double, 3> &lower, const std::array<double, 3> &upper) {
    return set("Lower corner", coordinates<dim>(lower)) + set("Upper corner", coordinates<dim>(upper));
  };
  // The last axis points up.
  std::array<double, 3> top = {{width, width, width}}, surface = top, low = {{20, 20, 20}}, high;
  top[dim - 1]     = depth + 40;
  surface[dim - 1] = depth;
  low[dim - 1]     = depth + 12;
  for (unsigned int d = 0; d < 3; ++d)
    high[d] = low[d] + size;
  Setup<dim> s(section("Grid", set("Upper corner", coordinates<dim>(top)) + set("Spacing", "1")) +
               section("Materials", set("Names", "water") +
                                      section("water", set("Type", "Newtonian fluid") + set("Sound speed", "10"))) +
               section("Bodies", set("Names", "sea, droplet") + section("sea", box + corners({{0, 0, 0}}, surface)) +
                                   section("droplet", box + corners(low, high))));
  auto      &grid      = s.grid;
  auto      &particles = s.particles;
  grid.activate(particles.used_places());
  for (unsigned int i = 0; i < grid.fields.n_local(); ++i)
    if (grid.is_active[i])
      grid.fields[i][0] = 17;
  const auto before = grid.is_active;

  std::set<unsigned int> near;
  double                 n_droplet = 0;
  for (unsigned int p = 0; p < particles.size(); ++p)
    if (particles.body[p] == 1)
    {
      const auto stencil = s.stencil(p);
      for (unsigned int k = 0; k < stencil.size; ++k)
        near.insert(s.node(stencil, k));
      particles.component(particles.position, 0)[p] += 1;
      ++n_droplet;
    }
  grid.activate(particles.used_places());

  const double n_near = sum(near.size());
  check_range("particles of the droplet", sum(n_droplet), 1000, 1024);
  check_range("nodes that activation wrote, of those near the droplet", sum(grid.n_changed_nodes) / n_near, 1e-3, 2);
  double changed = 0, touched = 0;
  for (unsigned int i = 0; i < grid.fields.n_local(); ++i)
  {
    const bool is_above = grid.node_position(i)[dim - 1] > depth + 5;
    changed += !is_above && grid.is_active[i] != before[i];
    touched += !is_above && grid.fields[i][0] != (before[i] ? 17 : 0);
  }
  check("the sea's marks", sum(changed), 0.5);
  check("the sea's numbers", sum(touched), 0.5);
}

template void droplet<2>();
template void droplet<3>();

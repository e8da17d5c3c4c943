#include "skewed_box.h"

using namespace Test;
using namespace dealii;

/** Every node has one owner; positions follow from the indices; a rank numbers its own nodes along x first. */
template <int dim>
void nodes()
{
  const auto  s    = setup<dim>();
  const auto &grid = s.grid;
  check("number of owned nodes", sum(grid.fields.n_owned()) - total_nodes<dim>(), 0.5);
  double position_error = 0;
  bool   is_sorted      = true;
  for (unsigned int i = 0; i < grid.fields.n_local(); ++i)
  {
    for (unsigned int d = 0; d < dim; ++d)
      raise(position_error, grid.node_position(i)[d] - lower[d] - grid.node_index[i][d] * h[d]);
    if (i > 0 && i < grid.fields.n_owned())
      is_sorted =
        is_sorted && std::lexicographical_compare(grid.node_index[i - 1].rbegin(), grid.node_index[i - 1].rend(),
                                                  grid.node_index[i].rbegin(), grid.node_index[i].rend());
  }
  check("positions", position_error, 1e-14);
  check_true("owned nodes are in lexicographic order", is_sorted);
}

/** The tables agree with the triangulation: vertices and centres of this rank's cells. */
template <int dim>
void tables()
{
  const auto   s           = setup<dim>();
  const auto  &lattice     = s.grid.lattice;
  bool         nodes_agree = true, cells_agree = true;
  unsigned int n_cells = 0;
  for (const auto &cell : s.grid.triangulation.active_cell_iterators())
    if (cell->is_locally_owned())
    {
      ++n_cells;
      typename Lattice<dim>::Index index;
      for (unsigned int d = 0; d < dim; ++d)
        index[d] = static_cast<int>(std::floor(lattice.coordinate(cell->center()[d], d)));
      cells_agree = cells_agree && s.grid.owns_cell(lattice.table_index(index));
      for (const unsigned int v : cell->vertex_indices())
      {
        auto corner = index;
        for (unsigned int d = 0; d < dim; ++d)
          corner[d] += (v >> d) % 2;
        const unsigned int node = lattice.node[lattice.table_index(corner)];
        nodes_agree =
          nodes_agree && node != lattice.missing && s.grid.node_position(node).distance(cell->vertex(v)) < 1e-14;
      }
    }
  unsigned int n_known = 0, n_known_cells = 0;
  for (const unsigned int node : lattice.node)
    n_known += node != lattice.missing;
  for (unsigned int place = 0; place < lattice.owner.size(); ++place)
    n_known_cells += s.grid.owns_cell(place);
  check_true("cells", cells_agree);
  check_true("nodes", nodes_agree);
  check_true("no more nodes than known", n_known == s.grid.fields.n_local());
  check_true("no more cells than owned", n_known_cells == n_cells);
}

template <int dim>
void boundary_nodes()
{
  const auto s = setup<dim>();
  for (unsigned int id = 0; id < 2 * dim; ++id)
  {
    const auto         list  = s.grid.nodes_on_boundary(id);
    const unsigned int axis  = id / 2;
    double             error = 0;
    for (const unsigned int i : list)
      raise(error, s.grid.node_position(i)[axis] - lower[axis] - (id % 2) * cells[axis] * h[axis]);
    const std::string name = "boundary " + std::to_string(id);
    check(name + ": number", sum(list.size()) - total_nodes<dim>() / (cells[axis] + 1), 0.5);
    check(name + ": position", error, 1e-14);
  }
  Point<dim> a, b;
  for (unsigned int d = 0; d < dim; ++d)
  {
    a[d] = lower[d] + 0.5 * h[d];
    b[d] = lower[d] + 2.5 * h[d];
  }
  check("nodes in a box: 2 per direction", sum(s.grid.nodes_in_box(a, b).size()) - std::pow(2, dim), 0.5);
  // The edges of a box have a tolerance of a millionth of the spacing.
  for (const double beyond : {0., 0.9e-6, 2e-6, 1e-3})
  {
    for (unsigned int d = 0; d < dim; ++d)
    {
      a[d] = lower[d] + (1 + beyond) * h[d];
      b[d] = lower[d] + (2 - beyond) * h[d];
    }
    check("nodes in a box that ends " + std::to_string(beyond) + " short of them",
          sum(s.grid.nodes_in_box(a, b).size()) - (beyond < 1e-6 ? std::pow(2, dim) : 0), 0.5);
  }
}

/** v = p/m + dt f/m; nodes at or below the floor get v = 0 and their momentum and impulse are counted. */
template <int dim>
void velocity_update()
{
  auto s            = setup<dim>();
  using Fields      = NodalFields<dim>;
  s.grid.mass_floor = 1e-6;
  double error      = 0;
  for (unsigned int i = 0; i < s.grid.fields.n_owned(); ++i)
  {
    double *node       = s.grid.fields[i];
    node[Fields::mass] = i % 3 == 0 ? 2. : i % 3 == 1 ? 1e-6 : 0.;
    for (unsigned int d = 0; d < dim; ++d)
    {
      node[Fields::momentum + d] = 0.3 + d;
      node[Fields::force + d]    = 5. - d;
    }
  }
  s.grid.update_velocity(0.1);
  unsigned int n_empty = 0;
  for (unsigned int i = 0; i < s.grid.fields.n_owned(); ++i)
  {
    n_empty += i % 3 != 0;
    for (unsigned int d = 0; d < dim; ++d)
    {
      const double *node = s.grid.fields[i];
      raise(error, node[Fields::velocity + d] - (i % 3 == 0 ? (0.3 + d) / 2 + 0.1 * (5. - d) / 2 : 0.));
      raise(error, node[Fields::increment + d] - (i % 3 == 0 ? 0.1 * (5. - d) / 2 : 0.));
    }
  }
  check("velocities", error, 1e-15);
  for (unsigned int d = 0; d < dim; ++d)
    check("lost momentum " + std::to_string(d), s.grid.lost_momentum[d] - n_empty * (0.3 + d + 0.1 * (5. - d)), 1e-12);
}

/**
 * Active are the nodes of the stencils that begin at some places, whichever rank knows the place, and those one before
 * and one after that a rank with the place knows: the others its particles do not reach before they migrate. Clearing
 * zeros the active ones and the velocity update fills them, and no others.
 */
template <int dim>
void activity()
{
  constexpr unsigned int n    = 3;
  auto                   s    = setup<dim>();
  auto                  &grid = s.grid;
  using Index                 = typename Lattice<dim>::Index;
  check("all are active at first", sum(grid.active_nodes.size()) - total_nodes<dim>(), 0.5);

  // One place in the middle and one at the upper corner; only ranks that own a cell there say so.
  std::vector<Index> places(2);
  places[0].fill(1);
  for (unsigned int d = 0; d < dim; ++d)
    places[1][d] = cells[d] - 1;
  std::vector<char> first(grid.lattice.node.size(), 0);
  const auto        is_around = [&](const unsigned int i, const Index &place, const int margin) {
    for (unsigned int d = 0; d < dim; ++d)
      if (grid.node_index[i][d] < place[d] - margin || grid.node_index[i][d] >= place[d] + static_cast<int>(n) + margin)
        return false;
    return true;
  };
  grid.fields.clear();
  for (const Index &place : places)
    if (grid.lattice.is_in_table(place) && grid.owns_cell(grid.lattice.table_index(place)))
    {
      first[grid.lattice.table_index(place)] = 1;
      for (unsigned int i = 0; i < grid.fields.n_local(); ++i)
        grid.fields[i][0] += is_around(i, place, 1);
    }
  grid.fields.add_copies_to_owners();
  grid.fields.update_copies();
  std::vector<bool> is_near;
  for (unsigned int i = 0; i < grid.fields.n_local(); ++i)
    is_near.push_back(grid.fields[i][0] > 0);
  for (unsigned int i = 0; i < grid.fields.n_local(); ++i)
    grid.fields[i][0] = 17;
  grid.activate(first, n);

  double wrong = 0;
  for (unsigned int i = 0; i < grid.fields.n_local(); ++i)
  {
    const bool is_in_stencil = is_around(i, places[0], 0) || is_around(i, places[1], 0);
    const bool is_listed     = std::binary_search(grid.active_nodes.begin(), grid.active_nodes.end(), i);
    wrong += is_near[i] != grid.is_active[i];
    wrong += is_in_stencil && !grid.is_active[i];
    wrong += i < grid.fields.n_owned() && is_near[i] != is_listed;
    wrong += grid.fields[i][0] != (grid.is_active[i] ? 17 : 0);
  }
  check("active nodes, and zeros elsewhere alone", wrong, 0.5);

  for (unsigned int i = 0; i < grid.fields.n_local(); ++i)
    for (unsigned int lane = 0; lane < grid.fields.stride; ++lane)
      grid.fields[i][lane] = 2;
  grid.update_velocity(0.5);
  for (unsigned int i = 0; i < grid.fields.n_owned(); ++i)
    wrong += grid.fields[i][NodalFields<dim>::velocity] != (grid.is_active[i] ? 1.5 : 2.);
  check("velocity update", wrong, 0.5);
  grid.clear();
  for (unsigned int i = 0; i < grid.fields.n_local(); ++i)
    wrong += grid.fields[i][NodalFields<dim>::force] != (grid.is_active[i] || i >= grid.fields.n_owned() ? 0. : 2.);
  check("clear", wrong, 0.5);
}

template <int dim>
void grid_errors()
{
  const std::string cells_entry = set("Cells", coordinates<dim>({{4, 4, 4}}));
  const auto        error       = [](const std::string &name, const std::string &content, const std::string &entry,
                        const std::string &message) {
    check_error<EntryError>(name, {"/Grid: " + entry, message}, [&] { Setup<dim> s(section("Grid", content)); });
  };
  error("no spacing", "", "Spacing", "either 'Spacing' or 'Cells'");
  error("spacing and cells", set("Spacing", "0.25") + cells_entry, "Spacing", "not both");
  error("too few cell counts", set("Cells", "4"), "Cells", "give " + std::to_string(dim) + " numbers");
  error("empty box", cells_entry + set("Upper corner", coordinates<dim>({{1, 0, 1}})), "Upper corner",
        "above the lower");
  error("spacing does not divide", set("Spacing", "0.3"), "Spacing", "3.333333 spacings long in direction x");
  error("zero spacing", set("Spacing", "0"), "Spacing", "must be positive");
  // More than memory holds, and more than a number holds.
  error("spacing that is far too small", set("Spacing", "1e-9"), "Spacing", "cells long in direction x, too many");
  error("spacing beyond 32 bits", set("Spacing", "1e-10"), "Spacing", "cells long in direction x, too many");
  error("spacing of no number", set("Spacing", "1e-300"), "Spacing", "Take a larger spacing or a smaller box.");
  error("cells beyond memory", set("Cells", coordinates<dim>({{1 << 26, 1 << 26, 1 << 26}})), "Cells", "GB of memory");
  error("long box", set("Spacing", "1") + set("Upper corner", coordinates<dim>({{3e8, 50, 50}})), "Spacing",
        "GB of memory");
  check_error<InputError>("tables beyond 31 bits", {"more than 2^31 places", "more ranks"}, [] {
    Lattice<dim>                 lattice;
    typename Lattice<dim>::Index lower, upper;
    lower.fill(0);
    upper.fill(dim == 2 ? 50000 : 1500);
    lattice.resize_tables(lower, upper);
  });
  Setup<dim> s(section("Grid", set("Spacing", coordinates<dim>({{0.25, 0.5, 1}}))));
  bool       is_right = true;
  for (unsigned int d = 0; d < dim; ++d)
    is_right = is_right && s.grid.lattice.n_cells[d] == (4 >> d);
  check_true("a spacing for each direction", is_right);
}

#define INSTANTIATE(name)                                                                                              \
  template void name<2>();                                                                                             \
  template void name<3>();
INSTANTIATE(nodes)
INSTANTIATE(tables)
INSTANTIATE(boundary_nodes)
INSTANTIATE(velocity_update)
INSTANTIATE(activity)
INSTANTIATE(grid_errors)

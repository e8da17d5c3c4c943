#include "on_mesh.h"

#include <set>

using namespace Test;

/** A box cut into simplices: cells, volume, and its faces with their normals, on all ranks together. */
template <int dim>
void generated_mesh()
{
  const OnMesh<dim> run(box_of_simplices<dim>() + section("Kernel", set("Type", "P1")));
  const double      n_boxes = dim == 2 ? 12 : 24;
  check("cells", run.grid.triangulation.n_global_active_cells() - n_boxes * (dim == 2 ? 2 : 6), 0.5);
  check("nodes", sum(run.grid.fields.n_owned()) - (dim == 2 ? 20 : 60), 0.5);
  check("smallest height", run.grid.smallest_spacing - 0.5 / std::sqrt(2.), 1e-14);
  const unsigned int n[] = {5, 4, 3};
  for (unsigned int id = 0; id < 2 * dim; ++id)
  {
    const unsigned int axis    = id / 2;
    const std::string  name    = std::string(id % 2 == 0 ? "lower " : "upper ") + "xyz"[axis];
    const auto         part    = run.grid.boundary(name);
    double             n_nodes = 1, error = 0;
    for (unsigned int d = 0; d < dim; ++d)
      n_nodes *= d == axis ? 1 : n[d];
    check(name + ": nodes", sum(part.nodes.size()) - n_nodes, 0.5);
    for (unsigned int k = 0; k < part.nodes.size(); ++k)
    {
      auto normal = part.normals[k][0];
      normal[axis] -= id % 2 == 0 ? -1 : 1;
      raise(error, normal.norm() + (part.normals[k].size() - 1.));
      const double at = id % 2 == 0 ? 0 : (n[axis] - 1) * 0.5;
      raise(error, run.grid.node_position(part.nodes[k])[axis] - at);
    }
    check(name + ": normals", max(error), 1e-14);
  }
  check_error<InputError>("no such face", {"no boundary 'floor'", "'lower x' (0)"},
                          [&] { run.grid.boundary("floor"); });
}

/** A body fills a mesh: each point becomes one particle, in the cell that holds it, on one rank; moves keep all that.
 */
template <int dim>
void particles_on_a_mesh()
{
  for (const bool is_generated : {true, false})
  {
    // Points lie on faces of generated cells as well; the plate of gmsh has a hole in the middle.
    OnMesh<dim> run(
      (is_generated ? box_of_simplices<dim>() : gmsh_grid<dim>()) +
      body_text(
        set("Lower corner", is_generated ? coordinates<dim>({{0.5, 0, 0}}) : coordinates<dim>({{0.4, 0.05, 0.05}})) +
        set("Upper corner", is_generated ? coordinates<dim>({{1.5, 1, 1}}) : coordinates<dim>({{0.6, 0.25, 0.25}}))) +
      section("Kernel", set("Type", "UMLS")));
    const std::string name = is_generated ? "generated" : "gmsh";
    const double      n    = 4; // points per axis
    check(name + ": particles", run.particles.n_global - std::pow(n, dim), 0.5);
    double volume = 0;
    for (unsigned int p = 0; p < run.particles.size(); ++p)
      volume += run.particles.component(run.particles.volume, 0)[p];
    check(name + ": volume", sum(volume) - std::pow(is_generated ? 1. : 0.2, dim), 1e-13);
    check_true(name + ": places", run.places_hold());

    run.grid.activate(run.particles.used_places());
    unsigned int n_sent = 0;
    for (unsigned int round = 0; round < 20; ++round)
    {
      for (unsigned int p = 0; p < run.particles.size(); ++p)
        for (unsigned int d = 0; d < dim; ++d)
        {
          double      &x     = run.particles.component(run.particles.position, d)[p];
          const double y     = x + 0.08 * hashed_jitter(round, run.particles.id[p], d);
          const double lower = is_generated ? 0. : d == 0 ? 0.38 : 0.01;
          const double upper = is_generated ? (d == 0 ? 2. : 1.) : d == 0 ? 0.62 : 0.29;
          x                  = std::min(std::max(y, lower), upper);
        }
      const auto before = run.particles.id;
      run.particles.relocate();
      check_true(name + ": nobody is outside", run.particles.outside == run.particles.none);
      run.particles.migrate();
      run.particles.relocate();
      check_true(name + ": at home after migration", !run.particles.needs_synchronise);
      if (max(run.particles.needs_activation) > 0)
        run.grid.activate(run.particles.used_places());
      run.particles.relocate();
      check_true(name + ": nodes are active", !run.particles.needs_activation);
      n_sent += before != run.particles.id;
      check_true(name + ": places after moves", run.places_hold());
    }
    check(name + ": none lost", sum(run.particles.size()) - run.particles.n_global, 0.5);
    double sum_of_ids = 0;
    for (const auto id : run.particles.id)
      sum_of_ids += id;
    check(name + ": each is there", sum(sum_of_ids) - 0.5 * run.particles.n_global * (run.particles.n_global - 1.),
          0.5);
    if (dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1)
      check_true(name + ": particles have crossed borders", max(n_sent) > 0);
  }
}

/** Both passes on a mesh: mass and momentum of the nodes are those of the particles, linear velocities are kept. */
template <int dim>
void transfers_on_a_mesh()
{
  const std::string v = dim == 2 ? "1 + 2*x - y; 0.5 - x + 3*y" : "1 + 2*x - y; 0.5 - x + 3*y + z; z - 2*x";
  const std::string L = dim == 2 ? "2, -1, -1, 3" : "2, -1, 0, -1, 3, 1, -2, 0, 1";
  for (const std::string kernel : {"P1", "UMLS", "C1 UMLS"})
  {
    OnMesh<dim> run(gmsh_grid<dim>() + box_body<dim>(0.05, 0.25, set("Velocity", v) + set("Velocity gradient", L)) +
                    section("Kernel", set("Type", kernel)) + transfer_text("TPIC"));
    run.grid.clear();
    run.transfer->particle_to_grid(run.particles, *run.kernel, run.acceleration, 0., run.grid);
    run.grid.fields.add_copies_to_owners();
    using Fields                = NodalFields<dim>;
    double                 mass = 0, mass_p = 0;
    dealii::Tensor<1, dim> momentum, force;
    for (unsigned int i = 0; i < run.grid.fields.n_owned(); ++i)
    {
      mass += run.grid.fields[i][Fields::mass];
      for (unsigned int d = 0; d < dim; ++d)
        momentum[d] += run.grid.fields[i][Fields::momentum + d];
    }
    for (unsigned int p = 0; p < run.particles.size(); ++p)
    {
      const double m = run.particles.component(run.particles.mass, 0)[p];
      mass_p += m;
      momentum -= m * run.particles.vector(run.particles.velocity, p);
    }
    check(kernel + ": mass", sum(mass) / sum(mass_p) - 1, 1e-13);
    for (unsigned int d = 0; d < dim; ++d)
      check(kernel + ": momentum", sum(momentum[d]) / sum(mass_p), 1e-13);

    run.grid.update_velocity(0.);
    run.grid.fields.update_copies();
    double error = 0, slope = 0;
    for (unsigned int i = 0; i < run.grid.fields.n_owned(); ++i)
      if (run.grid.fields[i][Fields::mass] > run.grid.mass_floor)
      {
        const auto   x  = run.grid.node_position(i);
        const double v0 = 1 + 2 * x[0] - x[1];
        raise(error, run.grid.fields[i][Fields::velocity] - v0);
      }
    check(kernel + ": velocity of the nodes", max(error), 1e-9);
    const WorkingSet<dim> before = run.particles;
    run.transfer->grid_to_particle(run.grid, *run.kernel, 0., run.particles, 0, run.particles.size());
    error = 0;
    for (unsigned int p = 0; p < run.particles.size(); ++p)
    {
      raise(error, (run.particles.vector(run.particles.velocity, p) - before.vector(before.velocity, p)).norm());
      raise(slope, (run.particles.matrix(run.particles.grad_v, p) - before.matrix(before.grad_v, p)).norm());
    }
    check(kernel + ": velocity comes back", max(error), 1e-9);
    check(kernel + ": gradient comes back", max(slope), 1e-7);
  }
}

/** The ranks share the particles, not the cells: each halving errs by half of a cell's particles at most. */
template <int dim>
void shares_on_a_mesh()
{
  const double              length = dim == 2 ? 0.35 : 0.3; // a corner of the mesh, on one side of the plate's hole
  OnMesh<dim>               run(gmsh_grid<dim>() + section("Kernel", set("Type", "P1")) +
                                box_body<dim>(0.01, length, set("Particles per cell and direction", dim == 2 ? "16" : "12")));
  std::vector<unsigned int> of_cell(run.simplices().mesh().n_cells(), 0);
  unsigned int              most = 0;
  for (unsigned int p = 0; p < run.particles.size(); ++p)
    most = std::max(most, ++of_cell[run.particles.place[p]]);
  const unsigned int n_ranks = dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
  const double       share   = static_cast<double>(run.particles.n_global) / n_ranks;
  check("particles of a rank less its share, over those of a cell", run.particles.size() - share,
        std::max(0.5, max(most) * (n_ranks - 1.)));
  check_true("cells have far fewer than a share", max(most) < 0.5 * share);
}

/** What cannot be run is refused, with the entry. */
void mesh_grid_errors()
{
  const auto error = [](const std::string &name, const std::vector<std::string> &parts, const std::string &text) {
    check_error<EntryError>(name, parts, [&] { OnMesh<2> run(text); });
  };
  error("UMLS on a box", {"Kernel", "Type", "needs a mesh of triangles"},
        section("Grid", set("Spacing", "0.5")) + section("Kernel", set("Type", "UMLS")));
  error("B-splines on a mesh", {"Kernel", "Type", "needs a box grid"}, box_of_simplices<2>());
  const std::string p1 = section("Kernel", set("Type", "P1"));
  error("file and cells", {"File", "not both"},
        section("Grid", set("Type", "mesh") + set("File", "a.msh") + set("Cells", "2, 2")) + p1);
  error("no spacing", {"Spacing", "about that of the mesh's edges"},
        section("Grid", set("Type", "mesh") + set("File", "a.msh")) + p1);
  error("outside", {"the body's point", "lies outside the grid", "Clip to grid"},
        box_of_simplices<2>() + p1 + box_body<2>(0.5, 2.5));
  const auto wall = [](const std::string &content) {
    return section("Conditions", set("Names", "wall") + section("wall", set("Type", "slip") + content));
  };
  error("unknown group", {"wall", "Boundaries", "no boundary 'floor'"},
        box_of_simplices<2>() + p1 + box_body<2>(0.5, 1) + wall(set("Boundaries", "floor")));
  error("load on a clipped body", {"load", "Body", "loads on clipped bodies need a box grid"},
        box_of_simplices<2>() + p1 + box_body<2>(0.5, 2.5, set("Clip to grid", "true")) +
          section("Tractions", set("Names", "load") + section("load", set("Traction", "1; 0"))));
  error("number on a mesh", {"wall", "Boundary ids", "Give 'Boundaries'"},
        box_of_simplices<2>() + p1 + box_body<2>(0.5, 1) + wall(set("Boundary ids", "0")));
  error("name on a box", {"wall", "Boundaries", "Give 'Boundary ids'"},
        wall(set("Boundaries", "lower x")) + section("Grid", set("Cells", "4, 4")) + box_body<2>(0.25, 0.5));
}

#define INSTANTIATE(name)                                                                                              \
  template void name<2>();                                                                                             \
  template void name<3>();
INSTANTIATE(generated_mesh)
INSTANTIATE(particles_on_a_mesh)
INSTANTIATE(transfers_on_a_mesh)
INSTANTIATE(shares_on_a_mesh)

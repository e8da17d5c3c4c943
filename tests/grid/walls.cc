#include <talus/grid/walls.h>

#include "../setup.h"
#include "dense_walls.h"

#include <random>

using namespace Test;
using namespace dealii;

namespace
{
  using Vector = std::vector<double>;

  enum class Kind
  {
    any,    // all together
    sticky, // held in all components or in none
    slip,   // every face slips, and nothing else
    faces   // each face slips, holds all, or is open
  };

  /** One box with walls, and what a step makes of masses, momenta and forces there. */
  template <int dim>
  class Box
  {
  public:
    using Index  = typename Lattice<dim>::Index;
    using Fields = NodalFields<dim>;

    explicit Box(const std::array<int, 3> &cells) :
      setup(section("Grid", set("Cells", coordinates<dim>({{1. * cells[0], 1. * cells[1], 1. * cells[2]}})))),
      dense(setup.grid.lattice.n_cells), mass(dense.size), v_h(dim, Vector(dense.size, 0.))
    {
      walls.attach(setup.grid);
      momentum = force = velocity = increment = impulse = v_h;
    }

    double uniform(const double from, const double to) { return std::uniform_real_distribution<>(from, to)(random); }

    /** What is held where: the same on all ranks. */
    void choose(const unsigned int seed, const Kind kind)
    {
      random.seed(seed);
      for (unsigned int &type : face_type)
        type = random() % 3;
      for (unsigned int i = 0; i < dense.size; ++i)
      {
        const double dice = uniform(0, 1);
        dense.held[i].fill(false);
        for (unsigned int c = 0; c < dim; ++c)
        {
          const bool is_normal = dense.nodes[i][c] == 0 || dense.nodes[i][c] == dense.n_cells[c];
          const bool is_odd    = uniform(0, 1) < 0.5;
          if (!dense.is_real[i] || (!dense.is_at_face[i] && (kind != Kind::any || dice > 0.1)))
            continue;
          dense.held[i][c] = kind == Kind::faces  ? is_held_by_face(dense.nodes[i], c) :
                             kind == Kind::slip   ? is_normal :
                             kind == Kind::sticky ? dice < 0.4 :
                             dice < 0.3           ? is_normal :
                             dice < 0.5           ? true :
                             dice < 0.7           ? is_odd :
                                                    false;
          v_h[c][i]        = uniform(-1, 1);
        }
      }
      dense.find_rows();
    }

    /** A step; `is_moving`: with the velocities v_h of what is held, else 0. What the ranks add differs. */
    void step(const double dt, const bool is_moving)
    {
      auto &grid = setup.grid;
      grid.clear();
      walls.clear();
      const unsigned int rank = Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
      std::mt19937       own(7 * rank + 1);
      Vector             share(dense.size), sum(dense.size);
      for (unsigned int i = 0; i < dense.size; ++i)
        share[i] = node(i) ? std::uniform_real_distribution<>(0.1, 1)(own) : 0.;
      Utilities::MPI::sum(share, MPI_COMM_WORLD, sum);
      for (unsigned int i = 0; i < dense.size; ++i)
        if (double *to = node(i))
        {
          to[Fields::mass] = share[i] / sum[i] * mass[i];
          for (unsigned int c = 0; c < dim; ++c)
          {
            to[Fields::momentum + c] = share[i] / sum[i] * momentum[c][i];
            to[Fields::force + c]    = share[i] / sum[i] * force[c][i];
          }
        }
      grid.fields.add_copies_to_owners();
      walls.collect();
      prescribed.clear(grid.fields.n_owned());
      for (unsigned int r = 0; r < grid.fields.n_owned(); ++r)
        for (unsigned int c = 0; c < dim; ++c)
          if (const unsigned int i = dense.number(grid.node_index[r]); dense.held[i][c])
            prescribed.hold(r, c, is_moving ? v_h[c][i] : 0.);
      walls.solve(prescribed, dt, 0.);
      grid.fields.update_copies();
      walls.fill();
      read();
    }

    /** Masses in (0, 1), every fifth 0 if `has_gaps`, and velocities in (-1, 1). */
    void fill(const bool has_gaps, const bool has_forces)
    {
      for (unsigned int i = 0; i < dense.size; ++i)
      {
        mass[i] = uniform(0, 1);
        if (has_gaps && uniform(0, 1) < 0.2)
          mass[i] = 0;
        move(i, [&](unsigned int, unsigned int) { return uniform(-1, 1); });
        for (unsigned int c = 0; c < dim; ++c)
          force[c][i] = has_forces ? mass[i] * uniform(-1, 1) : 0.;
      }
    }

    template <class Velocity>
    void move(const unsigned int i, const Velocity &v)
    {
      for (unsigned int c = 0; c < dim; ++c)
        momentum[c][i] = mass[i] * v(c, i);
    }

    Setup<dim>          setup;
    Walls<dim>          walls;
    Dense<dim>          dense;
    Prescribed<dim>     prescribed;
    Vector              mass; // of all nodes, by their number in the dense list
    std::vector<Vector> v_h, momentum, force, velocity, increment, impulse;
    double              copy_error = 0; // largest difference between a node's values on two ranks

  private:
    /** Numbers of a node or a ghost, null where this rank does not know it. */
    double *node(const unsigned int i)
    {
      const auto &lattice = setup.grid.lattice;
      if (lattice.node_at(clamped(dense.nodes[i], dense.n_cells)) == lattice.missing)
        return nullptr;
      return setup.grid.fields.at_place(lattice.table_index(dense.nodes[i]));
    }

    void read()
    {
      const auto &grid = setup.grid;
      copy_error       = 0;
      // All in one message: velocities, increments, impulses.
      Vector here(3 * dim * dense.size, 0.), everywhere(here.size());
      for (unsigned int i = 0; i < dense.size; ++i)
        if (grid.lattice.node_at(clamped(dense.nodes[i], dense.n_cells)) < grid.fields.n_owned())
          for (unsigned int c = 0; c < dim; ++c)
          {
            here[(3 * i + 0) * dim + c] = node(i)[Fields::velocity + c];
            here[(3 * i + 1) * dim + c] = node(i)[Fields::increment + c];
          }
      for (const auto &one : prescribed.nodes)
        for (unsigned int c = 0; c < dim; ++c)
          here[(3 * dense.number(grid.node_index[one.node]) + 2) * dim + c] = one.impulse[c];
      Utilities::MPI::sum(here, MPI_COMM_WORLD, everywhere);
      for (unsigned int i = 0; i < dense.size; ++i)
        for (unsigned int c = 0; c < dim; ++c)
        {
          velocity[c][i]  = everywhere[(3 * i + 0) * dim + c];
          increment[c][i] = everywhere[(3 * i + 1) * dim + c];
          impulse[c][i]   = everywhere[(3 * i + 2) * dim + c];
          if (const double *known = node(i))
          {
            raise(copy_error, known[Fields::velocity + c] - velocity[c][i]);
            raise(copy_error, known[Fields::increment + c] - increment[c][i]);
          }
        }
    }

    /** By a face that slips (0) or holds all (1). */
    bool is_held_by_face(const Index &index, const unsigned int c) const
    {
      bool is_held = false;
      for (unsigned int d = 0; d < dim; ++d)
        for (unsigned int side = 0; side < 2; ++side)
          if (index[d] == (side == 0 ? 0 : dense.n_cells[d]))
            is_held = is_held || face_type[2 * d + side] == 1 || (face_type[2 * d + side] == 0 && c == d);
      return is_held;
    }

    std::mt19937                      random;
    std::array<unsigned int, 2 * dim> face_type;
  };

  struct Errors
  {
    double copies = 0, fill = 0, held = 0, increment = 0, residual = 0, impulse = 0, loss = 0, energy = 0, symmetry = 0;
  };

  /** What must hold after a step, whatever is held: all but the energy. */
  template <int dim>
  void look(Box<dim> &box, const double dt, const bool is_moving, Errors &errors)
  {
    const auto &dense = box.dense;
    raise(errors.copies, box.copy_error);
    for (unsigned int c = 0; c < dim; ++c)
    {
      const Vector &v = box.velocity[c];
      Vector        rest(dense.size);
      double        lost = 0, taken = 0;
      for (unsigned int i = 0; i < dense.size; ++i)
      {
        double filled = 0;
        for (unsigned int j = 0; j < dense.size; ++j)
          filled += dense.C[c][i][j] * v[j];
        raise(errors.fill, filled - v[i]);
        if (dense.is_real[i] && dense.held[i][c])
          raise(errors.held, v[i] - (is_moving ? box.v_h[c][i] : 0.));
        rest[i] = box.momentum[c][i] + dt * box.force[c][i] - box.mass[i] * v[i];
        lost += rest[i];
        if (box.mass[i] > 0)
          raise(errors.increment, v[i] - box.momentum[c][i] / box.mass[i] - box.increment[c][i]);
      }
      const Vector folded = dense.fold(c, rest);
      for (unsigned int i = 0; i < dense.size; ++i)
        if (dense.is_real[i])
        {
          if (!dense.held[i][c])
            raise(errors.residual, folded[i]);
          else
          {
            raise(errors.impulse, folded[i] - box.impulse[c][i]);
            taken += box.impulse[c][i];
          }
        }
      raise(errors.loss, lost - taken);
    }
  }

  /** Kinetic energy of a step without forces at walls at rest, and the map's symmetry in the norm of m. */
  template <int dim>
  void look_at_map(Box<dim> &box, Errors &errors)
  {
    const auto energy = [&](const std::vector<Vector> &a, const std::vector<Vector> &b) {
      double sum = 0;
      for (unsigned int c = 0; c < dim; ++c)
        for (unsigned int i = 0; i < box.dense.size; ++i)
          sum += box.mass[i] * a[c][i] * b[c][i];
      return sum;
    };
    std::vector<Vector> fields[2], images[2];
    for (unsigned int k = 0; k < 2; ++k)
    {
      fields[k] = box.v_h;
      for (unsigned int i = 0; i < box.dense.size; ++i)
      {
        for (unsigned int c = 0; c < dim; ++c)
          fields[k][c][i] = box.uniform(-1, 1);
        box.move(i, [&](const unsigned int c, const unsigned int i) { return fields[k][c][i]; });
      }
      box.step(0., false);
      images[k] = box.velocity;
      raise(errors.energy, std::max(0., energy(images[k], images[k]) / energy(fields[k], fields[k]) - 1));
    }
    raise(errors.symmetry, energy(images[0], fields[1]) - energy(images[1], fields[0]));
  }

  /**
   * On every face held along its normal, the normal velocity of quadratic B-splines is that of the wall, also between
   * its last node and an edge: (v_g + v_q) / 8 + 3/4 v_w on each line across it, ghosts beside it included.
   */
  template <int dim>
  double leak(Box<dim> &box, const unsigned int seed)
  {
    const auto &dense = box.dense;
    const auto &n     = dense.n_cells;
    box.choose(seed, Kind::faces);
    box.fill(false, true);
    box.step(0.3, false);
    double error = 0;
    for (const auto &w : dense.nodes)
      for (unsigned int d = 0; d < dim; ++d)
      {
        if (w[d] != 0 && w[d] != n[d])
          continue;
        auto inside = w;
        for (unsigned int e = 0; e < dim; ++e)
          inside[e] = e == d ? w[e] : std::min(std::max(w[e], 1), n[e] - 1);
        if (!dense.held[dense.number(inside)][d])
          continue;
        auto g = w, q = w;
        g[d]          = w[d] == 0 ? -1 : n[d] + 1;
        q[d]          = w[d] == 0 ? 1 : n[d] - 1;
        const auto &v = box.velocity[d];
        raise(error, (v[dense.number(g)] + v[dense.number(q)]) / 8 + 0.75 * v[dense.number(w)]);
      }
    return error;
  }

  /** v = a + A x where the conditions allow it: kept to round-off. */
  template <int dim>
  double linear_error(Box<dim> &box, const unsigned int seed, const Kind kind)
  {
    box.choose(seed, kind);
    Tensor<2, dim> A;
    Tensor<1, dim> a;
    for (unsigned int c = 0; c < dim; ++c)
    {
      a[c] = box.uniform(-1, 1);
      for (unsigned int d = 0; d < dim; ++d)
        A[c][d] = kind == Kind::slip && c != d ? 0. : box.uniform(-1, 1); // no d v_t / d n where walls slip
    }
    const auto v = [&](const unsigned int c, const unsigned int i) {
      double sum = a[c];
      for (unsigned int d = 0; d < dim; ++d)
        sum += A[c][d] * box.dense.nodes[i][d];
      return sum;
    };
    for (unsigned int c = 0; c < dim; ++c)
      for (unsigned int i = 0; i < box.dense.size; ++i)
        box.v_h[c][i] = v(c, i);
    box.fill(false, false);
    for (double &m : box.mass)
      m += 0.1;
    for (unsigned int i = 0; i < box.dense.size; ++i)
      box.move(i, v);
    box.step(0., true);
    double error = 0;
    for (unsigned int c = 0; c < dim; ++c)
      for (unsigned int i = 0; i < box.dense.size; ++i)
        raise(error, box.velocity[c][i] - v(c, i));
    return error;
  }
} // namespace

/** Random patterns of held, slipping, moving and open nodes of the faces, and of held nodes inside. */
template <int dim>
void walls()
{
  const std::vector<std::array<int, 3>> boxes =
    dim == 2 ? std::vector<std::array<int, 3>>{{{1, 1, 0}}, {{1, 4, 0}}, {{2, 2, 0}}, {{3, 1, 0}}, {{2, 5, 0}},
                                               {{3, 3, 0}}, {{5, 4, 0}}, {{4, 2, 0}}, {{5, 5, 0}}} :
               std::vector<std::array<int, 3>>{{{1, 1, 1}}, {{2, 1, 3}}, {{2, 2, 2}}, {{3, 2, 1}},
                                               {{1, 4, 1}}, {{3, 3, 3}}, {{2, 4, 3}}};
  Errors errors;
  double linear = 0, leaks = 0;
  for (const auto &cells : boxes)
  {
    Box<dim> box(cells);
    for (unsigned int k = 0; k < (dim == 2 ? 60 : 25); ++k)
    {
      box.choose(k + 1, Kind::any);
      box.fill(k % 2 == 0, true);
      box.step(0.3, true);
      look(box, 0.3, true, errors);
      if (k % 5 == 0)
        look_at_map(box, errors);
    }
    for (unsigned int k = 0; k < 10; ++k)
      for (const Kind kind : {Kind::sticky, Kind::slip})
        raise(linear, linear_error(box, k, kind));
  }
  for (const auto &cells : dim == 2 ? std::vector<std::array<int, 3>>{{{3, 4, 0}}, {{5, 5, 0}}} :
                                      std::vector<std::array<int, 3>>{{{3, 3, 3}}, {{4, 3, 3}}})
  {
    Box<dim> box(cells);
    for (unsigned int k = 0; k < 30; ++k)
      raise(leaks, leak(box, k));
  }
  check("normal velocity on walls", leaks, 1e-12);
  check("the same on all ranks", errors.copies, 1e-13);
  check("ghosts are rows of real nodes", errors.fill, 1e-12);
  check("held velocities", errors.held, 1e-15);
  check("increments", errors.increment, 1e-12);
  check("residual of free unknowns", errors.residual, 1e-12);
  check("impulse of each held component", errors.impulse, 1e-12);
  check("loss - reaction", errors.loss, 1e-12);
  check("growth of energy", errors.energy, 1e-12);
  check("symmetry in the norm of m", errors.symmetry, 1e-12);
  check("linear fields", linear, 1e-13);
}

template void walls<2>();
template void walls<3>();

#pragma once

#include <talus/grid/walls.h>

#include "../setup.h"
#include "dense_walls.h"

#include <random>

namespace Test
{
  using namespace dealii;

  enum class Kind
  {
    any,    // all together
    sticky, // held in all components or in none
    slip,   // every face slips, and nothing else
    faces   // each face slips, holds all, or is open
  };

  /** One box with walls, and what a step makes of masses, momenta and forces there. */
  template <int dim>
  class WallBox
  {
  public:
    using Vector = std::vector<double>;
    using Index  = typename Lattice<dim>::Index;
    using Fields = NodalFields<dim>;

    explicit WallBox(const std::array<int, 3> &cells) :
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
} // namespace Test

#pragma once

#include <talus/grid/block_factor.h>
#include <talus/grid/box_grid.h>
#include <talus/grid/prescribed.h>

namespace Talus
{
  /**
   * Ghost nodes: one more layer of nodes beyond each face of the box, so that every stencil is complete. Their
   * velocities are no unknowns but sums of those of real nodes, v = C v_r with the rows of wall_row(). With the masses
   * m, momenta p and forces f of all nodes, Q = p + dt f, the held values v_h, and f, h the free and held columns,
   * @f[ C_f^T m C_f\, v_f = C_f^T (Q - m C_h v_h) : @f]
   * mass, momentum and force of the ghosts are folded onto the real nodes by the transpose of what fills them. So no
   * arrangement of particles at a wall vibrates faster than the fastest in the open grid (the Rayleigh quotient of a
   * subspace), kinetic energy never grows, and what holds h bears C_h^T (Q - m v) / dt, all of what the body loses.
   *
   * The matrix is diagonal but at free nodes near faces that nothing holds: a pair on the line across the face, 4 and 8
   * nodes at edges and corners, more where opposite faces are nearer than four cells. Each such block is solved by
   * every rank that owns a node of it, from the same numbers in the same order: it takes one message to know them.
   *
   * Wall nodes are those near faces, and those of which conditions ask anything; all others are plain.
   * Theory: doc/walls.md. Test: tests/grid/walls.cc.
   */
  template <int dim>
  class Walls
  {
  public:
    using Index = typename Lattice<dim>::Index;

    /** Makes ghosts beyond the faces of the grid; without it there are none, and nothing here does anything. */
    void attach(BoxGrid<dim> &grid);

    bool has_ghosts() const { return grid != nullptr; }

    /** Finds the wall nodes among the active ones; due after each activation. */
    void select();

    /** Which nodes conditions have asked something of since the last select(), which it does anew. Collective. */
    void serialize(Archive &archive);

    /** Zeros the ghosts for the sums of a step. */
    void clear();

    /** Adds what this rank has summed into copies of ghosts to their owners. Collective. */
    void collect();

    /**
     * From the nodes' sums to their velocities and increments: those of this rank's nodes and of the wall nodes that it
     * knows. `damping` is the factor of LocalDamping for the wall nodes. Collective.
     */
    void solve(Prescribed<dim> &prescribed, const double dt, const double damping);

    /** Gives the ghosts their velocities and increments, when the copies have theirs. */
    void fill();

    /** Prepares carried_mass() after solve(). */
    void carry_masses();

    /** What a change of an owned node's velocity, component by component, changes of the momentum: its own `mass`, and
     * what its ghosts make of it [mass]. */
    dealii::Tensor<1, dim> carried_mass(const unsigned int node, const double mass) const;

    /** Calls body(place) for this rank's ghosts. */
    template <class Body>
    void for_each_owned_ghost(const Body &body) const
    {
      for (unsigned int g = 0; g < n_owned_ghosts; ++g)
        body(ghost_place[g]);
    }

    /** This rank's active nodes that are not wall nodes. */
    std::vector<unsigned int> plain_nodes;

    double damping_work = 0; // on the body in the last step, at this rank's wall nodes [energy]

  private:
    static constexpr unsigned int none = static_cast<unsigned int>(-1);

    // What the ranks tell each other of a wall node: its sums, and of real nodes what is asked, the held velocity, and
    // for each axis the friction coefficient and the velocity of a wall, and its account.
    static constexpr unsigned int asked = 8, held_velocity = 9, friction = 9 + dim, wall_velocity = 9 + 2 * dim,
                                  account_time = 9 + dim * (2 + dim), account_before = account_time + dim,
                                  mean_before = account_before + dim, n_lanes = mean_before + dim;

    // What is asked, as bits: components held, held in a plane of symmetry; axes with friction below or above.
    static constexpr unsigned int held = 0, symmetric = dim, pressed_below = 2 * dim, pressed_above = 3 * dim;

    /** A real wall node in the row of a ghost. */
    struct Entry
    {
      unsigned int real;
      double       coefficient;
    };

    /** Free nodes that ghosts couple. */
    struct Block
    {
      std::vector<unsigned int> reals, ghosts;
    };

    /** Of one component: the rows of all ghosts, and what couples. */
    struct Rows
    {
      std::vector<unsigned int> begin; // of each ghost among the entries, and the end
      std::vector<Entry>        entries;
      std::vector<Block>        blocks;
      std::vector<unsigned int> block, local; // of a real wall node that is in one, and its number there
    };

    /** Of one component, numbers of the real wall nodes. */
    struct Unknowns
    {
      std::vector<double> v, before;       // the velocity, and what it is without the forces
      std::vector<double> right, diagonal; // of what is solved
      std::vector<double> load;            // impulse of friction [momentum]
      std::vector<double> rest, force;     // C^T (Q - m v) and C^T dt f [momentum]
      std::vector<char>   is_fixed;        // by contact
      std::vector<char>   is_left_out;     // without mass
    };

    /** A node that may press against a face of friction. */
    struct Press
    {
      unsigned int           real, axis;
      double                 outward;
      bool                   acts    = false;
      double                 account = 0, mean = 0; // after this step [momentum]
      std::array<bool, dim>  fixes{};               // components
      dealii::Tensor<1, dim> load;                  // impulse of sliding friction on the wall [momentum]
    };

    bool is_near_face(const Index &index) const;
    bool asks(const unsigned int r, const unsigned int what, const unsigned int c) const
    {
      return state[r] >> (what + c) & 1;
    }
    double record(const unsigned int place, const unsigned int lane) const
    {
      return records[std::size_t{n_lanes} * place + lane];
    }
    double mass(const unsigned int place) const { return record(place, NodalFields<dim>::mass); }
    /** p + dt f of a component. */
    double impulse(const unsigned int place, const unsigned int c, const double dt) const
    {
      return record(place, NodalFields<dim>::momentum + c) + dt * record(place, NodalFields<dim>::force + c);
    }
    unsigned int ghost(const unsigned int g) const { return real_node.size() + g; } // its place among the records

    void number_nodes();
    void number_ghosts();
    void share_lists();
    void find_rows();
    void find_blocks(const unsigned int c);

    /** Learns from the owners what is known of the wall nodes, and finds the rows anew where what is held changes. */
    void read(const Prescribed<dim> &prescribed);
    void enter(const Prescribed<dim> &prescribed);

    /** Solves for one component with the nodes' momentum after dt into `v`. */
    void assemble(const unsigned int c, const double dt);
    void solve_component(const unsigned int c, const double dt, std::vector<double> &v);
    void assemble_block(const unsigned int c, const Block &block);
    void solve_block(const unsigned int c, const unsigned int block, std::vector<double> &v);

    void find_presses();

    /**
     * Friction of one node: what sticking would take of its tangential momentum, if mu times the normal impulse J of
     * the step allows it; else that against the motion.
     *
     * With an account, A <- (1 - dt/tau) A + J less what friction uses over mu, J_mean <- J_mean + dt/tau (J - J_mean),
     * it is mu min(A, max(J, 10 J_mean)) that allows it, also in a step in which the node does not press, and the node
     * sticks through its vibrations. So friction never takes more than mu times what the wall has given. A node that
     * slides has used all it has: what has gathered in rest is no brake.
     */
    void   press(Press &press, const double dt);
    double fix(const unsigned int r, const unsigned int c, const double velocity);
    void   damp(const unsigned int c, const double factor);
    void   find_rest(const unsigned int c, const double dt);
    void   write(const unsigned int c);
    void   account(Prescribed<dim> &prescribed) const;

    BoxGrid<dim> *grid = nullptr;

    // Real wall nodes and ghosts are numbered apart, owned ones first.
    std::vector<unsigned int> real_node, position;     // number in the grid, and back
    std::vector<unsigned int> ghost_place, ghost_wall; // place in the grid's fields; the real node next to it
    std::vector<Index>        ghost_index;
    std::vector<unsigned int> first_ghost; // of each real node
    std::vector<char>         is_asked;    // nodes away from faces of which conditions ask something
    unsigned int              n_owned_reals = 0, n_owned_ghosts = 0;

    // In the order of the lattice: what ranks solve more than once they must sum, and leave out, alike.
    std::vector<unsigned int> real_order, ghost_order;

    Nodes               ghost_nodes, wall_nodes;
    NodalExchange       ghost_exchange{8}, exchange{n_lanes};
    std::vector<double> records;

    std::vector<unsigned int> state;                          // what is asked of each real wall node
    std::vector<char>         is_mirrored_ghost, is_mirrored; // by a plane of symmetry
    std::array<Rows, dim>     rows;
    std::array<Unknowns, dim> unknowns;
    std::vector<Press>        presses;

    std::vector<dealii::Tensor<1, dim>> carried; // of the real wall nodes [mass]

    BlockFactor factor;
  };
} // namespace Talus

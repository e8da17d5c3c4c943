#pragma once

#include <talus/grid/box_grid.h>
#include <talus/particles/body.h>
#include <talus/particles/working_set.h>

#include <deal.II/particles/particle_handler.h>

namespace Talus
{
  /**
   * All particles. deal.II's ParticleHandler is their *home*, in which they are
   * created and which whoever is not a part of the step may ask for; the step runs on the *working set*, and one of
   * both is empty, so that nothing is stored twice. Two things keep the working set in shape, each done when it is due
   * and not in every step: migrate() sends those that have gone too far to the rank of their cell, and sort() restores
   * the order of the cells, which keeps neighbours close in memory. synchronise() is both.
   */
  template <int dim>
  class Particles : public WorkingSet<dim>
  {
  public:
    /**
     * Creates the particles of all bodies in the cells this rank owns. Throws EntryError for an empty body, for one
     * that does not lie in the grid, and where number or volume of a body's particles are not those of its shape. Nodes
     * of at most `smallest_share` of the largest particle's mass will count as empty. Collective.
     */
    void create(Grid<dim> &grid, std::vector<std::unique_ptr<Body<dim>>> &bodies,
                const std::vector<std::unique_ptr<Material>> &materials, const double smallest_share);

    /** Number of particles that the bodies put into a cell; before create(). */
    static unsigned int count(const Grid<dim> &grid, const std::vector<std::unique_ptr<Body<dim>>> &bodies,
                              const typename Grid<dim>::CellIterator &cell);

    /** Tells how far a particle may stray: a rank keeps it as long as it knows all nodes within its reach. */
    void set_reach(Grid<dim> &grid, const Reach &reach);

    /** Finds anew which nodes are active; due after each activation. */
    void update_open_places();

    /**
     * Finds out whether the particles begin .. end - 1 can stay with this rank, and
     * whether one has left the grid; who is beyond a face by round-off is put on it (Grid::enter()). What is found is
     * acted on where the ranks meet next.
     */
    void relocate(const unsigned int begin, const unsigned int end);

    /** Forgets what relocate() has found before. */
    void start_relocation();

    /** Both, for all particles. */
    void relocate()
    {
      start_relocation();
      relocate(0, this->size());
    }

    /** Sends the particles that lie in other ranks' cells there. Collective. */
    void migrate();

    /** Restores the canonical order: by material, first node of the stencil and id. */
    void sort();

    /** Both: what the working set is then depends on nothing but where the particles are. Collective. */
    void synchronise()
    {
      migrate();
      sort();
    }

    /**
     * Moves all particles into deal.II's ParticleHandler, and leaves the working set empty until take_back(). Each lies
     * in a cell of its rank, where deal.II's iterators find it. Its properties are its columns, `fields` says which:
     * the mass is get_properties()[fields[mass].first]. get_location() is its position, on a box moved off the faces of
     * the cell by up to 1e-6 of it. Properties may be changed, but for the position, and particles be taken out.
     * Collective.
     */
    dealii::Particles::ParticleHandler<dim> &home();

    /**
     * The way back: with what was changed there, in canonical order. Throws RunError for a particle that was added
     * there, or whose position was moved. Collective.
     */
    void take_back();

    /**
     * Takes over all particles as they have been put into the working set: ids and columns, and, if this is
     * `as_they_were` on this rank, their order and their places; otherwise each rank has any of them, and they find
     * their ranks and the canonical order. Throws InputError where their number has changed. Collective.
     */
    void take_over(const bool as_they_were);

    /** Finds the ranks and places of particles in a grid whose cells have been shared out anew. Collective. */
    void find_places();

    /** Centre and number of particles of each of this rank's cells that has any; all have come to their ranks. */
    std::vector<double> counts() const;

    /** For each place, whether the stencil of a particle begins there. */
    std::vector<char> used_places() const;

    unsigned int n_stencil_nodes = 3; // nodes per axis within reach

    static constexpr unsigned int none = static_cast<unsigned int>(-1);

    bool         needs_synchronise = false; // set by relocate(): a particle has strayed too far from this rank
    bool         needs_activation  = false; // set by relocate(): a corner has come to nodes that are not active
    bool         brings_new_nodes  = false; // set by migrate(): nodes around a particle that came are not active
    unsigned int outside           = none; // set by relocate(): of the particles outside the grid that of lowest number

    std::uint64_t n_global    = 0;
    std::uint64_t arrangement = 0; // grows whenever particles of the working set come, go or change places

  private:
    /** Appends the n particles of the handler to the working set, and empties the handler. */
    void load(const unsigned int n);

    /** What relocate() does for the corners of the particles' domains. */
    void look_at_corners(const unsigned int begin, const unsigned int end);
    template <class Number>
    bool are_open(const Number &place) const;

    /** Throws EntryError for a body with a domain that reaches beyond the grid. */
    void check_initial_corners(const std::vector<std::unique_ptr<Body<dim>>> &bodies);

    /** Marks the places from which stencils of corners begin, where domains have corners. */
    void mark_places_of_corners(std::vector<char> &is_used) const;

    /** Throws RunError if a corner lies where its owner, this rank, does not know the nodes. */
    void check_corners_are_known();

    /** The places of all particles, `none` where this rank does not know all nodes of the stencil. */
    std::vector<unsigned int> places() const;

    /** Throws if a particle has no place: what it carries would be lost. */
    void check_place(const unsigned int p, const unsigned int place) const;

    unsigned int body_of(const std::uint64_t id) const;

    /** Puts a particle that another rank has sent at place p of the working set: its id, its columns, its place. */
    void unpack(const double *message, const unsigned int p);

    /** Copies a particle's numbers to another place. */
    void move(const unsigned int from, const unsigned int to);

    /** Takes out what `is_gone` marks, if it marks anything, and sorts the others. */
    void sort(const std::vector<bool> &is_gone);

    Grid<dim>                                               *grid = nullptr;
    const BoxGrid<dim>                                      *box  = nullptr; // the same, where domains have corners
    std::unique_ptr<dealii::Particles::ParticleHandler<dim>> handler;

    std::vector<std::uint64_t> body_begin; // first id of each body
    std::vector<unsigned int>  body_material;

    Reach             reach;
    Found             found;
    std::vector<char> is_open; // places from which on all nodes within reach are active; where domains have corners
    std::vector<char> are_open_after; // this place and those one farther along each axis
    unsigned int      half_edges = 0;
  };
} // namespace Talus

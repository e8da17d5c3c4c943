#pragma once

#include <talus/grid/grid.h>
#include <talus/particles/body.h>
#include <talus/particles/working_set.h>

#include <deal.II/fe/mapping_cartesian.h>
#include <deal.II/particles/particle_handler.h>

namespace Talus
{
  /**
   * All particles. deal.II's ParticleHandler is their *home*, in which they are
   * created; the step runs on the *working set*, and between steps the home is
   * empty, so that nothing is stored twice. Two things keep the working set in
   * shape, each done when it is due and not in every step: migrate() sends those
   * that have gone too far to the rank of their cell, and sort() restores the order
   * of the cells, which keeps neighbours close in memory. synchronise() is both.
   */
  template <int dim>
  class Particles : public WorkingSet<dim>
  {
  public:
    /**
     * Creates the particles of all bodies in the cells this rank owns. Throws
     * EntryError for an empty body and for one that does not lie in the grid.
     */
    void create(Grid<dim> &grid, std::vector<std::unique_ptr<Body<dim>>> &bodies,
                const std::vector<std::unique_ptr<Material>> &materials);

    /** Number of particles that the bodies put into a cell; before create(). */
    static unsigned int count(const Grid<dim> &grid, const std::vector<std::unique_ptr<Body<dim>>> &bodies,
                              const typename Grid<dim>::CellIterator &cell);

    /**
     * Tells how far a particle may stray: its stencil is the `n` nodes per axis
     * from floor(lattice coordinate - shift), and a rank keeps a particle as long
     * as it knows all of them.
     */
    void set_stencil(Grid<dim> &grid, const unsigned int n, const double shift);

    /**
     * Finds out whether the particles begin .. end - 1 can stay with this rank, and
     * whether one has left the grid. What is found is acted on where the ranks meet next.
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

    /** For each entry of the lattice's tables, whether the stencil of a particle begins there. */
    std::vector<char> stencil_beginnings() const;

    unsigned int n_stencil_nodes = 3; // nodes per axis of a stencil

    static constexpr unsigned int none = static_cast<unsigned int>(-1);

    bool needs_synchronise = false; // set by relocate(): a particle has strayed too far from this rank
    bool brings_new_nodes  = false; // set by migrate(): nodes around a particle that came are not active

    std::vector<unsigned int> outside; // set by relocate(): the particles outside the grid

    std::uint64_t n_global    = 0;
    std::uint64_t arrangement = 0; // grows whenever particles of the working set come, go or change places

  private:
    /** Appends the n particles of the home to the working set, and empties the home. */
    void load(const unsigned int n);

    /**
     * Entry of the lattice's tables at which a particle's stencil begins. Throws where this rank does not know all
     * nodes of the stencil: what the particle carries would be lost there.
     */
    unsigned int place(const unsigned int p) const;

    unsigned int body_of(const std::uint64_t id) const;

    /** Ranks of the cells of some particles. Collective where this rank does not know a cell. */
    std::vector<unsigned int> ranks_of(const std::vector<unsigned int> &particles) const;

    /** Copies a particle's numbers to another place. */
    void move(const unsigned int from, const unsigned int to);

    /** Takes out what `is_gone` marks, if it marks anything, and sorts the others. */
    void sort(const std::vector<bool> &is_gone);

    Grid<dim>                                               *grid = nullptr;
    std::unique_ptr<dealii::MappingCartesian<dim>>           mapping;
    std::unique_ptr<dealii::Particles::ParticleHandler<dim>> home;

    std::vector<std::uint64_t> body_begin; // first id of each body
    std::vector<unsigned int>  body_material;

    std::vector<char> coverage;
    double            stencil_shift      = 0;
    bool              knows_all_stencils = false; // this rank has the nodes of every stencil in the domain
  };
} // namespace Talus

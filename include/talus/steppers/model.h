#pragma once

#include <talus/boundary/boundary.h>
#include <talus/core/body_force.h>
#include <talus/core/parameters.h>
#include <talus/core/requests.h>
#include <talus/loads/contact.h>
#include <talus/particles/material_range.h>
#include <talus/particles/overlaps.h>
#include <talus/particles/particles.h>
#include <talus/steppers/energy_account.h>
#include <talus/transfer/f_bar.h>
#include <talus/transfer/tractions.h>
#include <talus/transfer/transfer.h>
#include <talus/transfer/volume_smoothing.h>

#include <optional>

namespace Talus
{
  /**
   * The parts of a run that a step works on. The constructor builds what the parameter file chooses, parse() of the
   * parameters gives it its numbers, and create() makes the state before the first step of it.
   */
  template <int dim>
  class Model : public dealii::ParameterAcceptor
  {
  public:
    Model(Parameters &parameters, const Communicator &communicator);

    void parse_parameters(dealii::ParameterHandler &prm) override;

    /**
     * Grid, particles, and all that is found among them; `initialize` may change the particles' initial state before
     * anything is made of it. Collective.
     */
    void create(const std::function<void()> &initialize = [] {});

    /** Lines that say what it consists of. */
    std::string summary() const;

    /**
     * The Courant number up to which a lone particle of a fluid is stable, wherever it lies, with a transfer of these
     * factors; nothing where there is none. Full bodies bear more. Theory: doc/walls.md.
     */
    std::optional<double> lone_particle_limit(const std::array<double, 2> &stiffness_factors) const;

    /**
     * How much more than a fluid's a lone particle of this run's materials bears: sqrt(d (l + 2 G) / (d l + 2 G)) of
     * the least, with their Lame constants.
     */
    double material_factor() const;

    /**
     * Shares the cells out anew by the numbers of particles in them, as Grid::repartition() does, and the particles
     * with them; their order is then canonical, and all nodes are active. Collective.
     */
    void repartition(const std::vector<double> &counts);

    /** What the parts remember from one step to the next, beside the particles, which are there before. Collective. */
    void serialize(Archive &archive);

    /** Registers what the parts know of the last step, for all ranks. */
    void add_to(Reduction &reduction);

    /**
     * From the sums of this rank's particles at the nodes to the velocities and increments of the nodes in a step from
     * `time` to time + dt, copies and ghosts included. Collective.
     */
    void move_nodes(const double time, const double dt);

    std::unique_ptr<Grid<dim>>              own_grid;
    Grid<dim>                              &grid;
    Walls<dim>                              walls;
    std::unique_ptr<Kernel<dim>>            kernel;
    std::unique_ptr<Transfer<dim>>          transfer;
    std::vector<std::string>                material_names;
    std::vector<std::unique_ptr<Material>>  materials;
    std::vector<std::unique_ptr<Body<dim>>> bodies;
    Overlaps<dim>                           overlaps;
    Particles<dim>                          particles;
    Boundary<dim>                           boundary;
    Tractions<dim>                          tractions;
    Contacts<dim>                           contacts;
    VolumeSmoothing<dim>                    smoothing;
    FBar<dim>                               f_bar;
    BodyForce<dim>                          acceleration; // body force per mass
    EnergyAccount<dim>                      account;
    Requests                                requests;

  private:
    void build_bodies(Parameters &parameters);
    void build_conditions(Parameters &parameters);

    /** Tells the parts of the grid's nodes. */
    void attach();

    /** Throws EntryError where the particles need more memory than there is, and says how much of it they need.
     * Collective. */
    void check_memory() const;

    std::string acceleration_text;
    std::vector<double>
      last_counts; // by which cells were shared out: this rank's part; by the bodies if nobody's is there
  };
} // namespace Talus

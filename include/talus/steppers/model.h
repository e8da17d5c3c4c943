#pragma once

#include <talus/boundary/condition.h>
#include <talus/core/body_force.h>
#include <talus/core/parameters.h>
#include <talus/particles/material_range.h>
#include <talus/particles/overlaps.h>
#include <talus/particles/particles.h>
#include <talus/transfer/tractions.h>
#include <talus/transfer/transfer.h>
#include <talus/transfer/volume_smoothing.h>

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

    /** Registers what the parts know of the last step, for all ranks. */
    void add_to(Reduction &reduction);

    std::unique_ptr<Grid<dim>>              own_grid;
    Grid<dim>                              &grid;
    std::unique_ptr<Kernel<dim>>            kernel;
    std::unique_ptr<Transfer<dim>>          transfer;
    std::vector<std::string>                material_names;
    std::vector<std::unique_ptr<Material>>  materials;
    std::vector<std::unique_ptr<Body<dim>>> bodies;
    Overlaps<dim>                           overlaps;
    Particles<dim>                          particles;
    Boundary<dim>                           boundary;
    Tractions<dim>                          tractions;
    VolumeSmoothing<dim>                    smoothing;
    BodyForce<dim>                          acceleration; // body force per mass

  private:
    void build_bodies(Parameters &parameters);
    void build_conditions(Parameters &parameters);

    std::string acceleration_text;
  };
} // namespace Talus

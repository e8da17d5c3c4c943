#pragma once

#include <talus/core/parameters.h>
#include <talus/postprocess/comparison.h>
#include <talus/postprocess/load_curve.h>
#include <talus/postprocess/output.h>
#include <talus/postprocess/probes.h>
#include <talus/postprocess/progress.h>
#include <talus/postprocess/statistics.h>
#include <talus/postprocess/verification.h>
#include <talus/steppers/explicit_step.h>
#include <talus/steppers/upkeep.h>
#include <talus/transfer/volume_smoothing.h>

#include <fstream>
#include <sstream>

namespace Talus
{
  /** A run: builds its parts from the parameters, then steps from start to end. */
  template <int dim>
  class Simulation : public dealii::ParameterAcceptor
  {
  public:
    /** Builds all objects that the file chooses; parameters.parse() must follow before run(). */
    Simulation(Parameters &parameters, MPI_Comm communicator);

    void parse_parameters(dealii::ParameterHandler &prm) override;

    void run();

  private:
    bool   is_finished() const { return time >= end_time || (max_steps > 0 && step >= max_steps); }
    void   add_reference(Parameters &parameters, const std::vector<std::string> &material_names);
    void   set_up();
    void   open_output();
    void   advance();
    double choose_step_size() const;
    void   postprocess();
    void   write_statistics();
    void   finish();

    /** Writes to the terminal and the log; rank 0. */
    void        say(const std::string &text);
    std::string summary() const;
    std::string traffic() const; // between ranks in the steps; collective
    std::string memory() const;  // what a particle takes, the grid's and all other memory included; collective

    MPI_Comm           communicator;
    const Parameters  &parameters;
    const double       memory_at_start;             // resident memory of this rank, before anything is built [byte]
    double             processor_time_at_start = 0; // of this rank, before the first step [s]
    Timing             timing;
    const StepTiming   step_timing;
    const unsigned int set_up_section, upkeep_section, smoothing_section, output_section, comparison_section;
    std::ofstream      log;

    Grid<dim>                               grid;
    std::vector<std::unique_ptr<Material>>  materials;
    std::vector<std::unique_ptr<Body<dim>>> bodies;
    Particles<dim>                          particles;
    std::unique_ptr<Kernel<dim>>            kernel;
    std::unique_ptr<Transfer<dim>>          transfer;
    Boundary<dim>                           boundary;
    BodyForce<dim>                       acceleration;
    Tractions<dim>                          tractions;
    VolumeSmoothing<dim>                    smoothing;
    Model<dim>                              model;

    Output<dim>                      output;
    Probes<dim>                      probes;
    Statistics<dim>                  statistics;
    std::unique_ptr<Progress>        progress;
    std::unique_ptr<Comparison<dim>> comparison; // with a finite element reference, on request
    std::unique_ptr<LoadCurve<dim>>  load_curve; // of the plastic one, on request

    std::unique_ptr<Verification<dim>> verification; // against a manufactured solution, on request

    std::string  acceleration_text;
    double       end_time = 1, courant_number = 0.5, fixed_step_size = 0;
    unsigned int max_steps = 0; // 0: no limit

    double                 time = 0, dt = 0;
    unsigned int           step = 0;
    Survey<dim>            now;
    EnergyWatch<dim>       energy;
    Upkeep<dim>            upkeep;
    dealii::Tensor<1, dim> lost_momentum; // by empty nodes since the start [mass length/time]
  };
} // namespace Talus

#pragma once

#include <talus/core/parameters.h>
#include <talus/postprocess/checkpoints.h>
#include <talus/postprocess/energies.h>
#include <talus/postprocess/output.h>
#include <talus/postprocess/probes.h>
#include <talus/postprocess/progress.h>
#include <talus/postprocess/statistics.h>
#include <talus/simulation/checks.h>
#include <talus/simulation/references.h>
#include <talus/simulation/resources.h>
#include <talus/simulation/resume.h>
#include <talus/steppers/energy_watch.h>
#include <talus/steppers/fracture_watch.h>
#include <talus/steppers/stepper.h>

#include <fstream>
#include <functional>

namespace Talus
{
  /** A run: builds its parts from the parameters, then steps from start to end. */
  template <int dim>
  class Simulation : public dealii::ParameterAcceptor
  {
  public:
    /** Builds all objects that the file chooses; parameters.parse() must follow before run(). */
    Simulation(Parameters &parameters, const Communicator &communicator);

    void parse_parameters(dealii::ParameterHandler &prm) override;

    /** `origin`: of program and command line, for the log. */
    void run(const std::string &origin = "");

    /** The same from a checkpoint on; `is_longer`: to another end time. */
    void go_on(const Resume &resume, const bool is_longer, const std::string &origin = "");

  private:
    bool is_finished() const { return now.time >= end_time || (max_steps > 0 && now.step >= max_steps); }
    void set_up();
    void restore(const Resume &resume);
    void open_output(const Resume *resume = nullptr);
    void start_log(const bool goes_on);
    void step_to_end();
    void fill_table();
    void step();
    void advance();
    void check();
    void look_for_fracture();
    void postprocess();
    void checkpoint();
    void finish();
    void stop();

    /** Runs `work`; the log keeps how it ended. */
    void to_the_end(const std::function<void()> &work);
    void note_failure(const std::exception &error);

    /** Writes the state of a step that has failed: what the message says of it. `is_whole`: the step was at its end. */
    std::string write_failure(const bool is_whole);

    /** All that is remembered from one step to the next, beside the particles. Collective. */
    void serialize(Archive &archive);

    Totals<dim> current_totals();

    /** Writes to the terminal and the log; rank 0. */
    void               say(const std::string &text);
    void               say_warning(const std::string &text);
    void               tell_warnings();
    static std::string warning_line(const std::string &text) { return "warning: " + shortened(text, 1000) + '\n'; }
    std::string        summary() const;

    const Communicator communicator;
    Parameters        &parameters;
    Resources          resources;
    Timing             timing;
    unsigned int       output_section, reference_section, checkpoint_section; // of it
    std::ofstream      log;
    std::string        origin;           // of the run, for the log
    unsigned int       n_told   = 0;     // of the warnings before the first step
    bool               is_alone = false; // in an error that other ranks have not met

    Model<dim>                    model;
    std::unique_ptr<Stepper<dim>> stepper;
    EnergyWatch<dim>              energy;
    FractureWatch<dim>            fracture;

    Output<dim>               output;
    Probes<dim>               probes;
    References<dim>           references;
    Checkpoints               checkpoints;
    Table                     table; // of the statistics
    CsvFile                   statistics;
    std::unique_ptr<Progress> progress;

    double       end_time  = 1;
    unsigned int max_steps = 0; // 0: no limit

    Moment                 now;
    unsigned int           first_step = 0; // before which this program has begun
    std::string            last_checkpoint;
    Report                 report;        // of the last step
    Totals<dim>            totals;        // of the last row of the statistics
    dealii::Tensor<1, dim> lost_momentum; // by empty nodes since the start [mass length/time]
  };
} // namespace Talus

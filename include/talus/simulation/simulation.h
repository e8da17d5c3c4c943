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
#include <talus/simulation/stages.h>
#include <talus/steppers/energy_watch.h>
#include <talus/steppers/fracture_watch.h>
#include <talus/steppers/stepper.h>

#include <chrono>
#include <fstream>
#include <functional>

namespace Talus
{
  /** A run: builds its parts from the parameters, then steps from start to end. */
  template <int dim>
  class Simulation : public dealii::ParameterAcceptor
  {
  public:
    /** Builds all objects that the file chooses for a stage; parameters.parse() must follow before run(). */
    Simulation(Parameters &parameters, const Communicator &communicator, const unsigned int stage_number = 0);

    /** The same, and parses: a run that is ready. */
    static std::unique_ptr<Simulation> make(Parameters &parameters, const Communicator &communicator,
                                            const unsigned int stage_number);

    void parse_parameters(dealii::ParameterHandler &prm) override;

    /** `origin`: of program and command line, for the log. */
    void run(const std::string &origin = "");

    /** Sets up and takes a few steps, without an output: says how many steps, how much time and memory the run will
     * take. */
    void try_start();

    /** The same from a checkpoint on, which may be the end of the stage before; `is_longer`: to another end time. */
    void go_on(const Resume &resume, const bool is_longer, const std::string &origin = "");

    /** How a trial has ended: the watched particle stayed near its place, or moved too far, or a signal came. */
    enum class Trial
    {
      stands,
      failed,
      stopped
    };

    /** Runs a stage that is a search from its begin, with the parameters of a trial and an output of its own. */
    Trial try_out(const Resume &begin, const std::string &origin);

    /** That of a run in stages. */
    const Stage &stage() const { return *stages[stage_number]; }

    /** In a trial: how far the watched particle has moved [length]. */
    double moved() const { return trial.moved; }

    /** After an error: whether other ranks have not met it. */
    bool is_lone_failure() const { return is_alone; }

    /** After run() or go_on(): whether another stage follows. */
    bool is_to_go_on() const { return is_finished() && !is_last_stage() && !model.requests.is_stopped(); }

    /** That of the output. */
    const std::string &directory() const { return output.directory(); }

  private:
    bool is_finished() const
    {
      return is_at_rest || trial.has_failed || now.time >= end_time || (max_steps > 0 && now.step >= max_steps);
    }
    bool is_last_stage() const { return stage_number + 1 >= stages.size() || (max_steps > 0 && now.step >= max_steps); }
    void set_up(const Resume *resume = nullptr);
    void restore(const Resume &resume);
    void repartition_as(const CheckpointFile &file);
    void check_places(const Resume &resume, const bool is_exact) const;

    /** Takes the state over from the end of the stage before. */
    void begin_stage(const Resume &resume);
    void finish_stage();

    /** "'gravity', 1 of 3,". */
    std::string stage_name() const;

    /** Finds out whether the stage has come to rest, or the trial has failed. Collective. */
    void look_for_rest();

    /** The sum of the nodes' masses times their accelerations over that of weight, loads or reactions [1]. Collective.
     */
    double unbalanced() const;

    /** What moves anything: velocities of particles that FLIP keeps, and no node has, do not [energy]. Collective. */
    double kinetic_energy_of_nodes() const;

    /** Energy put in since the stage began, or the greatest kinetic energy if that is more [energy]. */
    double put_in() const;
    void   open_output(const Resume *resume = nullptr);
    void   start_log(const bool goes_on);
    void   step_to_end();
    void   reopen_statistics(const Resume &resume);
    void   fill_table();
    void   step();
    void   advance();
    void   check();
    void   check_obstacles() const;
    void   look_for_fracture();
    void   postprocess();
    void   checkpoint();
    void   write_checkpoint(const bool begins_stage);
    void   finish();
    void   stop();

    /** Runs `work`; the log keeps how it ended. */
    void to_the_end(const std::function<void()> &work);
    void note_failure(const std::exception &error);

    /** Writes summary.json, for other programs: how it ended, and the last row of the statistics. */
    void write_summary(const std::string &end, const std::string &message = "") const;

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

    const Communicator                    communicator;
    Parameters                           &parameters;
    Resources                             resources;
    Timing                                timing;
    unsigned int                          output_section, reference_section, checkpoint_section; // of it
    std::ofstream                         log;
    std::string                           origin; // of the run, for the log
    std::chrono::steady_clock::time_point start    = std::chrono::steady_clock::now();
    unsigned int                          n_told   = 0;     // of the warnings before the first step
    bool                                  is_alone = false; // in an error that other ranks have not met

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

    double       end_time  = 1; // of the run, or of the stage
    unsigned int max_steps = 0; // 0: no limit

    std::vector<std::unique_ptr<Stage>> stages; // none: the run has one part
    const unsigned int                  stage_number;
    double                              stage_begin         = 0; // [time]
    bool                                is_at_rest          = false;
    double                              most_kinetic_energy = 0; // since then [energy]

    struct
    {
      const Resume          *begin = nullptr; // from where; none: this is no trial
      dealii::Tensor<1, dim> position;        // of the watched particle then [length]
      double                 moved      = 0;  // since then [length]
      bool                   has_failed = false;
    } trial;

    Moment                 now;
    unsigned int           first_step = 0; // before which this program has begun
    std::string            last_checkpoint;
    Report                 report;        // of the last step
    Totals<dim>            totals;        // of the last row of the statistics
    dealii::Tensor<1, dim> lost_momentum; // by empty nodes since the start [mass length/time]
  };
} // namespace Talus

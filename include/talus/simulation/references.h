#pragma once

#include <talus/postprocess/comparison.h>
#include <talus/postprocess/load_curve.h>
#include <talus/postprocess/reference_motion.h>
#include <talus/postprocess/verification.h>
#include <talus/steppers/model.h>
#include <talus/steppers/report.h>

namespace Talus
{
  /** What a run is compared with: a finite element reference, a manufactured solution, or nothing. */
  template <int dim>
  class References
  {
  public:
    /**
     * Lets the entries of references that are switched off stand in the file, misspelt ones excepted. Before any other
     * object is made.
     */
    static void allow_idle_entries(Parameters &parameters);

    /** Adds what it keeps on the particles. */
    References(Parameters &parameters, Model<dim> &model, const Communicator &communicator);

    /** Particle fields that a reference which is switched off would have. */
    std::vector<std::string> idle_fields() const;

    /** Sets the initial state that a manufactured solution has. */
    void start(Model<dim> &model);

    /** The time at which a step must end next. */
    double next_stop(const double time, const double end_time) const;

    /** Columns of the statistics, and their numbers for the next row. */
    void add_to(Table &table) const;
    void measure(const double time, const Model<dim> &model);

    /** Adds a step that has led to `now`. */
    void accumulate(const Moment &now, const double end_time, Model<dim> &model);

    /** What they remember of the run so far. */
    void serialize(Archive &archive);

    /** Whether what they remember holds for this end time alone. */
    bool hang_on_end_time() const { return comparison || verification; }

    /** Whether the run has any. */
    bool any() const { return comparison || load_curve || motion || verification; }

    /** Solves, writes into `directory` and says what is to be said of it. Collective. */
    std::string finish(const double time, const double end_time, const std::string &directory, Model<dim> &model);

  private:
    std::unique_ptr<Comparison<dim>> comparison; // with the elastic one
    std::unique_ptr<LoadCurve<dim>>  load_curve; // of the plastic one

    std::unique_ptr<ReferenceMotion<dim>> motion; // of the dynamic one

    std::unique_ptr<Verification<dim>> verification;
    bool                               is_switched_off = false; // the reference, which the file describes
    std::vector<double>                errors;                  // against the solution, in the order of their columns
  };
} // namespace Talus

#pragma once

#include <talus/core/parameters.h>

#include <memory>

namespace Talus
{
  /**
   * A part of a run: how long it lasts, and what it forgets at its begin. What it changes stands in subsections of its
   * section, as it would in the file, and holds from then on. Manual: doc/stages.md.
   */
  class Stage : public dealii::ParameterAcceptor
  {
  public:
    explicit Stage(const std::string &name);

    void parse_parameters(dealii::ParameterHandler &prm) override;

    /** Whether it can end before its time, at rest. */
    bool waits_for_rest() const { return rest > 0; }

    /** `kinetic_energy` and what has been `put_in` since it began [energy]; `unbalanced` [1]: Simulation::unbalanced().
     */
    bool is_at_rest(const double kinetic_energy, const double put_in, const double unbalanced) const
    {
      return waits_for_rest() && kinetic_energy <= rest * put_in && unbalanced <= largest_unbalanced;
    }

    /** Whether it is a search for the factor by which strengths can be divided. */
    bool searches() const { return !factors.empty(); }

    const std::string name;
    double            duration            = 0; // at most [time]
    double            rest                = 0; // kinetic energy over the energy put in; 0: nothing is waited for
    double            largest_unbalanced  = 1e-3;
    bool              resets_displacement = false, resets_plastic_strain = false;

    // Of a search.
    std::vector<double> factors;           // between which it lies
    double              tolerance = 5e-3;  // over the factor
    std::string         probe;             // whose particle is watched
    double              largest_moved = 0; // beyond which it has failed [length]

  private:
    void check_search() const;
  };

  /** The stages of a run, in their order; none where the file has none. */
  class Stages
  {
  public:
    /** Throws InputError where a stage changes what no run can change on its way. */
    explicit Stages(const Parameters &file);

    bool         is_empty() const { return names.empty(); }
    unsigned int size() const { return names.size(); }

    const std::string &name(const unsigned int n) const { return names[n]; }

    /** Whether stage `n` is a search for a factor of safety. */
    bool searches(const unsigned int n) const
    {
      return n < names.size() && !file.value("/Stages/" + names[n], "Strength reduction", "").empty();
    }

    /** What the file says in stage `n`, the first is 0. No object may exist. */
    Parameters parameters(const unsigned int n) const { return file.after_changes(names, n + 1); }

    /** Declares the section, and all stages with what they have of their own. */
    static std::vector<std::unique_ptr<Stage>> declare(Parameters &parameters);

    /** The stage that changes this entry, by its name in the file: "Stages/dig/Run/Local damping"; -1 if none does. */
    int stage_of(const std::string &key) const;

  private:
    void check_search(const unsigned int n) const;

    const Parameters        &file;
    std::vector<std::string> names;
  };
} // namespace Talus

#pragma once

#include <talus/core/archive.h>
#include <talus/core/parameters.h>
#include <talus/grid/grid.h>
#include <talus/postprocess/particle_fields.h>
#include <talus/postprocess/statistics.h>

#include <functional>
#include <optional>

namespace Talus
{
  /** One place or particle that is watched. */
  template <int dim>
  class Probe : public dealii::ParameterAcceptor
  {
  public:
    Probe(const std::string &section, const std::string &name);

    void parse_parameters(dealii::ParameterHandler &prm) override;

    const std::string  name;
    bool               is_particle = false;
    dealii::Point<dim> position;

    dealii::types::particle_index id       = 0;                      // of the tracked particle
    bool                          is_found = false, is_lost = false; // at an earlier begin; with its body
    unsigned int                  slot = 0;                          // where it was last found on this rank

    double              distance = 0; // of the particle from a point [length]
    std::vector<double> values;       // of the fields

  private:
    std::string         kind = "point";
    std::vector<double> coordinates;
  };

  /**
   * Time series at points and of tracked particles, in `probes.csv`.
   *
   * A *point* gives the fields of the particle that is nearest to it at that time,
   * whose distance stands beside them: values jump by the variation between
   * neighbours when another one becomes the nearest. A *particle* is the one whose
   * initial position is nearest to the point, and is followed by its id. Of
   * particles at equal distance the one with the lowest id is taken, so that the
   * table does not depend on the number of ranks. Test: tests/postprocess/probes.cc.
   */
  template <int dim>
  class Probes : public dealii::ParameterAcceptor
  {
  public:
    explicit Probes(Parameters &parameters, const std::string &section = "/Output/Probes");

    /**
     * Finds the tracked particles and opens `directory`/probes.csv; nothing when
     * there is no probe. Throws EntryError on all ranks for a point outside the
     * grid, a particle that nothing is near to, and an unknown field. Collective.
     */
    void open(const std::string &directory, const WorkingSet<dim> &particles, const Grid<dim> &grid);

    /** The same for a run that goes on from `time`. */
    void reopen(const std::string &directory, const double time, const WorkingSet<dim> &particles,
                const Grid<dim> &grid);

    /** Which particles are followed. */
    void serialize(Archive &archive);

    /** The particles have other numbers now: `new_id` says which, or nothing where one is gone. */
    void renumber(const std::function<std::optional<std::uint64_t>(std::uint64_t)> &new_id);

    /** Drops fields from those that the file chooses, of an object that is switched off; before open(). */
    void leave_out(const std::vector<std::string> &names) { Talus::leave_out(names, field_names); }

    /** Appends a row. Collective. */
    void write(const double time, const WorkingSet<dim> &particles);

    /** Where the particle of a probe is, by its name; the same on all ranks. Collective. */
    dealii::Tensor<1, dim> position_of(const std::string &name, const WorkingSet<dim> &particles) const;

    bool is_empty() const { return probes.empty(); }

    /** Sections of probes that follow a particle which is gone. */
    std::vector<std::string> lost() const;

  private:
    void check_position(const Probe<dim> &probe, const Grid<dim> &grid, const double distance) const;
    void sample(const WorkingSet<dim> &particles);
    void find(const WorkingSet<dim> &particles, const Grid<dim> &grid);

    std::vector<std::unique_ptr<Probe<dim>>> probes;
    std::vector<std::string>                 field_names{"position", "velocity", "stress"};
    std::vector<ParticleField<dim>>          fields;
    double                                   time = 0;
    Table                                    table;
    CsvFile                                  file;
    Communicator                             communicator;
  };
} // namespace Talus

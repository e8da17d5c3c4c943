#pragma once

#include <talus/core/parameters.h>
#include <talus/core/table.h>
#include <talus/postprocess/directory_lock.h>
#include <talus/postprocess/statistics.h>
#include <talus/simulation/element_stage.h>

#include <memory>

namespace Talus
{
  /**
   * Takes one material of the section `Materials` through a path of strains or stresses at a single point, as `talus
   * --element FILE` asks, and writes `element.csv`. Every rank computes the same; the first one writes. Throws
   * EntryError and, where a step can not be taken, RunError: what is in the table by then is complete. Theory:
   * doc/element.md. Test: tests/element.
   */
  class Element : public dealii::ParameterAcceptor
  {
  public:
    explicit Element(Parameters &parameters);

    void parse_parameters(dealii::ParameterHandler &prm) override;

    /** The whole path. Collective. */
    void run();

  private:
    /** Where the table goes: the entries of the section `Output` that a run has as well. */
    struct Target : public dealii::ParameterAcceptor
    {
      Target();
      void parse_parameters(dealii::ParameterHandler &prm) override;

      std::string   path      = "output";
      bool          overwrite = false;
      unsigned int  interval  = 1;
      DirectoryLock lock;
    };

    /** Numbers that are derived from the point after a step. */
    struct Derived
    {
      dealii::SymmetricTensor<2, 3> strain;       // ln(F F^T) / 2
      std::array<double, 3>         principal{};  // stresses, the greatest first
      double                        p = 0, q = 0; // [stress]
      double                        energy = 0, plastic_work = 0;
    };

    void build_stages(Parameters &parameters);

    /** The point at the start; throws EntryError for a stress that the material does not bear. */
    ElementPoint start() const;

    void fill_table(Table &table) const;

    /** Files, and warnings. */
    void open(CsvFile &file, const Table &table);

    void derive();
    void take(const ElementStage &stage, const unsigned int k, const std::array<double, 6> &stress_at_start);
    void say(const std::string &text) const;

    /** A line of the summary. */
    std::string state(const std::string &name) const;

    Parameters                                &parameters;
    std::string                                material_name, material_type;
    std::unique_ptr<Material>                  material;
    std::vector<std::unique_ptr<Material>>     others; // which the file describes as well
    std::vector<std::unique_ptr<ElementStage>> stages;
    Target                                     target;
    std::vector<double>                        initial_stress = std::vector<double>(6, 0.); // [stress]
    double                                     pressure       = 0;                          // [stress]
    double                                     spacing        = 1;                          // [length]

    std::unique_ptr<ElementPoint> point;
    ElementControl                control;
    Derived                       derived;
    double                        time = 0, amount = 0;
    unsigned int                  n_steps = 0, stage_number = 0;
  };
} // namespace Talus

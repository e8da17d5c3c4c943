#pragma once

#include <talus/boundary/boundary.h>
#include <talus/fem/elastic_reference.h>
#include <talus/materials/material.h>
#include <talus/particles/working_set.h>

#include <deal.II/base/function_parser.h>

namespace Talus
{
  /** A part of the body over which errors are averaged: where an expression of x, y, z is true. */
  template <int dim>
  class Region : public dealii::ParameterAcceptor
  {
  public:
    Region(const std::string &section, const std::string &name);

    void parse_parameters(dealii::ParameterHandler &prm) override;
    bool contains(const dealii::Point<dim> &x) const { return parser.value(x) != 0; }

    const std::string name;

  private:
    std::string                 expression = "1";
    dealii::FunctionParser<dim> parser;
  };

  /**
   * Compares a run that loads a linear elastic body in proportion to time with a
   * finite element solution at the end time. Elastic waves are averaged out over
   * the last part of the run, t > a t_end,
   * @f[ S = \sum \Delta t\, \sigma(t)\, \frac{t_{end}}{t} \Big/ \sum \Delta t , @f]
   * and so are the forces on the conditions. The relative error of a particle is
   * Eq. (64) at its initial position. Fields: "mean stress", "reference stress",
   * "stress error" [%].
   */
  template <int dim>
  class Comparison : public dealii::ParameterAcceptor
  {
  public:
    Comparison(Parameters &parameters, const std::string &section, const std::vector<std::string> &material_names,
               MPI_Comm communicator);

    void parse_parameters(dealii::ParameterHandler &prm) override;
    void add_fields(WorkingSet<dim> &particles);

    /** What it adds to the particles. */
    static std::vector<std::string> field_names() { return {"mean stress", "reference stress", "stress error"}; }

    /** Adds a step that ended at `time` to the averages. */
    void accumulate(const double time, const double dt, const double end_time, const Boundary<dim> &boundary,
                    WorkingSet<dim> &particles);

    /** The averages so far. */
    void serialize(Archive &archive);

    /** Solves the reference and fills the fields. Collective. */
    void finish(const double end_time, const std::vector<std::unique_ptr<Material>> &materials,
                const std::vector<std::string> &condition_names, WorkingSet<dim> &particles);

    /** Writes errors by region and forces, as a table to `out` and as a file; rank 0. */
    void write(const std::string &file_name, std::ostream &out) const;

  private:
    struct Row
    {
      std::string quantity, name;
      double      value;
      std::string unit;
    };

    /** Errors of all regions from the particles' fields. Collective. */
    void sum_up_regions(const WorkingSet<dim> &particles);

    MPI_Comm                                  communicator;
    ElasticReference<dim>                     reference;
    std::vector<std::unique_ptr<Region<dim>>> regions;
    unsigned int                              material     = 0;
    double                                    average_from = 0.8; // of the end time

    unsigned int                        mean_stress = 0, reference_stress = 0, stress_error = 0;
    double                              averaged_time = 0;
    std::vector<dealii::Tensor<1, dim>> mean_reactions;
    std::vector<Row>                    rows;
  };
} // namespace Talus

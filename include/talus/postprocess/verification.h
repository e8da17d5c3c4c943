#pragma once

#include <talus/core/body_force.h>
#include <talus/core/parameters.h>
#include <talus/materials/material.h>
#include <talus/particles/particles.h>
#include <talus/postprocess/statistics.h>
#include <talus/verification/manufactured_solution.h>

#include <memory>

namespace Talus
{
  /**
   * A run's manufactured solution: it gives the particles their initial velocities and the body force, and measures
   * their errors. An error is the root of the mean over all particles of a square: of the vector x - X - u(X, t),
   * of v - v(X, t), and of the Frobenius norm of the stress's difference (of its components in the plane in 2D), X
   * being where the particle began. Relative ones are over the greatest magnitude that the exact field has had at a
   * particle in what has been measured so far. They are taken at the end of the run and at a quarter of its time,
   * at which a step ends: at the end of a period u and stress pass through zero, which hides errors.
   * Test: tests/verification, tests/regression/verification.py.
   */
  template <int dim>
  class Verification
  {
  public:
    /** The one that the file chooses, or none. */
    static std::unique_ptr<Verification> make(Parameters &parameters, const Communicator &communicator);

    /**
     * Sets velocities and their gradients at t = 0, and the body force, which must not be set otherwise. Throws
     * EntryError unless the run has one material, which is neo-Hookean.
     */
    void start(const std::vector<std::unique_ptr<Material>> &materials, Particles<dim> &particles,
               BodyForce<dim> &body_force);

    /** The next time at which a step must end. */
    double next_stop(const double time, const double end_time) const;

    /** Columns of the errors, and their values for a row. Collective. */
    static std::vector<Column> columns();
    std::vector<double>        errors(const double time, const Particles<dim> &particles);

    /** Keeps the errors for the table if a quarter or the whole of the run is over. Collective. */
    void record(const double time, const double end_time, const unsigned int step, const Particles<dim> &particles);

    /** What has been measured so far. */
    void serialize(Archive &archive);

    /** Writes them to a file, and as a table. Collective. */
    void write(const std::string &file_name, std::ostream &table) const;

  private:
    Verification(std::unique_ptr<ManufacturedSolution<dim>> solution, const Communicator &communicator);

    static constexpr unsigned int n_fields = 3; // u, v, stress

    std::unique_ptr<ManufacturedSolution<dim>> solution;
    Communicator                               communicator;
    std::array<double, n_fields>               largest{}; // magnitude of the exact fields at a particle
    std::vector<std::vector<double>>           rows;      // time, step, errors
  };
} // namespace Talus

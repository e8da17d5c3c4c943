#pragma once

#include <talus/fem/dynamic_reference.h>

namespace Talus
{
  /**
   * The motion of the dynamic finite element reference: a row at equal intervals with the time, its energies, the work
   * done on it, and the displacement of each point of the section. Test: tests/regression/reference_motion.py.
   */
  template <int dim>
  class ReferenceMotion
  {
  public:
    ReferenceMotion(Parameters &parameters, const std::string &section, MPI_Comm communicator);

    /** Moves from rest to `end_time`, writes each row when it is known. Throws RunError. Collective. */
    void compute(const double end_time, const std::string &file_name);

    /** Steps, and how well energy was kept. */
    std::string summary() const;

  private:
    MPI_Comm              communicator;
    DynamicReference<dim> reference;
    double                greatest_energy = 0., greatest_residual = 0.;
  };
} // namespace Talus

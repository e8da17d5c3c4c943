#pragma once

#include <talus/fem/plastic_reference.h>

namespace Talus
{
  /**
   * The load-displacement curve of the plastic finite element reference: a row for each load step with the time,
   * and for each condition its mean displacement and the force of the body on it. Test: tests/regression/load_curve.py.
   */
  template <int dim>
  class LoadCurve
  {
  public:
    LoadCurve(Parameters &parameters, const std::string &section, MPI_Comm communicator);

    /** Solves from rest to `end_time`, writes each row when it is known. Throws RunError. Collective. */
    void compute(const double end_time, const std::string &file_name);

    /** Forces at the end, and what it took. */
    std::string summary() const;

  private:
    MPI_Comm              communicator;
    PlasticReference<dim> reference;
  };
} // namespace Talus

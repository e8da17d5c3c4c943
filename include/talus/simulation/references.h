#pragma once

#include <talus/postprocess/comparison.h>
#include <talus/postprocess/load_curve.h>
#include <talus/steppers/model.h>
#include <talus/steppers/report.h>

namespace Talus
{
  /** The finite element references that a run asks for, and what is compared with them: none, one. */
  template <int dim>
  class References
  {
  public:
    /** Adds what it keeps on the particles. */
    References(Parameters &parameters, Model<dim> &model, const Communicator &communicator);

    /** Adds a step that has led to `now`. */
    void accumulate(const Moment &now, const double end_time, Model<dim> &model);

    /** Solves, writes into `directory` and says what is to be said of it. Collective. */
    std::string finish(const double time, const double end_time, const std::string &directory, Model<dim> &model);

  private:
    std::unique_ptr<Comparison<dim>> comparison; // with the elastic one
    std::unique_ptr<LoadCurve<dim>>  load_curve; // of the plastic one
  };
} // namespace Talus

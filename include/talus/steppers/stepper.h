#pragma once

#include <talus/core/timing.h>
#include <talus/steppers/model.h>
#include <talus/steppers/report.h>

namespace Talus
{
  /** Advances the state of a model in time. */
  template <int dim>
  class Stepper : public dealii::ParameterAcceptor
  {
  public:
    using dealii::ParameterAcceptor::ParameterAcceptor;

    /** Looks at the state before the first step; times of the steps go into sections of `timing`. Collective. */
    virtual Report start(Model<dim> &model, Timing &timing) = 0;

    /** Size of a step from the state that `last` reports of [time]. */
    virtual double step_size(const Model<dim> &model, const Report &last) const = 0;

    /** A step from `time` to time + dt; `last` is the report of the one before. Collective. */
    virtual Report advance(Model<dim> &model, const Report &last, const double time, const double dt) = 0;

    /** What it remembers of the steps before. Collective. */
    virtual void serialize(Archive &archive) = 0;

    /** What a user should know before the first step, or nothing; after start(). */
    virtual std::string warning(const Model<dim> &) const { return ""; }

    /** What it did beyond steps, a line for the end of the log. */
    virtual std::string summary() const { return ""; }
  };
} // namespace Talus

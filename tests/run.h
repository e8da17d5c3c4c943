#pragma once

#include <talus/steppers/stepper.h>

#include "setup.h"

namespace Test
{
  /** A model, its stepper, and the report of its last step. */
  template <int dim>
  struct Run : Text
  {
    explicit Run(const std::string &text) :
      Text(text), model(parameters, MPI_COMM_WORLD),
      stepper(parameters.make<Stepper<dim>>("/Run", "Stepper", "explicit", ""))
    {
      parameters.parse();
      model.create();
      report = stepper->start(model, timing);
    }

    void step(const double dt)
    {
      report = stepper->advance(model, report, time, dt);
      time += dt;
    }

    std::vector<std::vector<double>> columns(const unsigned int field) const
    {
      const auto                      &particles = model.particles;
      std::vector<std::vector<double>> result;
      for (unsigned int c = 0; c < particles.fields[field].n_components; ++c)
        result.emplace_back(particles.component(field, c), particles.component(field, c) + particles.size());
      return result;
    }
    void set_columns(const unsigned int field, const std::vector<std::vector<double>> &values)
    {
      for (unsigned int c = 0; c < values.size(); ++c)
        std::copy(values[c].begin(), values[c].end(), model.particles.component(field, c));
    }

    dealii::Tensor<1, dim> momentum() const
    {
      const auto            &particles = model.particles;
      dealii::Tensor<1, dim> result;
      for (unsigned int p = 0; p < particles.size(); ++p)
        result += particles.component(particles.mass, 0)[p] * particles.vector(particles.velocity, p);
      return dealii::Utilities::MPI::sum(result, MPI_COMM_WORLD);
    }

    Model<dim>                    model;
    std::unique_ptr<Stepper<dim>> stepper;
    Timing                        timing;
    Report                        report;
    double                        time = 0;
  };
} // namespace Test

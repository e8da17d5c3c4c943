#include <talus/simulation/references.h>

#include <talus/core/registry.h>
#include <talus/verification/manufactured_solution.h>

#include <algorithm>
#include <sstream>

namespace Talus
{
  namespace
  {
    const std::string section = "/FEM reference";

    std::string choose_model(Parameters &parameters)
    {
      return parameters.choose_from(
        section, "Model", "linear elastic", "linear elastic|J2|dynamic",
        "'linear elastic': the stress at the end is compared with that of the particles; 'J2': "
        "plasticity, a load-displacement curve is written; 'dynamic': a neo-Hookean body in "
        "motion, displacements at points are written.");
    }
  } // namespace

  template <int dim>
  void References<dim>::allow_idle_entries(Parameters &parameters)
  {
    const auto allow = [&](const std::function<void()> &build) {
      for (const std::string &key : Parameters::declared_by(build))
      {
        const auto slash = key.rfind('/');
        if (slash != std::string::npos)
          parameters.allow(key.substr(0, slash), key.substr(slash + 1));
      }
    };
    if (parameters.value(section, "Compare", "no") == "no" && parameters.has_section(section))
      allow([&] {
        const std::string model     = choose_model(parameters);
        const auto        materials = parameters.names("/Materials", "");
        if (model == "J2")
          LoadCurve<dim>(parameters, section, MPI_COMM_SELF);
        else if (model == "dynamic")
          ReferenceMotion<dim>(parameters, section, MPI_COMM_SELF);
        else if (!materials.empty())
          Comparison<dim>(parameters, section, materials, MPI_COMM_SELF);
      });
    if (parameters.value("/Verification", "Solution", "none") == "none" && parameters.has_section("/Verification"))
      for (const auto &[name, entry] : Registry<ManufacturedSolution<dim>>::get().all())
        allow([&, &make = entry.make] { make(parameters, "/Verification"); });
  }

  template <int dim>
  References<dim>::References(Parameters &parameters, Model<dim> &model, const Communicator &communicator)
  {
    verification = Verification<dim>::make(parameters, communicator);
    if (verification)
      errors.resize(Verification<dim>::columns().size());
    if (parameters.choose_from(section, "Compare", "no", "no|yes",
                               "Solve the problem by finite elements too, for comparison.") == "no")
    {
      is_switched_off = parameters.has_section(section);
      return;
    }
    const std::string reference = choose_model(parameters);
    if (reference == "J2")
      load_curve = std::make_unique<LoadCurve<dim>>(parameters, section, communicator);
    else if (reference == "dynamic")
      motion = std::make_unique<ReferenceMotion<dim>>(parameters, section, communicator);
    else
    {
      comparison = std::make_unique<Comparison<dim>>(parameters, section, model.material_names, communicator);
      comparison->add_fields(model.particles);
    }
  }

  template <int dim>
  std::vector<std::string> References<dim>::idle_fields() const
  {
    return is_switched_off ? Comparison<dim>::field_names() : std::vector<std::string>{};
  }

  template <int dim>
  void References<dim>::start(Model<dim> &model)
  {
    if (verification)
      verification->start(model.materials, model.particles, model.acceleration);
  }

  template <int dim>
  double References<dim>::next_stop(const double time, const double end_time) const
  {
    return verification ? verification->next_stop(time, end_time) : end_time;
  }

  template <int dim>
  void References<dim>::add_to(Table &table) const
  {
    for (unsigned int c = 0; c < errors.size(); ++c)
    {
      const Column column = Verification<dim>::columns()[c];
      table.add(column.name, column.unit, errors[c]);
    }
  }

  template <int dim>
  void References<dim>::measure(const double time, const Model<dim> &model)
  {
    if (!verification)
      return;
    const auto now = verification->errors(time, model.particles);
    std::copy(now.begin(), now.end(), errors.begin()); // which the table reads where they lie
  }

  template <int dim>
  void References<dim>::accumulate(const Moment &now, const double end_time, Model<dim> &model)
  {
    if (comparison && now.step > 0)
      comparison->accumulate(now.time, now.dt, end_time, model.boundary, model.particles);
    if (verification)
      verification->record(now.time, end_time, now.step, model.particles);
  }

  template <int dim>
  void References<dim>::serialize(Archive &archive)
  {
    if (comparison)
      comparison->serialize(archive);
    if (verification)
      verification->serialize(archive);
  }

  template <int dim>
  std::string References<dim>::finish(const double time, const double end_time, const std::string &directory,
                                      Model<dim> &model)
  {
    std::ostringstream text;
    if (comparison && time < end_time)
      text << "\nNo comparison with the finite element reference: the run ended before its end time.\n";
    else if (comparison)
    {
      comparison->finish(end_time, model.materials, model.boundary.names, model.particles);
      comparison->write(directory + "/comparison.csv", text);
    }
    if (verification)
      verification->write(directory + "/verification.csv", text);
    if (load_curve)
    {
      load_curve->compute(end_time, directory + "/load_curve.csv");
      text << load_curve->summary();
    }
    if (motion)
    {
      motion->compute(end_time, directory + "/fem_motion.csv");
      text << motion->summary();
    }
    return text.str();
  }

  template class References<2>;
  template class References<3>;
} // namespace Talus

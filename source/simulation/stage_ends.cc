#include <talus/core/exceptions.h>
#include <talus/simulation/carry_over.h>
#include <talus/simulation/simulation.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace Talus
{
  using namespace dealii;

  template <int dim>
  std::string Simulation<dim>::stage_name() const
  {
    return "'" + stages[stage_number]->name + "', " + std::to_string(stage_number + 1) + " of " +
           std::to_string(stages.size()) + ',';
  }

  template <int dim>
  void Simulation<dim>::begin_stage(const Resume &resume)
  {
    const CheckpointFile file(resume.file);
    repartition_as(file);
    CarryOver<dim> carry_over(file, model);
    carry_over.run([&] { check_places(resume, /* is_exact = */ false); });

    Particles<dim> &particles = model.particles;
    const Stage    &stage     = *stages[stage_number];
    if (stage.resets_displacement)
      for (unsigned int d = 0; d < dim; ++d)
        std::copy_n(particles.component(particles.position, d), particles.size(),
                    particles.component(particles.initial_position, d));
    if (stage.resets_plastic_strain)
      for (const auto &field : particles.fields)
        if (field.name.find("plastic strain") != std::string::npos)
          for (unsigned int c = 0; c < field.n_components; ++c)
            std::fill_n(particles.column(field.first + c), particles.size(), 0.);

    Archive archive = file.archive(0, /* is_exact = */ false);
    now.serialize(archive);
    archive("lost momentum", lost_momentum);
    if (trial.begin == nullptr)
      output.serialize(archive);
    probes.serialize(archive);
    archive.may_lack_names();
    model.serialize(archive);
    probes.renumber([&](const std::uint64_t id) { return carry_over.new_id(id); });
    first_step = now.step;
  }

  template <int dim>
  typename Simulation<dim>::Trial Simulation<dim>::try_out(const Resume &begin, const std::string &origin)
  {
    this->origin = origin;
    trial.begin  = &begin;
    to_the_end([&] {
      set_up(&begin);
      open_output();
      trial.position = probes.position_of(stages[stage_number]->probe, model.particles);
      postprocess();
      step_to_end();
    });
    return model.requests.is_stopped() ? Trial::stopped : trial.has_failed ? Trial::failed : Trial::stands;
  }

  template <int dim>
  void Simulation<dim>::finish_stage()
  {
    if (trial.begin != nullptr)
    {
      look_for_rest();
      finish();
      return;
    }
    const Stage &stage = *stages[stage_number];
    if (stage.waits_for_rest() && !is_at_rest)
    {
      std::ostringstream text;
      text << "stage '" << stage.name << "' has not come to rest within its 'Duration': its kinetic energy is "
           << kinetic_energy_of_nodes() / put_in() << " of what was put in, and the unbalanced forces are " << unbalanced()
           << " of the loads. Give it more time, or 'Local damping' in its section 'Run'";
      say_warning(text.str() + now.text() + '.');
    }
    finish();
    say("Stage " + stage_name() + (is_at_rest ? " ended at rest" : " ended") + now.text() + ".\n");
    if (is_last_stage())
      return;
    write_checkpoint(/* begins_stage = */ true);
    if (model.requests.is_stopped())
      say("Stopped by " + model.requests.signal_name() + ". It goes on with: talus --resume " + output.directory() +
          "\nCheckpoint " + last_checkpoint + '\n');
  }

  template <int dim>
  double Simulation<dim>::put_in() const
  {
    return std::max(energy.put_in(), most_kinetic_energy);
  }

  template <int dim>
  double Simulation<dim>::kinetic_energy_of_nodes() const
  {
    double sum = 0;
    for (const unsigned int i : model.grid.active_nodes)
    {
      const double *numbers = model.grid.fields[i];
      for (unsigned int d = 0; d < dim; ++d)
        sum += 0.5 * numbers[NodalFields<dim>::mass] * std::pow(numbers[NodalFields<dim>::velocity + d], 2);
    }
    return Utilities::MPI::sum(sum, communicator);
  }

  template <int dim>
  double Simulation<dim>::unbalanced() const
  {
    const auto     &grid = model.grid;
    constexpr auto &mass = NodalFields<dim>::mass, &increment = NodalFields<dim>::increment;
    double          sum = 0, weight = 0;
    for (const unsigned int i : grid.active_nodes)
    {
      const double *numbers = grid.fields[i];
      double        square  = 0;
      for (unsigned int d = 0; d < dim; ++d)
        square += numbers[increment + d] * numbers[increment + d];
      sum += numbers[mass] * std::sqrt(square) / now.dt;
    }
    const auto &particles = model.particles;
    const auto  uniform   = model.acceleration.uniform_value(now.time);
    for (unsigned int p = 0; p < particles.size(); ++p)
    {
      const Point<dim> x(particles.vector(
        model.acceleration.is_of_initial_position() ? particles.initial_position : particles.position, p));
      weight += particles.component(particles.mass, 0)[p] *
                (model.acceleration.depends_on_space() ? model.acceleration.value(x, now.time) : uniform).norm();
    }
    double loads = 0, reactions = 0; // of all ranks
    for (const auto &load : model.tractions.loads)
      loads += load->force.norm();
    for (const auto &condition : model.boundary.conditions)
      reactions += condition->nodal_force.norm();
    for (const auto &obstacle : model.boundary.obstacles)
      reactions += obstacle->reaction.norm();
    sum    = Utilities::MPI::sum(sum, communicator);
    weight = std::max({Utilities::MPI::sum(weight, communicator), loads, reactions});
    return weight > 0 ? sum / weight : 0.;
  }

  template <int dim>
  void Simulation<dim>::look_for_rest()
  {
    if (stages.empty())
      return;
    const Stage &stage = *stages[stage_number];
    if (stage.waits_for_rest())
      is_at_rest = stage.is_at_rest(kinetic_energy_of_nodes(), put_in(), unbalanced());
    if (trial.begin == nullptr)
      return;
    trial.moved      = (probes.position_of(stage.probe, model.particles) - trial.position).norm();
    trial.has_failed = trial.moved > stage.largest_moved;
  }

#define INSTANTIATE(dim)                                                                                               \
  template std::string                     Simulation<dim>::stage_name() const;                                        \
  template void                            Simulation<dim>::begin_stage(const Resume &);                               \
  template typename Simulation<dim>::Trial Simulation<dim>::try_out(const Resume &, const std::string &);              \
  template void                            Simulation<dim>::finish_stage();                                            \
  template double                          Simulation<dim>::put_in() const;                                            \
  template double                          Simulation<dim>::unbalanced() const;                                        \
  template double                          Simulation<dim>::kinetic_energy_of_nodes() const;                           \
  template void                            Simulation<dim>::look_for_rest();
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Talus

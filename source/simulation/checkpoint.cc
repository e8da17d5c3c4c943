#include <talus/simulation/simulation.h>

#include <talus/core/command_line.h>
#include <talus/core/exceptions.h>

namespace Talus
{
  using namespace dealii;

  template <int dim>
  void Simulation<dim>::go_on(const Resume &resume, const bool is_longer, const std::string &origin)
  {
    this->origin = origin;
    AssertThrow(!is_longer || !references.hang_on_end_time(),
                InputError("a run that is compared with a reference cannot go on to another end time: what it has "
                           "measured so far belongs to the old one. Leave out 'End time', or start a new run."));
    to_the_end([&] {
      set_up(&resume);
      if (!resume.head.begins_stage)
        restore(resume);
      AssertThrow(!is_finished(), InputError("the run in '" + resume.directory + "' is at its end:" + now.text() +
                                             ". Give a later one, --set \"Run/End time = ...\" or more "
                                             "'Number of steps', if it is to go on."));
      open_output(&resume);
      for (const auto &warning : resume.warnings)
        say_warning(warning + "; it is left out.");
      step_to_end();
    });
  }

  template <int dim>
  void Simulation<dim>::repartition_as(const CheckpointFile &file)
  {
    const auto partition = file.archive(0, false).all_of_rank().at("partition");
    if (!partition.empty() && Utilities::MPI::n_mpi_processes(communicator) > 1)
      model.repartition(Utilities::MPI::this_mpi_process(communicator) == 0 || !model.grid.keeps_places() ?
                          partition :
                          std::vector<double>());
  }

  template <int dim>
  void Simulation<dim>::check_places(const Resume &resume, const bool is_exact) const
  {
    for (unsigned int p = 0; p < model.particles.size(); ++p)
    {
      const auto x         = model.particles.vector(model.particles.position, p);
      const bool is_inside = !model.grid.keeps_places() ? model.grid.contains(x) :
                                                          !is_exact || model.particles.place[p] < model.grid.n_places();
      AssertThrow(std::isfinite(x.norm()) && is_inside,
                  InputError("the checkpoint '" + resume.file + "' has a particle at " + to_text(x) +
                             ", outside the grid of its run. It is not of this run, or was changed."));
    }
  }

  template <int dim>
  void Simulation<dim>::restore(const Resume &resume)
  {
    const unsigned int   rank = Utilities::MPI::this_mpi_process(communicator);
    const CheckpointFile file(resume.file);
    repartition_as(file);
    // Exact if each rank has the part of the grid that it had.
    bool is_same = file.n_ranks == Utilities::MPI::n_mpi_processes(communicator);
    if (is_same)
      is_same = file.archive(rank, true).all_of_rank().at("grid.share") == model.grid.share();
    const bool is_exact = !Utilities::MPI::logical_or(!is_same, communicator);
    Archive    archive  = file.archive(rank, is_exact);
    file.read(model.particles, is_exact, communicator);
    check_places(resume, is_exact);
    model.particles.take_over(is_exact);
    serialize(archive);
    first_step = now.step;
  }

  template <int dim>
  void Simulation<dim>::serialize(Archive &archive)
  {
    now.serialize(archive);
    report.serialize(archive);
    archive("lost momentum", lost_momentum);
    archive("most kinetic energy", most_kinetic_energy);
    model.serialize(archive);
    stepper->serialize(archive);
    energy.serialize(archive);
    fracture.serialize(archive);
    output.serialize(archive);
    probes.serialize(archive);
    references.serialize(archive);
  }

  template <int dim>
  void Simulation<dim>::checkpoint()
  {
    if (trial.begin != nullptr)
      return; // its begin is one
    const bool is_last = model.requests.is_stopped() && !is_finished();
    if (!is_last && !model.requests.wants_checkpoint && !checkpoints.is_due(now))
      return;
    const Timing::Scope scope(timing, checkpoint_section);
    write_checkpoint(/* begins_stage = */ false);
  }

  template <int dim>
  void Simulation<dim>::write_checkpoint(const bool begins_stage)
  {
    Archive archive;
    serialize(archive);
    std::vector<std::string> bodies;
    for (const auto &body : model.bodies)
      bodies.push_back(body->name);
    last_checkpoint = checkpoints.write({version(), parameters.settings_text(), now.step, now.time,
                                         stage_number + (begins_stage ? 1 : 0), begins_stage, stage_begin, bodies},
                                        archive, model.particles);
  }

#define INSTANTIATE(dim)                                                                                               \
  template void Simulation<dim>::go_on(const Resume &, const bool, const std::string &);                               \
  template void Simulation<dim>::restore(const Resume &);                                                              \
  template void Simulation<dim>::repartition_as(const CheckpointFile &);                                               \
  template void Simulation<dim>::check_places(const Resume &, const bool) const;                                       \
  template void Simulation<dim>::write_checkpoint(const bool);                                                         \
  template void Simulation<dim>::serialize(Archive &);                                                                 \
  template void Simulation<dim>::checkpoint();
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Talus

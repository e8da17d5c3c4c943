#include <talus/core/exceptions.h>
#include <talus/particles/column_names.h>
#include <talus/simulation/carry_over.h>

#include <algorithm>
#include <map>

namespace Talus
{
  using namespace dealii;

  template <int dim>
  CarryOver<dim>::CarryOver(const CheckpointFile &file, Model<dim> &model) :
    file(file), model(model), particles(model.particles)
  {
    const auto shared = file.archive(0, /* is_exact = */ false).all_shared();
    if (const auto numbers = shared.find("first ids"); numbers != shared.end())
      for (const double id : numbers->second)
        if (id >= (first_ids.empty() ? 0. : static_cast<double>(first_ids.back())) && id < 1e15)
          first_ids.push_back(static_cast<std::uint64_t>(id));
    for (const auto &name : file.head.bodies)
    {
      const auto found =
        std::find_if(model.bodies.begin(), model.bodies.end(), [&](const auto &body) { return body->name == name; });
      now_called.push_back(found == model.bodies.end() ? -1 : static_cast<int>(found - model.bodies.begin()));
    }
    AssertThrow(!first_ids.empty() && first_ids[0] == 0 && first_ids.size() == now_called.size(),
                InputError("the checkpoint does not say which bodies its run had. It was changed, or is of another "
                           "version of Talus."));
    for (const auto &[name, column] : column_names(particles))
      if (!file.has_column(name))
        missing.push_back(column);
  }

  template <int dim>
  bool CarryOver<dim>::is_new(const unsigned int body) const
  {
    return std::find(now_called.begin(), now_called.end(), static_cast<int>(body)) == now_called.end();
  }

  template <int dim>
  std::optional<std::uint64_t> CarryOver<dim>::new_id(const std::uint64_t id) const
  {
    const unsigned int before = std::upper_bound(first_ids.begin(), first_ids.end(), id) - first_ids.begin() - 1;
    if (now_called.at(before) < 0)
      return {};
    return id - first_ids[before] + model.bodies[now_called[before]]->first_id;
  }

  template <int dim>
  void CarryOver<dim>::run(const std::function<void()> &check)
  {
    keep_created();
    file.read(particles, /* is_exact = */ false, model.grid.communicator, missing);
    check();
    renumber();
    fill_missing();
    append_new();
    particles.take_over(/* as_they_were = */ false);
    start_laws();
  }

  template <int dim>
  typename CarryOver<dim>::Table CarryOver<dim>::exchange(std::map<unsigned int, std::vector<double>> &messages,
                                                          const unsigned int                           n_numbers) const
  {
    Table      table;
    const auto enter = [&](const std::vector<double> &message) {
      for (std::size_t i = 0; i + 1 + n_numbers <= message.size(); i += 1 + n_numbers)
        table[static_cast<std::uint64_t>(message[i])].assign(&message[i + 1], &message[i + 1] + n_numbers);
    };
    if (Utilities::MPI::n_mpi_processes(model.grid.communicator) == 1)
      enter(messages[0]);
    else
      for (const auto &[rank, message] : Utilities::MPI::some_to_some(model.grid.communicator, messages))
        enter(message);
    return table;
  }

  template <int dim>
  void CarryOver<dim>::keep_created()
  {
    const unsigned int                          n_ranks = Utilities::MPI::n_mpi_processes(model.grid.communicator);
    std::map<unsigned int, std::vector<double>> messages;
    for (unsigned int p = 0; p < particles.size(); ++p)
      if (is_new(particles.body[p]))
      {
        new_ids.push_back(particles.id[p]);
        for (unsigned int c = 0; c < particles.n_columns(); ++c)
          new_values.push_back(particles.column(c)[p]);
      }
      else
      {
        // Also where no column is missing: the ids tell whether the bodies are what they were.
        auto &message = messages[particles.id[p] % n_ranks];
        message.push_back(particles.id[p]);
        for (const unsigned int c : missing)
          message.push_back(particles.column(c)[p]);
      }
    created = exchange(messages, missing.size());
  }

  template <int dim>
  void CarryOver<dim>::renumber()
  {
    std::vector<unsigned int> order;
    for (unsigned int p = 0; p < particles.size(); ++p)
      if (const auto id = new_id(particles.id[p]))
      {
        particles.id[p] = static_cast<types::particle_index>(*id);
        order.push_back(p);
      }
    particles.permute(order);
  }

  template <int dim>
  void CarryOver<dim>::fill_missing()
  {
    const MPI_Comm     communicator = model.grid.communicator;
    const unsigned int n_ranks      = Utilities::MPI::n_mpi_processes(communicator),
                       me           = Utilities::MPI::this_mpi_process(communicator);
    // Who asks says where to: his rank, which fits into the numbers of a message.
    std::map<unsigned int, std::vector<double>> questions, answers;
    for (const auto id : particles.id)
    {
      auto &question = questions[id % n_ranks];
      question.push_back(id);
      question.push_back(me);
    }
    std::uint64_t n_unknown = 0;
    for (const auto &[id, from] : exchange(questions, 1))
    {
      const auto found = created.find(id);
      if (found == created.end())
      {
        ++n_unknown;
        continue;
      }
      auto &answer = answers[static_cast<unsigned int>(from[0])];
      answer.push_back(id);
      answer.insert(answer.end(), found->second.begin(), found->second.end());
    }
    n_unknown = Utilities::MPI::sum(n_unknown, communicator);
    AssertThrow(n_unknown == 0,
                InputError(std::to_string(n_unknown) +
                           " particles of the stage before are in none of this one's bodies of their names. Has a file "
                           "that a body is read from changed?"));
    const auto values = exchange(answers, missing.size());
    for (unsigned int p = 0; p < particles.size(); ++p)
      for (unsigned int k = 0; k < missing.size(); ++k)
        particles.column(missing[k])[p] = values.at(particles.id[p])[k];
    created.clear();
  }

  template <int dim>
  void CarryOver<dim>::append_new()
  {
    const unsigned int n_before = particles.size();
    particles.resize(n_before + new_ids.size());
    const double *values = new_values.data();
    for (unsigned int k = 0; k < new_ids.size(); ++k)
    {
      particles.id[n_before + k] = static_cast<types::particle_index>(new_ids[k]);
      for (unsigned int c = 0; c < particles.n_columns(); ++c)
        particles.column(c)[n_before + k] = *values++;
    }
  }

  template <int dim>
  void CarryOver<dim>::start_laws()
  {
    const auto is_missing = [&](const unsigned int field) {
      return std::find(missing.begin(), missing.end(), particles.fields[field].first) != missing.end();
    };
    std::string problem;
    for (unsigned int m = 0; m + 1 < particles.material_begin.size(); ++m)
    {
      const auto &fields = particles.state_fields[m];
      if (std::none_of(fields.begin(), fields.end(), is_missing))
        continue;
      for (unsigned int p = particles.material_begin[m]; p < particles.material_begin[m + 1]; ++p)
      {
        if (is_new(particles.body[p]))
          continue;
        std::array<double, 6> stress{};
        for (unsigned int c = 0; c < particles.n_stress; ++c)
          stress[c] = particles.component(particles.stress, c)[p];
        if (problem.empty())
          problem = model.materials[m]->refusal(stress);
        const auto states = model.materials[m]->initial_states(stress);
        for (unsigned int k = 0; k < states.size(); ++k)
          if (is_missing(fields[k]))
            particles.component(fields[k], 0)[p] = states[k];
      }
      for (const auto &of_rank : Utilities::MPI::all_gather(model.grid.communicator, problem))
        if (!of_rank.empty())
          throw EntryError("/Materials/" + model.material_names[m], "Type",
                           "the particles have stress from the stage before. " + of_rank);
    }
  }

  template class CarryOver<2>;
  template class CarryOver<3>;
} // namespace Talus

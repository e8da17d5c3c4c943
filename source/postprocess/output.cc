#include <talus/core/exceptions.h>
#include <talus/postprocess/files.h>
#include <talus/postprocess/grid_output.h>
#include <talus/postprocess/hdf5_output.h>
#include <talus/postprocess/output.h>
#include <talus/postprocess/particle_output.h>
#include <talus/postprocess/vtu.h>

#include <deal.II/base/utilities.h>

#include <fstream>
#include <sstream>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    // An output that round-off puts this part of an interval too early is in time.
    constexpr double tolerance = 1e-6;

    /** Whether the file ends as a VTU file must: a parallel file system may not notice a full disk. */
    bool is_complete_vtu(const std::string &path)
    {
      const std::string end = "</VTKFile>";
      std::ifstream     file(path, std::ios::binary);
      std::string       text(2 * end.size(), ' ');
      file.seekg(-static_cast<int>(text.size()), std::ios::end);
      file.read(&text[0], text.size());
      return file && text.find(end) != std::string::npos;
    }

    DataOutBase::VtkFlags vtk_flags(const double time, const unsigned int step)
    {
      return DataOutBase::VtkFlags(time, step, /* print_date_and_time = */ false, DataOutBase::VtkFlags::best_speed);
    }

    /** Rank after rank: the head, what `add_to` adds on each, the foot. */
    template <class AddTo>
    void write_vtu_file(const AddTo &add_to, const std::string &final_name, const DataOutBase::VtkFlags &flags,
                        MPI_Comm communicator)
    {
      const std::string  temporary = final_name + ".tmp";
      const RunError     failure("Cannot write '" + final_name + "'. Is the disk full, or the directory gone?");
      const unsigned int my_rank = Utilities::MPI::this_mpi_process(communicator);
      std::ostringstream head, foot;
      VtuText            text;
      if (my_rank == 0)
        DataOutBase::write_vtu_header(head, flags);
      text.add(head.str());
      add_to(text);
      if (my_rank + 1 == Utilities::MPI::n_mpi_processes(communicator))
        DataOutBase::write_vtu_footer(foot);
      text.add(foot.str());
      AssertThrow(write_in_parallel(temporary, text, communicator), failure);
      run_on_root(
        [&] {
          const bool is_good = is_complete_vtu(temporary);
          if (!is_good)
            std::remove(temporary.c_str());
          AssertThrow(is_good, failure);
          rename_file(temporary, final_name);
        },
        communicator);
    }

    template <int dim>
    void write_particles(const WorkingSet<dim> &particles, const std::vector<ParticleField<dim>> &fields,
                         const std::string &name, const DataOutBase::VtkFlags &flags, MPI_Comm communicator)
    {
      write_vtu_file([&](VtuText &text) { add_piece(particles, fields, text); }, name, flags, communicator);
    }

    template <int dim>
    void write_nodes(const Grid<dim> &grid, const bool has_all_cells, const std::string &name,
                     DataOutBase::VtkFlags flags, MPI_Comm communicator)
    {
      flags.physical_units = {{"mass", "mass"}, {"velocity", "length/time"}};
      write_vtu_file(
        [&](VtuText &text) {
          GridOutput<dim> data(grid, has_all_cells);
          text.add(vtu_piece(data.get_patches(), data.get_dataset_names(), data.get_nonscalar_data_ranges(), flags));
        },
        name, flags, communicator);
    }
  } // namespace

  template <int dim>
  Output<dim>::Output(const std::string &section) : ParameterAcceptor(section)
  {
    add_parameter("Directory", path, "Directory into which all files of the run are written.");
    add_parameter("Overwrite", overwrite, "Replace the files of an old run in that directory.");
    add_parameter("Time interval", time_interval, "Time between two outputs [time]; 0: off.", prm, Patterns::Double(0));
    add_parameter("Step interval", step_interval, "Steps between two outputs [1]; 0: off.", prm, Patterns::Integer(0));
    add_parameter("Final state", with_final_state, "Write the state at the end of the run, whatever the intervals.");
    add_parameter("Statistics interval", statistics_interval,
                  "Steps between two rows of statistics.csv and probes.csv [1].", prm, Patterns::Integer(1));
    add_parameter("Statistics time interval", row_interval,
                  "Time between two rows of these tables, beside those by steps [time]; 0: off.", prm,
                  Patterns::Double(0));
    add_parameter(
      "Exact times", is_exact,
      "Steps end at the times that 'Time interval' and 'Statistics time interval' ask for, so that runs of "
      "different steps have them in common; false: what is due comes after the first step beyond its time.");
    add_parameter(
      "Particle fields", field_names,
      "Fields of the particles to write, beside id, body and material: stored ones (velocity, stress, ...), "
      "displacement, von Mises stress, pressure, density, volume ratio, kinetic energy density.");
    add_parameter("Grid", with_grid, "Write mass and velocity of the nodes near material as well.");
    add_parameter("Whole grid", with_whole_grid, "Write all cells of the grid, and not only those near material.");
    add_parameter("CSV", with_csv, "Write the particles as a CSV table as well.");
    add_parameter("HDF5", with_hdf5, "Write the particles as an HDF5 file as well, and particles.xdmf for ParaView.");
  }

  template <int dim>
  void Output<dim>::parse_parameters(ParameterHandler &)
  {
    while (path.size() > 1 && path.back() == '/')
      path.pop_back();
    if (!std::isfinite(time_interval))
      throw EntryError(get_section_name(), "Time interval",
                       "it must be a finite number. Set it to 0 to switch it off.");
    if (!std::isfinite(row_interval))
      throw EntryError(get_section_name(), "Statistics time interval",
                       "it must be a finite number. Set it to 0 to switch it off.");
    next = time_interval > 0 ? 0. : std::numeric_limits<double>::infinity();
  }

  template <int dim>
  void Output<dim>::open(MPI_Comm communicator)
  {
    this->communicator = communicator;
    prepare_directory(path, overwrite, lock, get_section_name(), "Directory", communicator);
  }

  template <int dim>
  void Output<dim>::reopen(MPI_Comm communicator)
  {
    this->communicator = communicator;
    run_on_root(
      [&] {
        remove_numbered_files(path, times.size());
        for (const std::string name : {"particles", "grid"})
          if (!times.empty() && (with_grid || name == "particles"))
            write_series(name);
        if (with_hdf5)
          write_hdf5_series();
      },
      communicator);
  }

  template <int dim>
  void Output<dim>::serialize(Archive &archive)
  {
    const Archive::Scope scope(archive, "output");
    archive("times", times);
    archive("numbers", numbers);
    archive("last step", last_step);
    find_next(); // by the interval that the run has now
  }

  template <int dim>
  void Output<dim>::find_next()
  {
    if (time_interval > 0 && !times.empty())
      next = (std::floor(times.back() / time_interval + tolerance) + 1) * time_interval;
  }

  template <int dim>
  void Output<dim>::check(const WorkingSet<dim> &particles)
  {
    fields = select_particle_fields(particles, field_names, get_section_name(), "Particle fields");
    // These are always written.
    fields.erase(std::remove_if(fields.begin(), fields.end(),
                                [](const auto &field) { return field.name == "body" || field.name == "material"; }),
                 fields.end());
  }

  template <int dim>
  bool Output<dim>::is_due(const double time, const unsigned int step) const
  {
    const bool by_time = time_interval > 0, by_step = step_interval > 0;
    if (is_written(step))
      return false;
    if (times.empty())
      return by_time || by_step;
    return (by_step && step % step_interval == 0) || (by_time && time >= next - tolerance * time_interval);
  }

  template <int dim>
  bool Output<dim>::is_statistics_due(const double time, const double dt, const unsigned int step) const
  {
    const auto n_before = [&](const double t) { return std::floor(t / row_interval + tolerance); };
    return step % statistics_interval == 0 || (row_interval > 0 && n_before(time) > n_before(time - dt));
  }

  template <int dim>
  double Output<dim>::next_stop(const double time) const
  {
    double stop = std::numeric_limits<double>::infinity();
    if (is_exact)
      for (const double interval : {time_interval, row_interval})
        if (interval > 0)
          stop = std::min(stop, (std::floor(time / interval + tolerance) + 1) * interval);
    return stop;
  }

  template <int dim>
  void Output<dim>::write(const double time, const unsigned int step, const WorkingSet<dim> &particles,
                          const Grid<dim> &grid)
  {
    const unsigned int number = times.size();
    times.push_back(time);
    last_step = step;
    find_next();

    const DataOutBase::VtkFlags flags   = vtk_flags(time, step);
    const auto                  path_of = [&](const std::string &name, const std::string &ending) {
      return path + "/" + file_name(name, number, ending);
    };
    write_particles(particles, fields, path_of("particles", ".vtu"), flags, communicator);
    run_on_root([&] { write_series("particles"); }, communicator);
    if (with_csv)
      write_particle_csv(path_of("particles", ".csv"), particles, fields, time, communicator);
    numbers.push_back(
      with_hdf5 ? static_cast<double>(Utilities::MPI::sum<std::uint64_t>(particles.size(), communicator)) : -1.);
    if (with_hdf5)
    {
      write_particle_hdf5(path_of("particles", ".h5"), particles, fields, communicator);
      run_on_root([&] { write_hdf5_series(); }, communicator);
    }
    if (!with_grid)
      return;
    write_nodes(grid, with_whole_grid, path_of("grid", ".vtu"), flags, communicator);
    run_on_root([&] { write_series("grid"); }, communicator);
  }

  template <int dim>
  std::string Output<dim>::file_name(const std::string &name, const unsigned int number,
                                     const std::string &ending) const
  {
    return name + "_" + Utilities::int_to_string(number, 5) + ending;
  }

  template <int dim>
  std::string Output<dim>::write_failure(const double time, const unsigned int step, const WorkingSet<dim> &particles,
                                         const Grid<dim> *grid, MPI_Comm communicator) const
  {
    const DataOutBase::VtkFlags flags = vtk_flags(time, step);
    // What a run may have failed by, whatever the file chooses.
    auto names = field_names;
    names.insert(names.end(), {"velocity", "stress", "deformation gradient", "volume ratio"});
    const auto chosen = select_particle_fields(particles, names, this->get_section_name(), "Particle fields");

    const bool is_part =
      Utilities::MPI::n_mpi_processes(communicator) < Utilities::MPI::n_mpi_processes(this->communicator);
    const std::string number = Utilities::int_to_string(step, 8),
                      name =
                        path + "/failure_" + number +
                        (is_part ? ".rank" + std::to_string(Utilities::MPI::this_mpi_process(this->communicator)) : "");
    write_particles(particles, chosen, name + ".vtu", flags, communicator);
    if (with_csv)
      write_particle_csv(name + ".csv", particles, chosen, time, communicator);
    if (with_grid && grid)
      write_nodes(*grid, with_whole_grid, path + "/failure_grid_" + number + ".vtu", flags, communicator);
    return name + ".vtu";
  }

  template <int dim>
  void Output<dim>::write_series(const std::string &name) const
  {
    std::vector<std::pair<double, std::string>> files;
    for (unsigned int i = 0; i < times.size(); ++i)
      files.emplace_back(times[i], file_name(name, i, ".vtu"));
    write_complete_file(path + "/" + name + ".pvd",
                        [&](std::ostream &out) { DataOutBase::write_pvd_record(out, files); });
  }

  template <int dim>
  void Output<dim>::write_hdf5_series() const
  {
    std::vector<Hdf5Frame> frames;
    for (unsigned int i = 0; i < numbers.size(); ++i)
      if (numbers[i] >= 0)
        frames.push_back({times[i], file_name("particles", i, ".h5"), static_cast<std::uint64_t>(numbers[i])});
    write_complete_file(path + "/particles.xdmf", [&](std::ostream &out) { write_xdmf(out, frames, fields); });
  }

  template class Output<2>;
  template class Output<3>;
} // namespace Talus

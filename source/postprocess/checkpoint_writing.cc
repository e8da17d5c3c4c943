#include <talus/postprocess/checkpoint_file.h>
#include <talus/postprocess/checksum.h>
#include <talus/postprocess/files.h>
#include <talus/postprocess/particle_fields.h>

#include "checkpoint_format.h"
#include "hdf5_writing.h"

#include <deal.II/base/hdf5.h>
#include <deal.II/base/mpi.h>

#include <filesystem>
#include <fstream>

namespace Talus
{
  using namespace dealii;
  namespace fs = std::filesystem;

  namespace
  {
    std::string joined(const std::vector<std::string> &names)
    {
      std::string text;
      for (const auto &name : names)
        text += (text.empty() ? "" : ", ") + name;
      return text;
    }

    /** Writes data sets of which each rank has a part. */
    class Writer
    {
    public:
      Writer(HDF5::File &file, MPI_Comm communicator) :
        begins(file.create_group("begins")), communicator(communicator),
        rank(Utilities::MPI::this_mpi_process(communicator)), n_ranks(Utilities::MPI::n_mpi_processes(communicator))
      {
      }

      /** Where the parts of `n` numbers of each rank begin, and the end; keeps it under `name`. */
      std::vector<double> share(const std::string &name, const std::size_t n)
      {
        std::vector<double> ends(1, 0.);
        for (const std::size_t part : Utilities::MPI::all_gather(communicator, n))
          ends.push_back(ends.back() + part);
        write_shared(begins, name, ends);
        return ends;
      }

      /** A data set of what all ranks have alike: the first rank writes it. */
      void write_shared(HDF5::Group &group, const std::string &name, const std::vector<double> &numbers)
      {
        write<double>(group, name, rank == 0 ? numbers : std::vector<double>(), 0, numbers.size());
      }

      template <typename Number>
      void write(HDF5::Group &group, const std::string &name, const std::vector<double> &numbers,
                 const std::uint64_t begin, const std::uint64_t n_total)
      {
        HDF5::DataSet set = group.create_dataset<Number>(name, {n_total});
        Checksum      sum;
        sum.add(numbers.data(), numbers.size(), begin);
        set.set_attribute("checksum", hexadecimal(Utilities::MPI::sum(sum.value(), communicator)));
        if (n_total == 0)
          return; // HDF5 cannot write nothing into nothing
        const std::vector<Number> converted(numbers.begin(), numbers.end());
        set.write_hyperslab(converted, {numbers.empty() ? 0 : begin}, {numbers.size()});
      }

      HDF5::Group        begins;
      const MPI_Comm     communicator;
      const unsigned int rank, n_ranks;
    };

    template <int dim>
    void write_particles(HDF5::File &file, Writer &writer, const WorkingSet<dim> &particles)
    {
      const auto  ends  = writer.share("particles", particles.size());
      HDF5::Group group = file.create_group("particles");
      const auto  begin = static_cast<std::uint64_t>(ends[writer.rank]), n = static_cast<std::uint64_t>(ends.back());
      using Index = std::conditional_t<sizeof(types::particle_index) == sizeof(unsigned int), unsigned int, double>;
      writer.write<Index>(group, "id", {particles.id.begin(), particles.id.end()}, begin, n);
      if (particles.keeps_places)
        writer.write<unsigned int>(group, "place", {particles.place.begin(), particles.place.end()}, begin, n);
      for (const auto &[name, column] : column_names(particles))
        writer.write<double>(group, name, {particles.column(column), particles.column(column) + particles.size()},
                             begin, n);
    }

    /** What the file takes, and a little more [byte]. */
    template <int dim>
    std::uint64_t size_of(const Archive &archive, const WorkingSet<dim> &particles, MPI_Comm communicator)
    {
      constexpr std::uint64_t of_set = 2000, of_file = 20000;
      std::uint64_t           here   = sizeof(double) * particles.size() * (particles.n_columns() + 2);
      std::size_t             n_sets = particles.n_columns() + 2;
      for (const auto *numbers : {&archive.all_shared(), &archive.all_of_rank()})
        for (const auto &[name, values] : *numbers)
        {
          here += sizeof(double) * values.size();
          n_sets += 2;
        }
      return Utilities::MPI::sum(here, communicator) + of_set * n_sets + of_file;
    }

    template <int dim>
    void write_hdf5(const std::string &path, const CheckpointHead &head, const Archive &archive,
                    const WorkingSet<dim> &particles, MPI_Comm communicator)
    {
      HDF5::File file(path, HDF5::File::FileAccessMode::create, communicator);
      Writer     writer(file, communicator);
      file.set_attribute("format", checkpoint_format);
      file.set_attribute("version", head.version);
      file.set_attribute("parameters", head.parameters);
      file.set_attribute("step", head.step);
      file.set_attribute("time", head.time);
      file.set_attribute("stage", head.stage);
      file.set_attribute("begins stage", head.begins_stage ? 1u : 0u);
      file.set_attribute("stage begin", head.stage_begin);
      file.set_attribute("bodies", joined(head.bodies));
      file.set_attribute("ranks", writer.n_ranks);
      write_particles(file, writer, particles);
      HDF5::Group numbers = file.create_group("numbers"), of_ranks = file.create_group("ranks");
      for (const auto &[name, values] : archive.all_shared())
        writer.write_shared(numbers, name, values);
      for (const auto &[name, values] : archive.all_of_rank())
      {
        const auto ends = writer.share(name, values.size());
        writer.write<double>(of_ranks, name, values, ends[writer.rank], ends.back());
      }
    }

    /** Appends the line that says that the file is complete. */
    void write_end(const std::string &path, MPI_Comm communicator)
    {
      std::error_code     ignored; // a file of no bytes has another end
      const bool          is_root = Utilities::MPI::this_mpi_process(communicator) == 0;
      const std::uint64_t n_bytes =
        Utilities::MPI::broadcast(communicator, is_root ? static_cast<std::uint64_t>(fs::file_size(path, ignored)) : 0);
      const std::string line = end_of_checkpoint(n_bytes, checksum_of_file(path, n_bytes, communicator));
      run_on_root(
        [&] {
          std::ofstream file(path, std::ios::binary | std::ios::app);
          file << line;
          file.close();
          AssertThrow(file, RunError("Cannot write '" + path + "'. Is the disk full, or the directory gone?"));
        },
        communicator);
    }
  } // namespace

  template <int dim>
  void write_checkpoint(const std::string &path, const CheckpointHead &head, const Archive &archive,
                        const WorkingSet<dim> &particles, MPI_Comm communicator)
  {
    const std::string temporary = path + ".tmp";
    const auto        n_bytes   = size_of(archive, particles, communicator);
    write_hdf5_file(
      temporary, n_bytes, [&] { write_hdf5(temporary, head, archive, particles, communicator); },
      "Cannot write '" + path + "'. Is the disk full, or the directory gone?", communicator);
    write_end(temporary, communicator);
    run_on_root([&] { rename_file(temporary, path); }, communicator);
  }

  template void write_checkpoint(const std::string &, const CheckpointHead &, const Archive &, const WorkingSet<2> &,
                                 MPI_Comm);
  template void write_checkpoint(const std::string &, const CheckpointHead &, const Archive &, const WorkingSet<3> &,
                                 MPI_Comm);
} // namespace Talus

#include <talus/postprocess/checkpoint_file.h>

#include "checkpoint_format.h"

#include <deal.II/base/hdf5.h>
#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

namespace Talus
{
  using namespace dealii;
  namespace fs = std::filesystem;

  namespace
  {
    /** A thing of the HDF5 library, closed at the end. deal.II's interface opens files for writing alone. */
    class Hid
    {
    public:
      Hid(const hid_t id, herr_t (*close)(hid_t), const std::string &what) : id(id), close(close)
      {
        AssertThrow(id >= 0, InputError("the checkpoint " + what + " cannot be opened. It was written by another " +
                                        "version of Talus, or by another program."));
      }
      ~Hid() { close(id); }
      Hid(const Hid &) = delete;

      operator hid_t() const { return id; }

    private:
      const hid_t id;
      herr_t (*close)(hid_t);
    };

    /** The HDF5 library says nothing as long as this is there. */
    class Silence
    {
    public:
      Silence()
      {
        H5Eget_auto2(H5E_DEFAULT, &before, &data);
        H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
      }
      ~Silence() { H5Eset_auto2(H5E_DEFAULT, before, data); }
      Silence(const Silence &) = delete;

    private:
      H5E_auto2_t before = nullptr;
      void       *data   = nullptr;
    };

    void check(const bool holds, const std::string &what)
    {
      AssertThrow(holds, InputError("the checkpoint has no valid '" + what +
                                    "'. It was written by another version of Talus, or by another program."));
    }

    std::string text_attribute(const hid_t object, const std::string &name)
    {
      const Hid attribute(H5Aopen(object, name.c_str(), H5P_DEFAULT), H5Aclose, "attribute '" + name + "'");
      const Hid type(H5Aget_type(attribute), H5Tclose, "attribute '" + name + "'");
      check(H5Tis_variable_str(type) > 0, name);
      char *text = nullptr;
      check(H5Aread(attribute, type, &text) >= 0 && text != nullptr, name);
      const std::string result = text;
      H5free_memory(text);
      return result;
    }

    double number_attribute(const hid_t object, const std::string &name)
    {
      const Hid attribute(H5Aopen(object, name.c_str(), H5P_DEFAULT), H5Aclose, "attribute '" + name + "'");
      const Hid space(H5Aget_space(attribute), H5Sclose, "attribute '" + name + "'");
      double    number = 0;
      check(H5Sget_simple_extent_npoints(space) == 1 && H5Aread(attribute, H5T_NATIVE_DOUBLE, &number) >= 0 &&
              std::isfinite(number),
            name);
      return number;
    }

    unsigned int count_attribute(const hid_t object, const std::string &name)
    {
      const double number = number_attribute(object, name);
      check(number >= 0 && number < std::numeric_limits<unsigned int>::max() && number == std::floor(number), name);
      return static_cast<unsigned int>(number);
    }
  } // namespace

  struct CheckpointFile::Handle
  {
    Silence silence;
    Hid     file;

    explicit Handle(const std::string &path) :
      file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose, "'" + path + "'")
    {
    }
  };

  std::string damage_of_checkpoint(const std::string &path, MPI_Comm communicator)
  {
    const std::size_t length  = end_of_checkpoint(0, 0).size();
    std::uint64_t     n_bytes = 0;
    std::string       line(length, ' ');
    if (Utilities::MPI::this_mpi_process(communicator) == 0)
    {
      std::error_code error;
      const auto      size = fs::file_size(path, error);
      std::ifstream   file(path, std::ios::binary);
      if (!error && size > length && file)
      {
        n_bytes = size - length;
        file.seekg(n_bytes);
        file.read(&line[0], length);
      }
    }
    n_bytes = Utilities::MPI::broadcast(communicator, n_bytes);
    line    = Utilities::MPI::broadcast(communicator, line);
    if (line.compare(0, 17, end_of_checkpoint(0, 0), 0, 17) != 0)
      return "'" + path + "' is not a complete checkpoint";
    if (line != end_of_checkpoint(n_bytes, checksum_of_file(path, n_bytes, communicator)))
      return "'" + path + "' is damaged: its checksum is not that of its bytes";
    return "";
  }

  CheckpointFile::CheckpointFile(const std::string &path) : path(path), file(std::make_unique<Handle>(path))
  {
    const hid_t  id     = file->file;
    const double format = number_attribute(id, "format");
    AssertThrow(format == checkpoint_format,
                InputError("the checkpoint '" + path + "' has the format " + std::to_string(static_cast<int>(format)) +
                           ", and this version of Talus reads format " + std::to_string(checkpoint_format) +
                           ". Go on with the version that wrote it."));
    head.version      = text_attribute(id, "version");
    head.parameters   = text_attribute(id, "parameters");
    head.step         = count_attribute(id, "step");
    head.time         = number_attribute(id, "time");
    head.stage        = count_attribute(id, "stage");
    head.begins_stage = count_attribute(id, "begins stage") != 0;
    head.stage_begin  = number_attribute(id, "stage begin");
    head.bodies       = Utilities::split_string_list(text_attribute(id, "bodies"));
    n_ranks           = count_attribute(id, "ranks");
    n_particles       = begins("particles").back();
    check(size("particles/id") == n_particles, "particles/id");
  }

  CheckpointFile::~CheckpointFile() = default;

  std::uint64_t CheckpointFile::size(const std::string &name) const
  {
    const Hid set(H5Dopen2(file->file, name.c_str(), H5P_DEFAULT), H5Dclose, "data set '" + name + "'");
    const Hid space(H5Dget_space(set), H5Sclose, "data set '" + name + "'");
    check(H5Sget_simple_extent_ndims(space) == 1, name);
    return H5Sget_simple_extent_npoints(space);
  }

  bool CheckpointFile::has_column(const std::string &name) const
  {
    return H5Lexists(file->file, ("particles/" + name).c_str(), H5P_DEFAULT) > 0;
  }

  std::vector<std::uint64_t> CheckpointFile::begins(const std::string &name) const
  {
    const std::string set = "begins/" + name;
    check(size(set) == n_ranks + 1ull, set);
    std::vector<std::uint64_t> result;
    for (const double begin : numbers(set, 0, n_ranks + 1ull))
    {
      constexpr double most = 9007199254740992.; // beyond which doubles are no longer whole numbers apart
      check(begin >= (result.empty() ? 0. : static_cast<double>(result.back())) && begin <= most, set);
      result.push_back(static_cast<std::uint64_t>(begin));
    }
    return result;
  }

  void CheckpointFile::read_numbers(const std::string &name, const std::uint64_t begin, const std::uint64_t end,
                                    double *to) const
  {
    const Hid set(H5Dopen2(file->file, name.c_str(), H5P_DEFAULT), H5Dclose, "data set '" + name + "'");
    const Hid space(H5Dget_space(set), H5Sclose, "data set '" + name + "'");
    check(H5Sget_simple_extent_ndims(space) == 1 && begin <= end &&
            end <= static_cast<std::uint64_t>(H5Sget_simple_extent_npoints(space)),
          name);
    if (begin == end)
      return;
    const hsize_t offset = begin, count = end - begin;
    const Hid     memory(H5Screate_simple(1, &count, nullptr), H5Sclose, "data set '" + name + "'");
    check(H5Sselect_hyperslab(space, H5S_SELECT_SET, &offset, nullptr, &count, nullptr) >= 0 &&
            H5Dread(set, H5T_NATIVE_DOUBLE, memory, space, H5P_DEFAULT, to) >= 0,
          name);
  }

  std::vector<double> CheckpointFile::numbers(const std::string &name, const std::uint64_t begin,
                                              const std::uint64_t end) const
  {
    check(begin <= end && end <= size(name), name); // before memory is taken
    std::vector<double> result(end - begin);
    read_numbers(name, begin, end, result.data());
    return result;
  }

  std::vector<std::string> CheckpointFile::names(const std::string &group) const
  {
    const Hid                id(H5Gopen2(file->file, group.c_str(), H5P_DEFAULT), H5Gclose, "group '" + group + "'");
    std::vector<std::string> result;
    const auto               note = [](hid_t, const char *name, const H5L_info_t *, void *list) -> herr_t {
      static_cast<std::vector<std::string> *>(list)->push_back(name);
      return 0;
    };
    check(H5Literate(id, H5_INDEX_NAME, H5_ITER_INC, nullptr, note, &result) >= 0, group);
    return result;
  }

  Archive CheckpointFile::archive(const unsigned int rank, const bool is_exact) const
  {
    Archive::Numbers shared, own;
    for (const auto &name : names("numbers"))
      shared[name] = numbers("numbers/" + name, 0, size("numbers/" + name));
    for (const auto &name : names("ranks"))
    {
      const auto ends = begins(name);
      own[name]       = is_exact ? numbers("ranks/" + name, ends.at(rank), ends.at(rank + 1)) :
                                   numbers("ranks/" + name, 0, ends.back());
    }
    return Archive(std::move(shared), std::move(own), is_exact);
  }

  template <int dim>
  void CheckpointFile::read(WorkingSet<dim> &particles, const bool is_exact, MPI_Comm communicator,
                            const std::vector<unsigned int> &others) const
  {
    const std::uint64_t rank  = Utilities::MPI::this_mpi_process(communicator),
                        n_now = Utilities::MPI::n_mpi_processes(communicator);
    std::uint64_t begin = n_particles * rank / n_now, end = n_particles * (rank + 1) / n_now;
    if (is_exact)
    {
      const auto ends = begins("particles");
      begin           = ends.at(rank);
      end             = ends.at(rank + 1);
    }
    particles.resize(end - begin);
    std::vector<std::string>   read;
    std::vector<std::uint64_t> sums, n_infinite;
    const auto                 add_up = [&](const std::string &name, const double *values) {
      Checksum sum;
      sum.add(values, end - begin, begin);
      read.push_back("particles/" + name);
      sums.push_back(sum.value());
      n_infinite.push_back(
                        std::count_if(values, values + (end - begin), [](const double x) { return !std::isfinite(x); }));
    };
    const auto whole_numbers = [&](const std::string &name, auto &to) {
      const auto values = numbers("particles/" + name, begin, end);
      add_up(name, values.data());
      std::copy(values.begin(), values.end(), to.begin());
    };
    whole_numbers("id", particles.id);
    if (particles.keeps_places && is_exact)
      whole_numbers("place", particles.place);
    for (const auto &[name, column] : column_names(particles))
    {
      if (std::find(others.begin(), others.end(), column) != others.end())
        continue;
      read_numbers("particles/" + name, begin, end, particles.column(column));
      add_up(name, particles.column(column));
    }
    Utilities::MPI::sum(sums, communicator, sums);
    Utilities::MPI::sum(n_infinite, communicator, n_infinite);
    for (unsigned int k = 0; k < read.size(); ++k)
    {
      const Hid set(H5Dopen2(file->file, read[k].c_str(), H5P_DEFAULT), H5Dclose, "data set '" + read[k] + "'");
      AssertThrow(text_attribute(set, "checksum") == hexadecimal(sums[k]),
                  InputError("the checkpoint '" + path + "' is wrong: the checksum of '" + read[k] +
                             "' is not that of its numbers. Remove the file to go on from the one before."));
      AssertThrow(n_infinite[k] == 0,
                  InputError("the checkpoint '" + path + "' is wrong: '" + read[k] + "' has " +
                             std::to_string(n_infinite[k]) +
                             " numbers that are not finite. Remove the file to go on from the one before."));
    }
  }

  template void CheckpointFile::read(WorkingSet<2> &, const bool, MPI_Comm, const std::vector<unsigned int> &) const;
  template void CheckpointFile::read(WorkingSet<3> &, const bool, MPI_Comm, const std::vector<unsigned int> &) const;
} // namespace Talus

#include <talus/postprocess/files.h>
#include <talus/postprocess/hdf5_output.h>

#include "hdf5_writing.h"
#include "particle_layout.h"

#include <deal.II/base/hdf5.h>
#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>
#include <functional>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    /** A data set: a row of numbers for each particle. */
    template <int dim>
    struct RowsOfNumbers
    {
      std::string                                                                 name, unit;
      unsigned int                                                                width;
      std::function<void(const WorkingSet<dim> &, const unsigned int p, float *)> row;
    };

    /** Where the six components of a symmetric tensor in ParaView's order stand among the nine of its rows. */
    constexpr std::array<unsigned int, 9> symmetric = {{0, 3, 5, 3, 1, 4, 5, 4, 2}};

    template <int dim>
    std::vector<RowsOfNumbers<dim>> rows_of(const std::vector<ParticleField<dim>> &fields)
    {
      using Set = WorkingSet<dim>;
      std::vector<RowsOfNumbers<dim>> all;
      all.push_back({"body", "1", 1, [](const Set &set, const unsigned int p, float *row) { *row = set.body[p]; }});
      all.push_back(
        {"material", "1", 1, [](const Set &set, const unsigned int p, float *row) { *row = set.material_of(p); }});
      for (const auto &field : fields)
      {
        const ArrayLayout  layout = layout_of(field);
        const unsigned int n = field.components.size(), n_given = layout.others.size(),
                           width = n_given == 6 ? 9 : n_given;
        const auto row           = [field, layout, n, n_given](const Set &set, const unsigned int p, float *to) {
          std::array<double, 32> values;
          std::array<float, 32>  numbers;
          AssertThrow(n <= values.size(), ExcInternalError());
          field.evaluate(set, p, values.data());
          std::copy(layout.others.begin(), layout.others.end(), numbers.begin());
          for (unsigned int c = 0; c < n; ++c)
            numbers[layout.place[c]] = single(values[c]);
          if (n_given == 6)
            for (unsigned int c = 0; c < 9; ++c)
              to[c] = numbers[symmetric[c]];
          else
            std::copy_n(numbers.begin(), n_given == 0 ? n : n_given, to);
        };
        if (width > 0)
          all.push_back({array_name(field), field.unit, width, row});
        for (unsigned int c = 0; width == 0 && c < n; ++c)
          all.push_back(
            {field.components[c], field.unit, 1, [row, n, c](const Set &set, const unsigned int p, float *to) {
               std::array<float, 32> numbers;
               row(set, p, numbers.data());
               *to = numbers[c];
             }});
      }
      return all;
    }

    /** Of all ranks' particles in one file: how many there are, and where this rank's begin. */
    struct Share
    {
      std::uint64_t begin = 0, n = 0, n_total = 0;
    };

    template <typename Number>
    void write(HDF5::File &file, const std::string &name, const std::string &unit, const std::vector<Number> &numbers,
               const Share &share, const unsigned int width)
    {
      HDF5::DataSet set = width == 1 ? file.create_dataset<Number>(name, {share.n_total}) :
                                       file.create_dataset<Number>(name, {share.n_total, width});
      set.set_attribute("unit", unit);
      if (share.n_total == 0)
        return; // HDF5 cannot write nothing into nothing
      const hsize_t begin = share.n == 0 ? 0 : share.begin;
      if (width == 1)
        set.write_hyperslab(numbers, {begin}, {share.n});
      else
        set.write_hyperslab(numbers, {begin, 0}, {share.n, width});
    }

    template <int dim>
    void write_sets(const std::string &path, const WorkingSet<dim> &particles,
                    const std::vector<RowsOfNumbers<dim>> &all, const Share &share, MPI_Comm communicator)
    {
      HDF5::File                file(path, HDF5::File::FileAccessMode::create, communicator);
      const auto                x = particles.template components<dim>(particles.position);
      std::vector<double>       places(3 * share.n, 0.);
      std::vector<unsigned int> vertices(share.n);
      for (unsigned int p = 0; p < share.n; ++p)
      {
        for (unsigned int d = 0; d < dim; ++d)
          places[3 * std::size_t{p} + d] = x[d][p];
        vertices[p] = static_cast<unsigned int>(share.begin + p);
      }
      write(file, "points", "length", places, share, 3);
      places.assign(particles.id.begin(), particles.id.end());
      write(file, "id", "1", places, share, 1);
      write(file, "vertices", "1", vertices, share, 1);
      std::vector<float> numbers;
      for (const auto &set : all)
      {
        numbers.assign(std::size_t{set.width} * share.n, 0.f);
        for (unsigned int p = 0; p < share.n; ++p)
          set.row(particles, p, &numbers[std::size_t{set.width} * p]);
        write(file, set.name, set.unit, numbers, share, set.width);
      }
    }
  } // namespace

  template <int dim>
  void write_particle_hdf5(const std::string &path, const WorkingSet<dim> &particles,
                           const std::vector<ParticleField<dim>> &fields, MPI_Comm communicator)
  {
    const auto all = rows_of(fields);
    Share      share;
    share.n       = particles.size();
    share.n_total = Utilities::MPI::sum(share.n, communicator);
    MPI_Exscan(&share.n, &share.begin, 1, MPI_UINT64_T, MPI_SUM, communicator);
    if (Utilities::MPI::this_mpi_process(communicator) == 0)
      share.begin = 0;
    constexpr std::uint64_t of_set = 2000, of_file = 20000;
    std::uint64_t           of_particle = 3 * sizeof(double) + sizeof(double) + sizeof(unsigned int);
    for (const auto &set : all)
      of_particle += sizeof(float) * set.width;
    const std::string temporary = path + ".tmp";
    write_hdf5_file(
      temporary, of_particle * share.n_total + of_set * (3 + all.size()) + of_file,
      [&] { write_sets(temporary, particles, all, share, communicator); },
      "Cannot write '" + path + "'. Is the disk full, or the directory gone?", communicator);
    run_on_root([&] { rename_file(temporary, path); }, communicator);
  }

  template <int dim>
  void write_xdmf(std::ostream &out, const std::vector<Hdf5Frame> &frames,
                  const std::vector<ParticleField<dim>> &fields)
  {
    const auto all = rows_of(fields);
    out << "<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\">\n<Domain>\n"
        << "<Grid Name=\"particles\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
    for (const auto &frame : frames)
    {
      const std::string n    = std::to_string(frame.n_particles);
      const auto        item = [&](const std::string &name, const unsigned int width, const std::string &type) {
        return "<DataItem Dimensions=\"" + n + (width > 1 ? " " + std::to_string(width) : "") + "\" " + type +
               " Format=\"HDF\">" + frame.file + ":/" + name + "</DataItem>";
      };
      std::string time;
      append_number(time, frame.time);
      const std::string of_double = "NumberType=\"Float\" Precision=\"8\"",
                        of_float  = "NumberType=\"Float\" Precision=\"4\"";
      out << "<Grid Name=\"particles\" GridType=\"Uniform\">\n<Time Value=\"" << time << "\"/>\n"
          << "<Topology TopologyType=\"Polyvertex\" NumberOfElements=\"" << n << "\" NodesPerElement=\"1\">"
          << item("vertices", 1, "NumberType=\"UInt\"") << "</Topology>\n"
          << "<Geometry GeometryType=\"XYZ\">" << item("points", 3, of_double) << "</Geometry>\n"
          << "<Attribute Name=\"id\" AttributeType=\"Scalar\" Center=\"Node\">" << item("id", 1, of_double)
          << "</Attribute>\n";
      for (const auto &set : all)
      {
        const std::string type = set.width == 1 ? "Scalar" : set.width == 3 ? "Vector" : "Tensor";
        out << "<Attribute Name=\"" << set.name << "\" AttributeType=\"" << type << "\" Center=\"Node\">"
            << item(set.name, set.width, of_float) << "</Attribute>\n";
      }
      out << "</Grid>\n";
    }
    out << "</Grid>\n</Domain>\n</Xdmf>\n";
  }

#define INSTANTIATE(dim)                                                                                               \
  template void write_particle_hdf5(const std::string &, const WorkingSet<dim> &,                                      \
                                    const std::vector<ParticleField<dim>> &, MPI_Comm);                                \
  template void write_xdmf(std::ostream &, const std::vector<Hdf5Frame> &, const std::vector<ParticleField<dim>> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Talus

#include <talus/postprocess/files.h>
#include <talus/postprocess/particle_output.h>
#include <talus/postprocess/vtu.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cstdint>
#include <numeric>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    /** Where the components of a field stand in an array of a VTU file, and what the others are. */
    struct Layout
    {
      std::vector<unsigned int> place; // of each component
      std::vector<float>        others;
      std::vector<std::string>  names; // of components; none where ParaView has its own
    };

    template <int dim>
    Layout layout_of(const ParticleField<dim> &field)
    {
      const unsigned int n       = field.components.size();
      const auto         ends_in = [&](const unsigned int c, const std::string &end) {
        const std::string &name = field.components[c];
        return name.size() > end.size() && name.compare(name.size() - end.size(), end.size(), end) == 0;
      };
      if (n == 1)
        return {{0}, {0.f}, {}};
      Layout layout;
      for (unsigned int c = 0; c < n; ++c)
        layout.place.push_back(c);
      if (field.is_vector)
        layout.others.assign(3, 0.f);
      else if (n >= 4 && ends_in(0, "_xx") && ends_in(2, "_zz"))
      {
        // xx, yy, zz, xy, xz, yz
        layout.others.assign(6, 0.f);
        if (n == 6)
          std::swap(layout.place[4], layout.place[5]);
        layout.names = {"XX", "YY", "ZZ", "XY", "YZ", "XZ"};
      }
      else if (n == dim * dim && ends_in(0, "_xx") && ends_in(1, "_xy"))
      {
        layout.others.assign(9, 0.f);
        for (unsigned int c = 0; c < n; ++c)
          layout.place[c] = 3 * (c / dim) + c % dim;
        if (dim == 2 && field.name == "deformation gradient")
          layout.others[8] = 1;
        layout.names = {"XX", "XY", "XZ", "YX", "YY", "YZ", "ZX", "ZY", "ZZ"};
      }
      return layout;
    }

    /** Field names have no characters that XML would mind. */
    std::string array_head(const std::string &type, const std::string &name, const Layout &layout,
                           const std::string &unit)
    {
      std::string text = "    <DataArray type=\"" + type + "\" Name=\"" + name + "\"";
      if (layout.others.size() > 1)
        text += " NumberOfComponents=\"" + std::to_string(layout.others.size()) + "\"";
      for (unsigned int c = 0; c < layout.names.size(); ++c)
        text += " ComponentName" + std::to_string(c) + "=\"" + layout.names[c] + "\"";
      return text + (unit.empty() ? "" : " units=\"" + unit + "\"") + " format=\"binary\">\n";
    }

    template <class Number>
    std::string array_text(const std::string &type, const std::string &name, const std::vector<Number> &numbers)
    {
      return array_head(type, name, {{}, {0.f}, {}}, "") + vtu_numbers(numbers) + "    </DataArray>\n";
    }

    /** A field of all particles; one that is neither vector nor tensor as an array for each component. */
    template <int dim>
    void append_field(const WorkingSet<dim> &particles, const ParticleField<dim> &field, std::string &text)
    {
      const Layout        layout = layout_of(field);
      const unsigned int  n = field.components.size(), width = layout.others.size();
      std::vector<double> values(n);
      if (width == 0)
      {
        for (unsigned int c = 0; c < n; ++c)
        {
          std::vector<float> numbers(particles.size());
          for (unsigned int p = 0; p < particles.size(); ++p)
          {
            field.evaluate(particles, p, values.data());
            numbers[p] = static_cast<float>(values[c]);
          }
          text += array_head("Float32", field.components[c], {{}, {0.f}, {}}, field.unit) + vtu_numbers(numbers) +
                  "    </DataArray>\n";
        }
        return;
      }
      std::vector<float> numbers(std::size_t{width} * particles.size());
      for (unsigned int p = 0; p < particles.size(); ++p)
      {
        float *to = &numbers[std::size_t{width} * p];
        std::copy(layout.others.begin(), layout.others.end(), to);
        field.evaluate(particles, p, values.data());
        for (unsigned int c = 0; c < n; ++c)
          to[layout.place[c]] = static_cast<float>(values[c]);
      }
      std::string name = field.name;
      std::replace(name.begin(), name.end(), ' ', '_');
      text += array_head("Float32", name, layout, field.unit) + vtu_numbers(numbers) + "    </DataArray>\n";
    }

    template <int dim>
    std::string cells_text(const unsigned int n)
    {
      std::vector<std::int32_t> connectivity(n), offsets(n);
      std::iota(connectivity.begin(), connectivity.end(), 0);
      std::iota(offsets.begin(), offsets.end(), 1);
      constexpr std::uint8_t vertex = 1;
      return "  <Cells>\n" + array_text("Int32", "connectivity", connectivity) +
             array_text("Int32", "offsets", offsets) +
             array_text("UInt8", "types", std::vector<std::uint8_t>(n, vertex)) + "  </Cells>\n";
    }
  } // namespace

  template <int dim>
  std::string particle_piece(const WorkingSet<dim> &particles, const std::vector<ParticleField<dim>> &fields)
  {
    const unsigned int  n = particles.size();
    const auto          x = particles.template components<dim>(particles.position);
    std::vector<double> places(3 * std::size_t{n}, 0.), ids(particles.id.begin(), particles.id.end());
    std::vector<float>  bodies(particles.body.begin(), particles.body.end()), materials(n);
    for (unsigned int p = 0; p < n; ++p)
    {
      for (unsigned int d = 0; d < dim; ++d)
        places[3 * std::size_t{p} + d] = x[d][p];
      materials[p] = static_cast<float>(particles.material_of(p));
    }
    const std::string number = std::to_string(n);
    std::string text = "<Piece NumberOfPoints=\"" + number + "\" NumberOfCells=\"" + number + "\">\n  <Points>\n" +
                       "    <DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"binary\">\n" +
                       vtu_numbers(places) + "    </DataArray>\n  </Points>\n" + cells_text<dim>(n) +
                       "  <PointData Scalars=\"scalars\">\n" + array_text("Float64", "id", ids) +
                       array_text("Float32", "body", bodies) + array_text("Float32", "material", materials);
    for (const auto &field : fields)
      append_field(particles, field, text);
    return text + "  </PointData>\n</Piece>\n";
  }

  namespace
  {
    /** The table of this rank's particles, column by column: id, body, material, position, fields. */
    template <int dim>
    std::vector<std::vector<double>> columns_of(const WorkingSet<dim>                 &particles,
                                                const std::vector<ParticleField<dim>> &fields)
    {
      const auto                       x = particles.template components<dim>(particles.position);
      std::vector<std::vector<double>> columns(3 + dim + n_components(fields), std::vector<double>(particles.size()));
      std::vector<double>              values(columns.size());
      for (unsigned int p = 0; p < particles.size(); ++p)
      {
        values[0] = particles.id[p];
        values[1] = particles.body[p];
        values[2] = particles.material_of(p);
        for (unsigned int d = 0; d < dim; ++d)
          values[3 + d] = x[d][p];
        unsigned int c = 3 + dim;
        for (const auto &field : fields)
        {
          field.evaluate(particles, p, &values[c]);
          c += field.components.size();
        }
        for (unsigned int i = 0; i < columns.size(); ++i)
          columns[i][p] = values[i];
      }
      return columns;
    }

    template <int dim>
    void write_header(std::ostream &out, const std::vector<ParticleField<dim>> &fields, const double time)
    {
      std::string units = "# time ", names = "id,body,material";
      append_number(units, time);
      units += " [time]; units: id [1], body [1], material [1]";
      for (unsigned int d = 0; d < dim; ++d)
      {
        units += std::string(", ") + "xyz"[d] + " [length]";
        names += std::string(",") + "xyz"[d];
      }
      for (const auto &field : fields)
        for (const auto &component : field.components)
        {
          if (!field.unit.empty())
            units += ", " + component + " [" + field.unit + "]";
          names += "," + component;
        }
      out << units << '\n' << names << '\n';
    }
  } // namespace

  template <int dim>
  void write_particle_csv(const std::string &path, const WorkingSet<dim> &particles,
                          const std::vector<ParticleField<dim>> &fields, const double time, MPI_Comm communicator)
  {
    // A column at a time: one message of all of them could exceed what MPI can count.
    auto columns = columns_of(particles, fields);
    for (auto &column : columns)
    {
      if (Utilities::MPI::n_mpi_processes(communicator) == 1)
        break;
      const auto parts = Utilities::MPI::gather(communicator, column);
      column.clear();
      for (const auto &part : parts)
        column.insert(column.end(), part.begin(), part.end());
    }
    const auto write = [&](std::ostream &out) {
      write_header(out, fields, time);
      std::vector<std::size_t> order(columns[0].size());
      std::iota(order.begin(), order.end(), 0);
      std::sort(order.begin(), order.end(), [&](const auto a, const auto b) { return columns[0][a] < columns[0][b]; });
      std::string row;
      for (const auto p : order)
      {
        row.clear();
        for (const auto &column : columns)
        {
          row += row.empty() ? "" : ",";
          append_number(row, column[p]);
        }
        out << row << '\n';
      }
    };
    run_on_root([&] { write_complete_file(path, write); }, communicator);
  }

  template std::string particle_piece(const WorkingSet<2> &, const std::vector<ParticleField<2>> &);
  template std::string particle_piece(const WorkingSet<3> &, const std::vector<ParticleField<3>> &);
  template void write_particle_csv(const std::string &, const WorkingSet<2> &, const std::vector<ParticleField<2>> &,
                                   const double, MPI_Comm);
  template void write_particle_csv(const std::string &, const WorkingSet<3> &, const std::vector<ParticleField<3>> &,
                                   const double, MPI_Comm);
} // namespace Talus

#include <talus/postprocess/files.h>
#include <talus/postprocess/particle_output.h>
#include <talus/postprocess/vtu.h>

#include "particle_layout.h"

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cstdint>
#include <numeric>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    /** Field names have no characters that XML would mind. */
    std::string array_head(const std::string &type, const std::string &name, const ArrayLayout &layout,
                           const std::string &unit)
    {
      std::string text = "    <DataArray type=\"" + type + "\" Name=\"" + name + "\"";
      if (layout.others.size() > 1)
        text += " NumberOfComponents=\"" + std::to_string(layout.others.size()) + "\"";
      for (unsigned int c = 0; c < layout.names.size(); ++c)
        text += " ComponentName" + std::to_string(c) + "=\"" + layout.names[c] + "\"";
      return text + (unit.empty() ? "" : " units=\"" + unit + "\"") + " format=\"binary\">\n";
    }

    /** An array of what `add` gives an array for each particle. */
    template <class Add>
    std::string array_text(const std::string &head, const unsigned int n, const Add &add)
    {
      VtuArray array;
      for (unsigned int p = 0; p < n; ++p)
        add(array, p);
      return head + array.text() + "    </DataArray>\n";
    }

    template <class Value>
    std::string scalar_text(const std::string &type, const std::string &name, const unsigned int n, const Value &value)
    {
      return array_text(array_head(type, name, {{}, {0.f}, {}}, ""), n,
                        [&](VtuArray &array, const unsigned int p) { array.add(value(p)); });
    }

    /** A field of all particles; one that is neither vector nor tensor as an array for each component. */
    template <int dim>
    void append_field(const WorkingSet<dim> &particles, const ParticleField<dim> &field,
                      std::vector<std::string> &parts)
    {
      const ArrayLayout   layout = layout_of(field);
      std::vector<double> values(field.components.size());
      if (layout.others.empty())
      {
        for (unsigned int c = 0; c < values.size(); ++c)
          append(array_text(array_head("Float32", field.components[c], {{}, {0.f}, {}}, field.unit), particles.size(),
                            [&](VtuArray &array, const unsigned int p) {
                              field.evaluate(particles, p, values.data());
                              array.add(static_cast<float>(values[c]));
                            }),
                 parts);
        return;
      }
      std::vector<float> numbers = layout.others;
      append(array_text(array_head("Float32", array_name(field), layout, field.unit), particles.size(),
                        [&](VtuArray &array, const unsigned int p) {
                          field.evaluate(particles, p, values.data());
                          for (unsigned int c = 0; c < values.size(); ++c)
                            numbers[layout.place[c]] = static_cast<float>(values[c]);
                          array.add(numbers.data(), numbers.size());
                        }),
             parts);
    }
  } // namespace

  template <int dim>
  void append_piece(const WorkingSet<dim> &particles, const std::vector<ParticleField<dim>> &fields,
                    std::vector<std::string> &parts)
  {
    const unsigned int n      = particles.size();
    const auto         x      = particles.template components<dim>(particles.position);
    const std::string  number = std::to_string(n);
    append("<Piece NumberOfPoints=\"" + number + "\" NumberOfCells=\"" + number + "\">\n  <Points>\n", parts);
    append(array_text("    <DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"binary\">\n", n,
                      [&](VtuArray &array, const unsigned int p) {
                        for (unsigned int d = 0; d < 3; ++d)
                          array.add(d < dim ? x[d][p] : 0.);
                      }),
           parts);
    append("  </Points>\n  <Cells>\n", parts);
    append(scalar_text("Int32", "connectivity", n, [](const unsigned int p) { return std::int32_t(p); }), parts);
    append(scalar_text("Int32", "offsets", n, [](const unsigned int p) { return std::int32_t(p + 1); }), parts);
    append(scalar_text("UInt8", "types", n, [](unsigned int) { return std::uint8_t{1}; }), parts);
    append("  </Cells>\n  <PointData Scalars=\"scalars\">\n", parts);
    append(scalar_text("Float64", "id", n, [&](const unsigned int p) { return double(particles.id[p]); }), parts);
    append(scalar_text("Float32", "body", n, [&](const unsigned int p) { return float(particles.body[p]); }), parts);
    append(scalar_text("Float32", "material", n, [&](const unsigned int p) { return float(particles.material_of(p)); }),
           parts);
    for (const auto &field : fields)
      append_field(particles, field, parts);
    append("  </PointData>\n</Piece>\n", parts);
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

  template void append_piece(const WorkingSet<2> &, const std::vector<ParticleField<2>> &, std::vector<std::string> &);
  template void append_piece(const WorkingSet<3> &, const std::vector<ParticleField<3>> &, std::vector<std::string> &);
  template void write_particle_csv(const std::string &, const WorkingSet<2> &, const std::vector<ParticleField<2>> &,
                                   const double, MPI_Comm);
  template void write_particle_csv(const std::string &, const WorkingSet<3> &, const std::vector<ParticleField<3>> &,
                                   const double, MPI_Comm);
} // namespace Talus

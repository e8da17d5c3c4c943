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

    /** Adds an array of what `give` adds for each particle. */
    template <class Give>
    void add_array(const std::string &head, const unsigned int n, const Give &give, VtuText &text)
    {
      VtuArray array;
      for (unsigned int p = 0; p < n; ++p)
        give(array, p);
      text.add(head);
      text.add(std::move(array));
      text.add("    </DataArray>\n");
    }

    template <class Value>
    void add_scalar(const std::string &type, const std::string &name, const unsigned int n, const Value &value,
                    VtuText &text)
    {
      add_array(
        array_head(type, name, {{}, {0.f}, {}}, ""), n,
        [&](VtuArray &array, const unsigned int p) { array.add(value(p)); }, text);
    }

    /** A field of all particles; one that is neither vector nor tensor as an array for each component. */
    template <int dim>
    void add_field(const WorkingSet<dim> &particles, const ParticleField<dim> &field, VtuText &text)
    {
      const ArrayLayout   layout = layout_of(field);
      std::vector<double> values(field.components.size());
      if (layout.others.empty())
      {
        for (unsigned int c = 0; c < values.size(); ++c)
          add_array(
            array_head("Float32", field.components[c], {{}, {0.f}, {}}, field.unit), particles.size(),
            [&](VtuArray &array, const unsigned int p) {
              field.evaluate(particles, p, values.data());
              array.add(single(values[c]));
            },
            text);
        return;
      }
      std::vector<float> numbers = layout.others;
      add_array(
        array_head("Float32", array_name(field), layout, field.unit), particles.size(),
        [&](VtuArray &array, const unsigned int p) {
          field.evaluate(particles, p, values.data());
          for (unsigned int c = 0; c < values.size(); ++c)
            numbers[layout.place[c]] = single(values[c]);
          array.add(numbers.data(), numbers.size());
        },
        text);
    }
  } // namespace

  template <int dim>
  void add_piece(const WorkingSet<dim> &particles, const std::vector<ParticleField<dim>> &fields, VtuText &text)
  {
    const unsigned int n      = particles.size();
    const auto         x      = particles.template components<dim>(particles.position);
    const std::string  number = std::to_string(n);
    text.add("<Piece NumberOfPoints=\"" + number + "\" NumberOfCells=\"" + number + "\">\n  <Points>\n");
    add_array(
      "    <DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"binary\">\n", n,
      [&](VtuArray &array, const unsigned int p) {
        for (unsigned int d = 0; d < 3; ++d)
          array.add(d < dim ? x[d][p] : 0.);
      },
      text);
    text.add("  </Points>\n  <Cells>\n");
    add_scalar(
      "Int32", "connectivity", n, [](const unsigned int p) { return std::int32_t(p); }, text);
    add_scalar(
      "Int32", "offsets", n, [](const unsigned int p) { return std::int32_t(p + 1); }, text);
    add_scalar(
      "UInt8", "types", n, [](unsigned int) { return std::uint8_t{1}; }, text); // vertices
    text.add("  </Cells>\n  <PointData Scalars=\"scalars\">\n");
    add_scalar(
      "Float64", "id", n, [&](const unsigned int p) { return double(particles.id[p]); }, text);
    add_scalar(
      "Float32", "body", n, [&](const unsigned int p) { return float(particles.body[p]); }, text);
    add_scalar(
      "Float32", "material", n, [&](const unsigned int p) { return float(particles.material_of(p)); }, text);
    for (const auto &field : fields)
      add_field(particles, field, text);
    text.add("  </PointData>\n</Piece>\n");
  }

  namespace
  {
    /** Of this rank's particles in the order of their ids those from `first` on whose ids are below `end`, row by row.
     */
    template <int dim>
    std::vector<double> rows_of(const WorkingSet<dim> &particles, const std::vector<ParticleField<dim>> &fields,
                                const std::vector<unsigned int> &order, unsigned int &first, const double end)
    {
      const auto          x = particles.template components<dim>(particles.position);
      std::vector<double> rows;
      for (; first < order.size() && particles.id[order[first]] < end; ++first)
      {
        const unsigned int p = order[first];
        const std::size_t  i = rows.size();
        rows.resize(i + 3 + dim + n_components(fields));
        rows[i]     = particles.id[p];
        rows[i + 1] = particles.body[p];
        rows[i + 2] = particles.material_of(p);
        for (unsigned int d = 0; d < dim; ++d)
          rows[i + 3 + d] = x[d][p];
        std::size_t c = i + 3 + dim;
        for (const auto &field : fields)
        {
          field.evaluate(particles, p, &rows[c]);
          c += field.components.size();
        }
      }
      return rows;
    }

    /** Writes rows of all ranks in the order of their ids. */
    void write_rows(std::ostream &out, const std::vector<std::vector<double>> &parts, const unsigned int width)
    {
      std::vector<const double *> order;
      for (const auto &rows : parts)
        for (std::size_t i = 0; i < rows.size(); i += width)
          order.push_back(&rows[i]);
      if (parts.size() > 1)
        std::sort(order.begin(), order.end(), [](const double *a, const double *b) { return *a < *b; });
      std::string text;
      for (const double *row : order)
      {
        text.clear();
        for (unsigned int c = 0; c < width; ++c)
        {
          text += c == 0 ? "" : ",";
          append_number(text, row[c]);
        }
        out << text << '\n';
      }
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
    const unsigned int        width = 3 + dim + n_components(fields), n = particles.size();
    std::vector<unsigned int> order(n);
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(),
              [&](const auto a, const auto b) { return particles.id[a] < particles.id[b]; });
    const double end =
      Utilities::MPI::max(n == 0 ? 0. : 1. + static_cast<double>(particles.id[order.back()]), communicator);

    // Some ids at a time: all rows of all ranks are more than one has memory for.
    bool       has_begun = false;
    const auto collect   = [&](std::ostream *out) {
      has_begun                = true;
      constexpr double portion = 1u << 16;
      unsigned int     first   = 0;
      for (double begin = 0; begin < end; begin += portion)
      {
        const auto rows  = rows_of(particles, fields, order, first, begin + portion);
        const auto parts = Utilities::MPI::n_mpi_processes(communicator) == 1 ?
                               std::vector<std::vector<double>>{rows} :
                               Utilities::MPI::gather(communicator, rows);
        if (out)
          write_rows(*out, parts, width);
      }
    };
    const auto write = [&] {
      try
      {
        write_complete_file(path, [&](std::ostream &out) {
          write_header(out, fields, time);
          collect(&out);
        });
      }
      catch (...)
      {
        if (!has_begun)
          collect(nullptr); // the others wait
        throw;
      }
    };
    if (Utilities::MPI::this_mpi_process(communicator) > 0)
      collect(nullptr);
    run_on_root(write, communicator);
  }

  template void add_piece(const WorkingSet<2> &, const std::vector<ParticleField<2>> &, VtuText &);
  template void add_piece(const WorkingSet<3> &, const std::vector<ParticleField<3>> &, VtuText &);
  template void write_particle_csv(const std::string &, const WorkingSet<2> &, const std::vector<ParticleField<2>> &,
                                   const double, MPI_Comm);
  template void write_particle_csv(const std::string &, const WorkingSet<3> &, const std::vector<ParticleField<3>> &,
                                   const double, MPI_Comm);
} // namespace Talus

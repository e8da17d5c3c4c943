#include <talus/postprocess/files.h>
#include <talus/postprocess/particle_output.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <numeric>

namespace Talus
{
  using namespace dealii;

  template <int dim>
  void ParticleOutput<dim>::build_patches(const WorkingSet<dim>                 &particles,
                                          const std::vector<ParticleField<dim>> &fields)
  {
    names = {"id", "body", "material"};
    vectors.clear();
    physical_units.clear();
    for (const auto &field : fields)
    {
      if (field.is_vector)
      {
        std::string name = field.components[0];
        name.resize(name.size() - 2); // without "_x"
        vectors.emplace_back(names.size(), names.size() + dim - 1, name,
                             DataComponentInterpretation::component_is_part_of_vector);
        if (!field.unit.empty())
          physical_units[name] = field.unit;
      }
      else if (!field.unit.empty())
        for (const auto &component : field.components)
          physical_units[component] = field.unit;
      names.insert(names.end(), field.components.begin(), field.components.end());
    }

    const auto          x = particles.template components<dim>(particles.position);
    std::vector<double> values(names.size());
    patches.assign(particles.size(), {});
    for (unsigned int p = 0; p < particles.size(); ++p)
    {
      auto &patch       = patches[p];
      patch.patch_index = p;
      for (unsigned int d = 0; d < dim; ++d)
        patch.vertices[0][d] = x[d][p];
      values[0]      = particles.id[p];
      values[1]      = particles.body[p];
      values[2]      = particles.material_of(p);
      unsigned int c = 3;
      for (const auto &field : fields)
      {
        field.evaluate(particles, p, &values[c]);
        c += field.components.size();
      }
      patch.data.reinit(names.size(), 1);
      for (unsigned int i = 0; i < names.size(); ++i)
        patch.data(i, 0) = values[i];
    }
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

  template class ParticleOutput<2>;
  template class ParticleOutput<3>;
  template void write_particle_csv(const std::string &, const WorkingSet<2> &, const std::vector<ParticleField<2>> &,
                                   const double, MPI_Comm);
  template void write_particle_csv(const std::string &, const WorkingSet<3> &, const std::vector<ParticleField<3>> &,
                                   const double, MPI_Comm);
} // namespace Talus

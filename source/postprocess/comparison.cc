#include <talus/core/exceptions.h>
#include <talus/core/function.h>
#include <talus/materials/linear_elastic.h>
#include <talus/postprocess/comparison.h>

#include <algorithm>
#include <fstream>
#include <iomanip>

namespace Talus
{
  using namespace dealii;

  template <int dim>
  Region<dim>::Region(const std::string &section, const std::string &name) :
    ParameterAcceptor(section + "/" + name), name(name), parser(1)
  {
    add_parameter("Where", expression, "Condition on x, y, z, for instance 'x > 0.25 && abs(y - 0.5) < 0.1'.");
  }

  template <int dim>
  void Region<dim>::parse_parameters(ParameterHandler &)
  {
    const std::string reason = formula_error([&] {
      parser.initialize(dim == 2 ? "x,y" : "x,y,z", expression, {{"pi", numbers::PI}});
      parser.value(Point<dim>());
    });
    if (!reason.empty())
      throw EntryError(get_section_name(), "Where",
                       "cannot understand '" + expression + "': " + reason + ". Write a condition on " +
                         (dim == 2 ? "x, y" : "x, y, z") + " with <, >, &&, ||, abs, ...");
  }

  template <int dim>
  Comparison<dim>::Comparison(Parameters &parameters, const std::string &section,
                              const std::vector<std::string> &material_names, MPI_Comm communicator) :
    ParameterAcceptor(section),
    communicator(communicator), reference(parameters, section, communicator)
  {
    AssertThrow(!material_names.empty(), EntryError("/Materials", "Names", "give at least one material."));
    std::string selection;
    for (const auto &name : material_names)
      selection += (selection.empty() ? "" : "|") + name;
    const std::string chosen = parameters.choose_from(section, "Material", material_names.front(), selection,
                                                      "Material of the reference; linear elastic.");
    material                 = std::find(material_names.begin(), material_names.end(), chosen) - material_names.begin();
    for (const auto &name :
         parameters.names(section + "/Regions", "Names of the regions over which errors are averaged."))
      regions.push_back(std::make_unique<Region<dim>>(section + "/Regions", name));
    add_parameter("Average from", average_from,
                  "Stress and forces are averaged from this fraction of the end time on [1].", prm,
                  Patterns::Double(0, 1));
  }

  template <int dim>
  void Comparison<dim>::parse_parameters(ParameterHandler &)
  {
    if (!(average_from < 1))
      throw EntryError(get_section_name(), "Average from", "it must be below 1, or there is nothing to average.");
  }

  template <int dim>
  void Comparison<dim>::add_fields(WorkingSet<dim> &particles)
  {
    mean_stress      = particles.add_field("mean stress", particles.n_stress);
    reference_stress = particles.add_field("reference stress", particles.n_stress);
    stress_error     = particles.add_field("stress error", 1);
  }

  template <int dim>
  void Comparison<dim>::accumulate(const double time, const double dt, const double end_time,
                                   const Boundary<dim> &boundary, WorkingSet<dim> &particles)
  {
    if (time <= average_from * end_time)
      return;
    averaged_time += dt;
    mean_reactions.resize(boundary.conditions.size());
    for (unsigned int c = 0; c < boundary.conditions.size(); ++c)
      mean_reactions[c] += dt * end_time / time * boundary.conditions[c]->reaction;
    for (unsigned int c = 0; c < particles.n_stress; ++c)
    {
      double       *sum    = particles.component(mean_stress, c);
      const double *stress = particles.component(particles.stress, c);
      for (unsigned int p = 0; p < particles.size(); ++p)
        sum[p] += dt * end_time / time * stress[p];
    }
  }

  template <int dim>
  void Comparison<dim>::serialize(Archive &archive)
  {
    const Archive::Scope scope(archive, "comparison");
    archive("averaged time", averaged_time);
    std::vector<double> numbers;
    for (const auto &reaction : mean_reactions)
      numbers.insert(numbers.end(), reaction.begin_raw(), reaction.end_raw());
    archive("mean reactions", numbers);
    mean_reactions.resize(numbers.size() / dim);
    for (unsigned int k = 0; k < numbers.size(); ++k)
      mean_reactions[k / dim][k % dim] = numbers[k];
  }

  template <int dim>
  void Comparison<dim>::finish(const double end_time, const std::vector<std::unique_ptr<Material>> &materials,
                               const std::vector<std::string> &condition_names, WorkingSet<dim> &particles)
  {
    const auto *elastic = dynamic_cast<const LinearElastic *>(materials[material].get());
    if (elastic == nullptr)
      throw EntryError(get_section_name(), "Material",
                       "the reference can be computed for linear elastic materials only.");
    reference.set_moduli(elastic->bulk_modulus(), elastic->shear_modulus());
    reference.solve(end_time);

    std::vector<Point<dim>> points(particles.size());
    for (unsigned int p = 0; p < particles.size(); ++p)
      for (unsigned int d = 0; d < dim; ++d)
        points[p][d] = particles.component(particles.initial_position, d)[p];
    const std::vector<SymmetricTensor<2, 3>> exact = reference.stress(points);
    for (unsigned int p = 0; p < particles.size(); ++p)
    {
      SymmetricTensor<2, 3> difference = -1. * exact[p];
      for (unsigned int c = 0; c < particles.n_stress; ++c)
      {
        double &mean = particles.component(mean_stress, c)[p];
        mean /= averaged_time;
        difference.access_raw_entry(c) += mean;
        particles.component(reference_stress, c)[p] = exact[p].access_raw_entry(c);
      }
      particles.component(stress_error, 0)[p] = 100 * difference.norm() / exact[p].norm(); // Eq. (64)
    }

    rows.clear();
    sum_up_regions(particles);
    for (unsigned int c = 0; c < condition_names.size(); ++c)
      if (reference.has_condition(condition_names[c]))
      {
        const Tensor<1, dim> force = reference.force(condition_names[c]);
        for (unsigned int d = 0; d < dim; ++d)
        {
          const std::string axis(1, "xyz"[d]);
          rows.push_back({"force " + axis, condition_names[c], mean_reactions[c][d] / averaged_time, "force"});
          rows.push_back({"reference force " + axis, condition_names[c], force[d], "force"});
        }
      }
  }

  template <int dim>
  void Comparison<dim>::sum_up_regions(const WorkingSet<dim> &particles)
  {
    const double *error = particles.component(stress_error, 0);
    for (const auto &region : regions)
    {
      double n = 0, squares = 0, greatest = 0;
      for (unsigned int p = 0; p < particles.size(); ++p)
      {
        Point<dim> x;
        for (unsigned int d = 0; d < dim; ++d)
          x[d] = particles.component(particles.initial_position, d)[p];
        if (!region->contains(x))
          continue;
        ++n;
        squares += error[p] * error[p];
        greatest = std::max(greatest, error[p]);
      }
      n = Utilities::MPI::sum(n, communicator);
      if (n == 0)
        throw EntryError(region->get_section_name(), "Where", "no particle starts in this region.");
      rows.push_back({"particles", region->name, n, "1"});
      rows.push_back(
        {"stress error rms", region->name, std::sqrt(Utilities::MPI::sum(squares, communicator) / n), "%"});
      rows.push_back({"stress error max", region->name, Utilities::MPI::max(greatest, communicator), "%"});
    }
  }

  template <int dim>
  void Comparison<dim>::write(const std::string &file_name, std::ostream &out) const
  {
    if (Utilities::MPI::this_mpi_process(communicator) != 0)
      return;
    std::ofstream file(file_name);
    file << "quantity,name,value,unit\n" << std::setprecision(17);
    out << "\nComparison with the finite element reference\n";
    for (const Row &row : rows)
    {
      file << row.quantity << ',' << row.name << ',' << row.value << ',' << row.unit << '\n';
      out << "  " << std::left << std::setw(20) << row.quantity << std::setw(16) << row.name << std::setw(14)
          << row.value << row.unit << '\n';
    }
    AssertThrow(file.flush(), RunError("Cannot write '" + file_name + "'. Is the disk full?"));
  }

  template class Region<2>;
  template class Region<3>;
  template class Comparison<2>;
  template class Comparison<3>;
} // namespace Talus

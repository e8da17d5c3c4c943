#include <talus/postprocess/load_curve.h>
#include <talus/postprocess/statistics.h>

#include <iomanip>
#include <sstream>

namespace Talus
{
  using namespace dealii;

  template <int dim>
  LoadCurve<dim>::LoadCurve(Parameters &parameters, const std::string &section, MPI_Comm communicator) :
    communicator(communicator), reference(parameters, section, communicator)
  {
  }

  template <int dim>
  void LoadCurve<dim>::compute(const double end_time, const std::string &file_name)
  {
    const auto                  names = reference.condition_names();
    double                      time  = 0;
    std::vector<Tensor<1, dim>> displacements(names.size()), forces(names.size());
    Table                       table;
    table.add("time", "time", time);
    for (unsigned int c = 0; c < names.size(); ++c)
    {
      table.add("displacement " + names[c], "length", displacements[c]);
      table.add("force " + names[c], "force", forces[c]);
    }
    CsvFile file;
    file.open(file_name, table.columns(), communicator);
    reference.solve(end_time, [&](const double now) {
      time = now;
      for (unsigned int c = 0; c < names.size(); ++c)
      {
        displacements[c] = reference.mean_displacement(names[c]);
        forces[c]        = reference.force(names[c]);
      }
      file.write_row(table.row());
    });
  }

  template <int dim>
  std::string LoadCurve<dim>::summary() const
  {
    std::ostringstream text;
    text << "\nPlastic finite element reference: " << reference.n_iterations() << " iterations, "
         << reference.n_halvings() << " steps halved\n";
    for (const auto &name : reference.condition_names())
    {
      const Tensor<1, dim> force = reference.force(name);
      text << "  force on " << std::left << std::setw(16) << name;
      for (unsigned int d = 0; d < dim; ++d)
        text << std::setw(14) << force[d];
      text << '\n';
    }
    return text.str();
  }

  template class LoadCurve<2>;
  template class LoadCurve<3>;
} // namespace Talus

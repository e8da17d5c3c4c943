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
    const auto          names   = reference.condition_names();
    std::vector<Column> columns = {{"time", "time"}};
    for (const auto &name : names)
    {
      for (unsigned int d = 0; d < dim; ++d)
        columns.push_back({"displacement " + name + " " + "xyz"[d], "length"});
      for (unsigned int d = 0; d < dim; ++d)
        columns.push_back({"force " + name + " " + "xyz"[d], "force"});
    }
    CsvFile file;
    file.open(file_name, columns, communicator);
    reference.solve(end_time, [&](const double time) {
      std::vector<double> row = {time};
      for (const auto &name : names)
        for (const Tensor<1, dim> &vector : {reference.mean_displacement(name), reference.force(name)})
          row.insert(row.end(), vector.begin_raw(), vector.end_raw());
      file.write_row(row);
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

#include <talus/postprocess/reference_motion.h>
#include <talus/postprocess/statistics.h>

#include <sstream>

namespace Talus
{
  using namespace dealii;

  template <int dim>
  ReferenceMotion<dim>::ReferenceMotion(Parameters &parameters, const std::string &section, MPI_Comm communicator) :
    communicator(communicator), reference(parameters, section, communicator)
  {
  }

  template <int dim>
  void ReferenceMotion<dim>::compute(const double end_time, const std::string &file_name)
  {
    std::vector<Column> columns = {
      {"time", "time"}, {"kinetic energy", "energy"}, {"strain energy", "energy"}, {"work", "energy"}};
    for (unsigned int i = 0; i < reference.history_points().size(); ++i)
      for (unsigned int d = 0; d < dim; ++d)
        columns.push_back({"displacement " + std::to_string(i) + " " + "xyz"[d], "length"});
    CsvFile file;
    file.open(file_name, columns, communicator);
    reference.solve(end_time, [&](const double time) {
      const auto &energies    = reference.energies();
      greatest_energy         = std::max(greatest_energy, energies.kinetic + energies.strain);
      greatest_residual       = std::max(greatest_residual, std::abs(energies.residual()));
      std::vector<double> row = {time, energies.kinetic, energies.strain, energies.work};
      for (const auto &u : reference.displacements_at_points())
        row.insert(row.end(), u.begin_raw(), u.end_raw());
      file.write_row(row);
    });
  }

  template <int dim>
  std::string ReferenceMotion<dim>::summary() const
  {
    std::ostringstream text;
    text << "\nDynamic finite element reference: " << reference.n_steps() << " steps of " << reference.step_size()
         << ", energy out of balance by at most " << (greatest_energy > 0. ? greatest_residual / greatest_energy : 0.)
         << " of the greatest\n";
    return text.str();
  }

  template class ReferenceMotion<2>;
  template class ReferenceMotion<3>;
} // namespace Talus

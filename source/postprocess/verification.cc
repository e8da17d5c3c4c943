#include <talus/core/reduction.h>
#include <talus/materials/neo_hookean.h>
#include <talus/postprocess/verification.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <iomanip>
#include <ostream>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    const std::string section = "/Verification";

    /** The components of the stress that a run of this dimension balances. */
    template <int dim>
    Tensor<2, dim> stress_of(const WorkingSet<dim> &particles, const unsigned int p)
    {
      Tensor<2, dim> stress;
      for (unsigned int d = 0; d < dim; ++d)
        for (unsigned int e = 0; e < dim; ++e)
          stress[d][e] = particles.component(particles.stress, d == e ? d : 2 + d + e)[p];
      return stress;
    }

    template <int dim>
    Point<dim> point(const Tensor<1, dim> &vector)
    {
      return Point<dim>(vector);
    }
  } // namespace

  template <int dim>
  std::unique_ptr<Verification<dim>> Verification<dim>::make(Parameters &parameters, const Communicator &communicator)
  {
    using Solutions = Registry<ManufacturedSolution<dim>>;
    const std::string chosen =
      parameters.choose_from(section, "Solution", "none", "none|" + Solutions::get().selection(),
                             "Manufactured solution that the run is to reproduce: it gives "
                             "initial velocities and body force, and errors are measured.");
    if (chosen == "none")
      return nullptr;
    return std::unique_ptr<Verification>(
      new Verification(Solutions::get().make(chosen, parameters, section), communicator));
  }

  template <int dim>
  Verification<dim>::Verification(std::unique_ptr<ManufacturedSolution<dim>> solution,
                                  const Communicator                        &communicator) :
    solution(std::move(solution)),
    communicator(communicator)
  {
  }

  template <int dim>
  void Verification<dim>::start(const std::vector<std::unique_ptr<Material>> &materials, Particles<dim> &particles,
                                BodyForce<dim> &body_force)
  {
    const auto *material = materials.size() == 1 ? dynamic_cast<const NeoHookean *>(materials[0].get()) : nullptr;
    if (material == nullptr)
      throw EntryError(section, "Solution", "it holds for one neo-Hookean material. Give the run that and no other.");
    if (!body_force.is_zero())
      throw EntryError("/Run", "Body force", "the manufactured solution gives it. Leave this entry out.");
    solution->material = {material->lame_modulus(), material->shear_modulus(), material->density};
    solution->check(solution->material);
    body_force.initialize([this](const Point<dim> &X, const double time) { return solution->body_force(X, time); });

    for (unsigned int p = 0; p < particles.size(); ++p)
    {
      const Point<dim> X      = point(particles.vector(particles.initial_position, p));
      const auto       v      = solution->velocity(X, 0.);
      const auto       grad_v = solution->velocity_gradient(X, 0.);
      for (unsigned int d = 0; d < dim; ++d)
        particles.component(particles.velocity, d)[p] = v[d];
      for (unsigned int c = 0; c < dim * dim; ++c)
        particles.component(particles.grad_v, c)[p] = grad_v[c / dim][c % dim];
    }
  }

  template <int dim>
  double Verification<dim>::next_stop(const double time, const double end_time) const
  {
    return time < 0.25 * end_time ? 0.25 * end_time : end_time;
  }

  template <int dim>
  std::vector<Column> Verification<dim>::columns()
  {
    return {{"error u", "length"},     {"error v", "length/time"}, {"error stress", "stress"},
            {"relative error u", "1"}, {"relative error v", "1"},  {"relative error stress", "1"}};
  }

  template <int dim>
  std::vector<double> Verification<dim>::errors(const double time, const Particles<dim> &particles)
  {
    std::vector<double> sums(n_fields, 0.), maxima(largest.begin(), largest.end());
    const auto          add = [&](const unsigned int f, const auto &value, const auto &exact) {
      sums[f] += (value - exact).norm_square();
      maxima[f] = std::max(maxima[f], exact.norm());
    };
    for (unsigned int p = 0; p < particles.size(); ++p)
    {
      const Point<dim> X = point(particles.vector(particles.initial_position, p));
      add(0, particles.vector(particles.position, p) - X, solution->displacement(X, time));
      add(1, particles.vector(particles.velocity, p), solution->velocity(X, time));
      add(2, stress_of(particles, p), solution->stress(X, time));
    }
    Reduction reduction;
    reduction.sum(sums);
    for (double &value : maxima)
      reduction.max(value);
    reduction.run(communicator);
    std::copy(maxima.begin(), maxima.end(), largest.begin());
    std::vector<double> values(2 * n_fields);
    for (unsigned int f = 0; f < n_fields; ++f)
    {
      values[f]            = std::sqrt(sums[f] / particles.n_global);
      values[n_fields + f] = values[f] == 0 ? 0 : values[f] / largest[f]; // at t = 0 both are zero
    }
    return values;
  }

  template <int dim>
  void Verification<dim>::record(const double time, const double end_time, const unsigned int step,
                                 const Particles<dim> &particles)
  {
    if (time != 0.25 * end_time && time != end_time)
      return;
    std::vector<double> row    = {time, static_cast<double>(step)};
    const auto          values = errors(time, particles);
    row.insert(row.end(), values.begin(), values.end());
    rows.push_back(row);
  }

  template <int dim>
  void Verification<dim>::serialize(Archive &archive)
  {
    const Archive::Scope scope(archive, "verification");
    std::vector<double>  numbers(largest.begin(), largest.end());
    for (const auto &row : rows)
      numbers.insert(numbers.end(), row.begin(), row.end());
    archive("largest, and rows", numbers);
    std::copy_n(numbers.begin(), n_fields, largest.begin());
    rows.clear();
    constexpr unsigned int n = 2 + 2 * n_fields;
    for (auto next = numbers.begin() + n_fields; next != numbers.end(); next += n)
      rows.emplace_back(next, next + n);
  }

  template <int dim>
  void Verification<dim>::write(const std::string &file_name, std::ostream &table) const
  {
    std::vector<Column> columns = {{"time", "time"}, {"step", "1"}};
    for (const auto &column : Verification::columns())
      columns.push_back(column);
    CsvFile file;
    file.open(file_name, columns, communicator);
    table << "\nErrors against the manufactured solution, root mean square over particles (relative to the greatest "
             "exact value)\n"
          << std::setw(12) << "time" << std::setw(8) << "step" << std::setw(24) << "u" << std::setw(24) << "v"
          << std::setw(24) << "stress" << '\n';
    for (const auto &row : rows)
    {
      file.write_row(row);
      table << std::setw(12) << row[0] << std::setw(8) << row[1];
      for (unsigned int f = 0; f < n_fields; ++f)
        table << std::setw(12) << row[2 + f] << " (" << std::setw(9) << row[2 + n_fields + f] << ")";
      table << '\n';
    }
  }

  template class Verification<2>;
  template class Verification<3>;
} // namespace Talus

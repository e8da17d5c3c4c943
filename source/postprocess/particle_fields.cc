#include <talus/core/exceptions.h>
#include <talus/core/parameters.h>
#include <talus/postprocess/particle_fields.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>

#include <algorithm>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    bool ends_with(const std::string &text, const std::string &end)
    {
      return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
    }

    /** The unit of a field of the working set, as far as its name tells it. */
    std::string unit_of(const std::string &name)
    {
      static const std::vector<std::pair<std::string, std::string>> units{{"position", "length"},
                                                                          {"velocity", "length/time"},
                                                                          {"velocity gradient", "1/time"},
                                                                          {"deformation gradient", "1"},
                                                                          {"stress", "stress"},
                                                                          {"strain", "1"},
                                                                          {"gap", "1"},
                                                                          {"mass", "mass"},
                                                                          {"volume", "volume"},
                                                                          {"affine moment", "length^2/time"}};
      for (const auto &[end, unit] : units)
        if (ends_with(name, end))
          return unit;
      return "";
    }

    template <int dim>
    SymmetricTensor<2, 3> stress(const WorkingSet<dim> &particles, const unsigned int p)
    {
      SymmetricTensor<2, 3> sigma;
      for (unsigned int c = 0; c < particles.n_stress; ++c)
        sigma.access_raw_entry(c) = particles.component(particles.stress, c)[p];
      return sigma;
    }

    template <int dim>
    double volume_ratio(const WorkingSet<dim> &particles, const unsigned int p)
    {
      Tensor<2, dim> F;
      for (unsigned int c = 0; c < dim * dim; ++c)
        F[c / dim][c % dim] = particles.component(particles.F, c)[p];
      return determinant(F);
    }

    /** sqrt(2/3) |dev e| of Hencky's strain e = ln(F F^T) / 2, which no rotation changes. */
    template <int dim>
    double deviatoric_strain(const WorkingSet<dim> &particles, const unsigned int p)
    {
      Tensor<2, 3> F = unit_symmetric_tensor<3>();
      for (unsigned int c = 0; c < dim * dim; ++c)
        F[c / dim][c % dim] = particles.component(particles.F, c)[p];
      const auto b    = eigenvalues(symmetrize(F * transpose(F)));
      double     mean = 0, squares = 0;
      for (const double stretch : b)
        mean += std::log(stretch) / 6;
      for (const double stretch : b)
        squares += std::pow(std::log(stretch) / 2 - mean, 2);
      return std::sqrt(2. / 3. * squares);
    }

    template <int dim>
    double kinetic_energy_density(const WorkingSet<dim> &particles, const unsigned int p)
    {
      double v_squared = 0;
      for (unsigned int d = 0; d < dim; ++d)
        v_squared += std::pow(particles.component(particles.velocity, d)[p], 2);
      return 0.5 * particles.component(particles.mass, 0)[p] / particles.component(particles.volume, 0)[p] * v_squared;
    }

    /** What is computed from the fields that every run has. */
    template <int dim>
    std::vector<ParticleField<dim>> derived_fields()
    {
      using Set = WorkingSet<dim>;
      std::vector<ParticleField<dim>> fields;
      const auto                      add = [&](const std::string &name, const std::string &unit, const unsigned int n,
                           const auto &evaluate) {
        fields.push_back({name, unit, component_names(name, dim, n), n == dim, evaluate});
      };

      add("body", "1", 1, [](const Set &set, const unsigned int p, double *value) { *value = set.body[p]; });
      add("material", "1", 1, [](const Set &set, const unsigned int p, double *value) { *value = set.material_of(p); });
      add("rank", "1", 1,
          [](const Set &, unsigned int, double *value) { *value = Utilities::MPI::this_mpi_process(MPI_COMM_WORLD); });
      add("displacement", "length", dim, [](const Set &set, const unsigned int p, double *u) {
        for (unsigned int d = 0; d < dim; ++d)
          u[d] = set.component(set.position, d)[p] - set.component(set.initial_position, d)[p];
      });
      // sqrt(3/2) |s|
      add("von Mises stress", "stress", 1, [](const Set &set, const unsigned int p, double *value) {
        *value = std::sqrt(1.5) * deviator(stress(set, p)).norm();
      });
      add("pressure", "stress", 1,
          [](const Set &set, const unsigned int p, double *value) { *value = -trace(stress(set, p)) / 3; });
      add("density", "mass/volume", 1, [](const Set &set, const unsigned int p, double *value) {
        *value = set.component(set.mass, 0)[p] / set.component(set.volume, 0)[p];
      });
      add("volume ratio", "1", 1,
          [](const Set &set, const unsigned int p, double *value) { *value = volume_ratio(set, p); });
      add("deviatoric strain", "1", 1,
          [](const Set &set, const unsigned int p, double *value) { *value = deviatoric_strain(set, p); });
      // curl v; in 2D its component along z.
      add("vorticity", "1/time", dim == 2 ? 1 : 3, [](const Set &set, const unsigned int p, double *value) {
        const auto L = set.matrix(set.grad_v, p);
        if constexpr (dim == 2)
          value[0] = L[1][0] - L[0][1];
        else
          for (unsigned int i = 0; i < 3; ++i)
            value[i] = L[(i + 2) % 3][(i + 1) % 3] - L[(i + 1) % 3][(i + 2) % 3];
      });
      add("kinetic energy density", "energy/volume", 1,
          [](const Set &set, const unsigned int p, double *value) { *value = kinetic_energy_density(set, p); });
      return fields;
    }
  } // namespace

  template <int dim>
  std::vector<ParticleField<dim>> all_particle_fields(const WorkingSet<dim> &particles)
  {
    std::vector<ParticleField<dim>> all;
    for (unsigned int f = 0; f < particles.fields.size(); ++f)
    {
      const std::string &name = particles.fields[f].name;
      const unsigned int n    = particles.fields[f].n_components;
      all.push_back({name, unit_of(name), component_names(name, dim, n), n == dim,
                     [f, n](const WorkingSet<dim> &set, const unsigned int p, double *values) {
                       for (unsigned int c = 0; c < n; ++c)
                         values[c] = set.component(f, c)[p];
                     }});
    }
    // A field that a material or transfer stores is taken before a derived one of the same name.
    for (const auto &field : derived_fields<dim>())
      if (std::none_of(all.begin(), all.end(), [&](const auto &other) { return other.name == field.name; }))
        all.push_back(field);
    return all;
  }

  template <int dim>
  std::vector<ParticleField<dim>> select_particle_fields(const WorkingSet<dim>          &particles,
                                                         const std::vector<std::string> &names,
                                                         const std::string &section, const std::string &entry)
  {
    const auto               all = all_particle_fields(particles);
    std::vector<std::string> choices;
    std::string              list;
    for (const auto &field : all)
    {
      choices.push_back(field.name);
      list += (list.empty() ? "" : ", ") + field.name;
    }
    std::vector<ParticleField<dim>> selected;
    for (unsigned int i = 0; i < names.size(); ++i)
    {
      const auto position = std::find(choices.begin(), choices.end(), names[i]);
      if (position == choices.end())
      {
        const std::string best = closest(names[i], choices);
        throw EntryError(section, entry,
                         "there is no particle field '" + names[i] + "'." +
                           (best.empty() ? "" : " Did you mean '" + best + "'?") + " Choices: " + list + ".");
      }
      if (std::find(names.begin(), names.begin() + i, names[i]) == names.begin() + i)
        selected.push_back(all[position - choices.begin()]);
    }
    return selected;
  }

  void leave_out(const std::vector<std::string> &names, std::vector<std::string> &chosen)
  {
    chosen.erase(
      std::remove_if(chosen.begin(), chosen.end(),
                     [&](const auto &name) { return std::find(names.begin(), names.end(), name) != names.end(); }),
      chosen.end());
  }

  template std::vector<ParticleField<2>> all_particle_fields(const WorkingSet<2> &);
  template std::vector<ParticleField<3>> all_particle_fields(const WorkingSet<3> &);
  template std::vector<ParticleField<2>> select_particle_fields(const WorkingSet<2> &, const std::vector<std::string> &,
                                                                const std::string &, const std::string &);
  template std::vector<ParticleField<3>> select_particle_fields(const WorkingSet<3> &, const std::vector<std::string> &,
                                                                const std::string &, const std::string &);
} // namespace Talus

#pragma once

#include <talus/postprocess/particle_fields.h>

#include <deal.II/base/data_out_base.h>

namespace Talus
{
  /**
   * Particles as a cloud of points for deal.II's writers, taken from the working
   * set: id, body, material and the chosen fields. A vector field stays a vector, a tensor
   * becomes named scalars (stress_xx, ...).
   */
  template <int dim>
  class ParticleOutput : public dealii::DataOutInterface<0, dim>
  {
  public:
    void build_patches(const WorkingSet<dim> &particles, const std::vector<ParticleField<dim>> &fields);

    /** The units of the data sets, for VtkFlags. */
    const std::map<std::string, std::string> &units() const { return physical_units; }

    const std::vector<dealii::DataOutBase::Patch<0, dim>> &get_patches() const override { return patches; }
    std::vector<std::string>                               get_dataset_names() const override { return names; }
    std::vector<std::tuple<unsigned int, unsigned int, std::string,
                           dealii::DataComponentInterpretation::DataComponentInterpretation>>
    get_nonscalar_data_ranges() const override
    {
      return vectors;
    }

  private:
    std::vector<dealii::DataOutBase::Patch<0, dim>> patches;
    std::vector<std::string>                        names;
    std::map<std::string, std::string>              physical_units;
    std::vector<std::tuple<unsigned int, unsigned int, std::string,
                           dealii::DataComponentInterpretation::DataComponentInterpretation>>
      vectors;
  };

  /**
   * Writes all particles of all ranks into one table, sorted by id: id, body, material, x, y (, z)
   * and the components of `fields`. The first line is a comment with the units,
   * the second holds the names. Throws RunError on all ranks. Collective.
   */
  template <int dim>
  void write_particle_csv(const std::string &path, const WorkingSet<dim> &particles,
                          const std::vector<ParticleField<dim>> &fields, const double time, MPI_Comm communicator);
} // namespace Talus

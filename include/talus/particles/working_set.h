#pragma once

#include <deal.II/base/aligned_vector.h>
#include <deal.II/base/tensor.h>
#include <deal.II/particles/particle.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

namespace Talus
{
  /**
   * The particles of this rank as the step sees them: one array for each number
   * of each field, in canonical order (material, cell, id).
   */
  template <int dim>
  class WorkingSet
  {
  public:
    static constexpr unsigned int n_stress = dim == 2 ? 4 : 6; // xx, yy, zz, xy (, xz, yz); plane strain in 2D

    /** A named quantity with its components in consecutive columns. */
    struct Field
    {
      std::string         name;
      unsigned int        first, n_components;
      std::vector<double> initial; // value of a new particle
    };

    WorkingSet();

    /** Adds a field; the same name gives the same field. Before the first particle exists. */
    unsigned int add_field(const std::string &name, const unsigned int n_components, const double initial = 0.);

    /** The field of this name, if it has been added. */
    std::optional<unsigned int> find_field(const std::string &name) const;

    /**
     * Adds the half edges of each particle's initial domain, half_edge e in the components dim e .. dim e + dim - 1;
     * Shape::half_edges() gives them to new particles.
     */
    unsigned int add_half_edges() { return add_field(half_edges_name, dim * dim); }

    static constexpr const char *half_edges_name = "half edges";

    /** Adds the next material's fields, one number each. */
    void add_states(const std::vector<std::string> &names);

    unsigned int size() const { return id.size(); }
    void         resize(const unsigned int n_particles);

    /** Takes the addresses for so many particles at once; memory itself comes with the particles. */
    void reserve(const unsigned int n_particles);

    /** Puts particle order[i] at place i; particles that are not in `order` are dropped. */
    void permute(const std::vector<unsigned int> &order);

    double       *column(const unsigned int c) { return columns[c].data(); }
    const double *column(const unsigned int c) const { return columns[c].data(); }
    double       *component(const unsigned int field, const unsigned int c) { return column(fields[field].first + c); }
    const double *component(const unsigned int field, const unsigned int c) const
    {
      return column(fields[field].first + c);
    }
    unsigned int n_columns() const { return columns.size(); }

    /** The arrays of all n components of a field. */
    template <unsigned int n>
    std::array<double *, n> components(const unsigned int field)
    {
      std::array<double *, n> arrays;
      for (unsigned int c = 0; c < n; ++c)
        arrays[c] = component(field, c);
      return arrays;
    }
    template <unsigned int n>
    std::array<const double *, n> components(const unsigned int field) const
    {
      std::array<const double *, n> arrays;
      for (unsigned int c = 0; c < n; ++c)
        arrays[c] = component(field, c);
      return arrays;
    }

    /** A vector field of one particle. */
    dealii::Tensor<1, dim> vector(const unsigned int field, const unsigned int p) const
    {
      dealii::Tensor<1, dim> value;
      for (unsigned int d = 0; d < dim; ++d)
        value[d] = component(field, d)[p];
      return value;
    }

    /** A tensor field of one particle that is stored row by row. */
    dealii::Tensor<2, dim> matrix(const unsigned int field, const unsigned int p) const
    {
      dealii::Tensor<2, dim> value;
      for (unsigned int c = 0; c < dim * dim; ++c)
        value[c / dim][c % dim] = component(field, c)[p];
      return value;
    }

    /** Number of a particle's material. */
    unsigned int material_of(const unsigned int p) const
    {
      return std::upper_bound(material_begin.begin(), material_begin.end(), p) - material_begin.begin() - 1;
    }

    // Fields that every run has; tensors row by row.
    unsigned int position, velocity, grad_v, F, stress, mass, volume, initial_position;

    std::vector<Field>                         fields;
    std::vector<dealii::types::particle_index> id;
    std::vector<unsigned short>                body;

    /** Where each particle's stencil begins, if the grid wants that kept; else empty. */
    std::vector<unsigned int> place;
    bool                      keeps_places = false;

    /** Particles material_begin[m] .. material_begin[m + 1] - 1 are of material m. */
    std::vector<unsigned int> material_begin;

    /** Of each material, the fields that hold its state. */
    std::vector<std::vector<unsigned int>> state_fields;

  private:
    std::vector<dealii::AlignedVector<double>> columns;
  };
} // namespace Talus

#include <talus/core/exceptions.h>
#include <talus/core/reduction.h>
#include <talus/postprocess/probes.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <limits>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    constexpr double infinity = std::numeric_limits<double>::infinity();

    /** The particle that is nearest to a point: on this rank, or of all. */
    struct Nearest
    {
      double       distance = infinity; // [length]
      double       id       = infinity;
      unsigned int slot     = 0;
    };

    /** Among particles at equal distance the one with the lowest id. `field` holds the positions. */
    template <int dim>
    Nearest nearest_on_this_rank(const WorkingSet<dim> &particles, const unsigned int field, const Point<dim> &point)
    {
      const auto x = particles.template components<dim>(field);
      Nearest    best;
      for (unsigned int p = 0; p < particles.size(); ++p)
      {
        double distance_squared = 0;
        for (unsigned int d = 0; d < dim; ++d)
          distance_squared += (x[d][p] - point[d]) * (x[d][p] - point[d]);
        if (distance_squared < best.distance || (distance_squared == best.distance && particles.id[p] < best.id))
          best = {distance_squared, static_cast<double>(particles.id[p]), p};
      }
      best.distance = std::sqrt(best.distance);
      return best;
    }

    /** For each point the nearest particle of all ranks; `slot` is set on the rank that holds it. */
    template <int dim>
    std::vector<Nearest> nearest(const WorkingSet<dim> &particles, const unsigned int field,
                                 const std::vector<Point<dim>> &points, MPI_Comm communicator)
    {
      std::vector<Nearest> local, global(points.size());
      std::vector<double>  distances, ids;
      for (const auto &point : points)
      {
        local.push_back(nearest_on_this_rank(particles, field, point));
        distances.push_back(local.back().distance);
      }
      Utilities::MPI::min(distances, communicator, distances);
      for (unsigned int i = 0; i < points.size(); ++i)
        ids.push_back(local[i].distance == distances[i] ? local[i].id : infinity);
      Utilities::MPI::min(ids, communicator, ids);
      for (unsigned int i = 0; i < points.size(); ++i)
        global[i] = {distances[i], ids[i], local[i].slot};
      return global;
    }
  } // namespace

  template <int dim>
  Probe<dim>::Probe(const std::string &section, const std::string &name) :
    ParameterAcceptor(section), name(name), coordinates(dim, 0.)
  {
    add_parameter("Kind", kind,
                  "point: the particle nearest to the point at each time; "
                  "particle: the one that is nearest at the start, followed.",
                  prm, Patterns::Selection("point|particle"));
    add_parameter("Position", coordinates, "The point [length].", prm, Patterns::List(Patterns::Double(), dim, dim));
  }

  template <int dim>
  void Probe<dim>::parse_parameters(ParameterHandler &)
  {
    is_particle = kind == "particle";
    for (unsigned int d = 0; d < dim; ++d)
      position[d] = coordinates[d];
  }

  template <int dim>
  Probes<dim>::Probes(Parameters &parameters, const std::string &section) : ParameterAcceptor(section)
  {
    for (const auto &name : parameters.names(section, "Names of the points and particles that are watched."))
    {
      probes.push_back(std::make_unique<Probe<dim>>(section + "/" + name, name));
      if (!parameters.is_set(section + "/" + name, "Position"))
        parameters.warn(
          EntryError(section + "/" + name, "Position", "the probe has been given no place and watches the origin."));
    }
    add_parameter("Fields", field_names, "Particle fields to write into probes.csv.");
  }

  template <int dim>
  void Probes<dim>::open(const std::string &directory, const WorkingSet<dim> &particles, const Grid<dim> &grid)
  {
    find(particles, grid);
    if (!probes.empty())
      file.open(directory + "/probes.csv", table.columns(), communicator);
  }

  template <int dim>
  void Probes<dim>::reopen(const std::string &directory, const double time, const WorkingSet<dim> &particles,
                           const Grid<dim> &grid)
  {
    find(particles, grid);
    if (!probes.empty())
      file.reopen(directory + "/probes.csv", table.columns(), time, communicator);
  }

  template <int dim>
  void Probes<dim>::find(const WorkingSet<dim> &particles, const Grid<dim> &grid)
  {
    communicator = grid.communicator;
    fields       = select_particle_fields(particles, field_names, get_section_name(), "Fields");
    if (probes.empty())
      return;

    std::vector<Point<dim>> points;
    for (const auto &probe : probes)
      points.push_back(probe->position);
    const auto found = nearest(particles, particles.initial_position, points, communicator);
    table.add("time", "time", time);
    for (unsigned int i = 0; i < probes.size(); ++i)
    {
      Probe<dim> &probe = *probes[i];
      if (!(probe.is_particle && probe.is_found))
      {
        check_position(probe, grid, found[i].distance);
        probe.id = static_cast<types::particle_index>(found[i].id);
      }
      if (!probe.is_particle)
        table.add(probe.name + "_distance", "length", probe.distance);
      probe.values.resize(n_components(fields));
      auto value = probe.values.cbegin();
      for (const auto &field : fields)
        for (const auto &component : field.components)
          table.add(probe.name + "_" + component, field.unit, *value++);
    }
  }

  template <int dim>
  void Probes<dim>::check_position(const Probe<dim> &probe, const Grid<dim> &grid, const double distance) const
  {
    for (unsigned int d = 0; d < dim; ++d)
    {
      if (!grid.is_between(probe.position[d], grid.lower[d], grid.upper[d], d))
        throw EntryError(probe.get_section_name(), "Position",
                         "the point lies outside the grid. Move it into the grid's box.");
    }
    if (probe.is_particle && distance > std::sqrt(grid.diagonal_square()))
      throw EntryError(probe.get_section_name(), "Position",
                       "no particle starts within a cell's diagonal of this point; the nearest one is " +
                         std::to_string(distance) + " away. Move the point into a body.");
  }

  template <int dim>
  void Probes<dim>::serialize(Archive &archive)
  {
    const Archive::Scope scope(archive, "probes");
    std::vector<double>  ids;
    for (const auto &probe : probes)
      ids.push_back(probe->is_lost ? -1. : static_cast<double>(probe->id));
    archive("ids", ids);
    if (!archive.is_reading())
      return;
    AssertThrow(ids.size() == probes.size(), InputError("the checkpoint is not of a run with these probes."));
    for (unsigned int i = 0; i < probes.size(); ++i)
    {
      probes[i]->is_found = true;
      probes[i]->is_lost  = !(ids[i] >= 0);
      probes[i]->id       = probes[i]->is_lost ? 0 : static_cast<types::particle_index>(ids[i]);
    }
  }

  template <int dim>
  void Probes<dim>::renumber(const std::function<std::optional<std::uint64_t>(std::uint64_t)> &new_id)
  {
    for (const auto &probe : probes)
      if (probe->is_particle && !probe->is_lost)
      {
        const auto id  = new_id(probe->id);
        probe->is_lost = !id;
        probe->id      = static_cast<types::particle_index>(id.value_or(0));
      }
  }

  template <int dim>
  std::vector<std::string> Probes<dim>::lost() const
  {
    std::vector<std::string> sections;
    for (const auto &probe : probes)
      if (probe->is_lost)
        sections.push_back(probe->get_section_name());
    return sections;
  }

  template <int dim>
  Tensor<1, dim> Probes<dim>::position_of(const std::string &name, const WorkingSet<dim> &particles) const
  {
    Tensor<1, dim> x;
    for (const auto &probe : probes)
      if (probe->name == name)
        if (const auto at = std::find(particles.id.begin(), particles.id.end(), probe->id); at != particles.id.end())
          x = particles.vector(particles.position, at - particles.id.begin());
    return Utilities::MPI::sum(x, communicator);
  }

  template <int dim>
  void Probes<dim>::sample(const WorkingSet<dim> &particles)
  {
    std::vector<Point<dim>> points;
    for (const auto &probe : probes)
      if (!probe->is_particle)
        points.push_back(probe->position);
    const auto found = nearest(particles, particles.position, points, communicator);
    auto       next  = found.begin();

    // The rank that holds a particle gives its values, the others zeros.
    const bool is_root = Utilities::MPI::this_mpi_process(communicator) == 0;
    for (const auto &probe : probes)
    {
      auto &slot = probe->slot;
      if (!probe->is_particle)
      {
        probe->distance = is_root ? next->distance : 0.;
        probe->id       = static_cast<types::particle_index>(next->id);
        slot            = next++->slot;
      }
      else if (slot >= particles.size() || particles.id[slot] != probe->id)
        slot = std::find(particles.id.begin(), particles.id.end(), probe->id) - particles.id.begin();

      std::fill(probe->values.begin(), probe->values.end(), 0.);
      if (!probe->is_lost && slot < particles.size() && particles.id[slot] == probe->id)
      {
        double *values = probe->values.data();
        for (const auto &field : fields)
        {
          field.evaluate(particles, slot, values);
          values += field.components.size();
        }
      }
    }
  }

  template <int dim>
  void Probes<dim>::write(const double time, const WorkingSet<dim> &particles)
  {
    if (probes.empty())
      return;
    this->time = time;
    sample(particles);
    Reduction reduction;
    for (const auto &probe : probes)
    {
      reduction.sum(probe->distance);
      reduction.sum(probe->values);
    }
    reduction.run(communicator);
    file.write_row(table.row());
  }

  template class Probe<2>;
  template class Probe<3>;
  template class Probes<2>;
  template class Probes<3>;
} // namespace Talus

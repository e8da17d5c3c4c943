#include <talus/core/function.h>
#include <talus/simulation/checks.h>

#include <cstdlib>

namespace Talus
{
  using namespace dealii;
  using internal::sentence;

  template <int dim>
  void Checks<dim>::check_filling()
  {
    // The largest box of the grid, or two triangles or six tetrahedra.
    double cell_volume = 1;
    for (unsigned int d = 0; d < dim; ++d)
      cell_volume *= model.grid.spacing[d];
    if (dynamic_cast<const BoxGrid<dim> *>(&model.grid) == nullptr)
    {
      cell_volume = 0;
      for (const auto &cell : model.grid.triangulation.active_cell_iterators())
        if (cell->is_locally_owned())
          cell_volume = std::max(cell_volume, (dim == 2 ? 2. : 6.) * cell->measure());
      cell_volume = Utilities::MPI::max(cell_volume, model.grid.communicator);
    }
    const auto &particles = model.particles;
    const auto *volume    = particles.component(particles.volume, 0);
    // Of each body: the greatest volume of a particle, and the sum.
    std::vector<double> largest(extents.size(), 0.), sum(extents.size(), 0.);
    for (unsigned int p = 0; p < particles.size(); ++p)
    {
      double &most = largest[particles.body[p]];
      most         = std::max(most, volume[p]);
      sum[particles.body[p]] += volume[p];
    }
    Utilities::MPI::max(largest, model.grid.communicator, largest);
    Utilities::MPI::sum(sum, model.grid.communicator, sum);
    for (unsigned int b = 0; b < extents.size(); ++b)
    {
      const Body<dim> &body         = *model.bodies[b];
      const bool       is_too_large = largest[b] > 1.001 * std::pow(2., dim) * cell_volume;
      if (!body.shape->is_list())
      {
        if (is_too_large)
          warn(body.get_section_name(), body.shape->density_entry(),
               sentence("the largest particle has the volume ", largest[b], ", and cells have at most ", cell_volume,
                        ": neighbours are too far apart to feel each other. Take more particles."));
        continue;
      }
      double box = 1;
      for (unsigned int d = 0; d < dim; ++d)
        box *= extents[b].upper[d] - extents[b].lower[d];
      if (sum[b] > 1.5 * box || is_too_large)
        warn(body.get_section_name(), body.shape->position_entry(),
             sentence("the largest volume of a point is ", largest[b], ", that of a cell ", cell_volume,
                      ", and all together are ", sum[b], " in a box of ", box,
                      ". Check the unit of the volumes, and that they are no masses."));
      else if (extents[b].n >= 10 && largest[b] < 1e-4 * cell_volume && sum[b] < 1e-3 * box)
        warn(body.get_section_name(), body.shape->position_entry(),
             sentence("all volumes of its points together are ", sum[b], " in a box of ", box,
                      ". Check the unit of the volumes."));
    }
  }

  template <int dim>
  void Checks<dim>::check_clipping()
  {
    const auto box = dynamic_cast<const BoxGrid<dim> *>(&model.grid);
    if (box == nullptr)
      return;
    const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(box->communicator),
                       rank    = Utilities::MPI::this_mpi_process(box->communicator);
    for (const auto &body : model.bodies)
    {
      if (!body->is_clipped || body->shape->is_list())
        continue;
      // The volumes of the particles in the grid, and what lies in the grid of all particles' boxes.
      std::vector<double> volumes(2, 0.);
      body->shape->visit_part(rank, n_ranks, [&](const std::uint64_t, const Point<dim> &x, const double volume) {
        const auto edges = body->shape->half_edges(x, volume);
        double     part  = 1;
        for (unsigned int d = 0; d < dim; ++d)
        {
          double half = 0;
          for (const auto &edge : edges)
            half += std::abs(edge[d]);
          part *=
            std::max(0., std::min(x[d] + half, box->upper[d]) - std::max(x[d] - half, box->lower[d])) / (2 * half);
        }
        Point<dim> y = x;
        volumes[0] += box->share_inside(y) * volume;
        volumes[1] += part * volume;
      });
      Utilities::MPI::sum(volumes, box->communicator, volumes);
      if (std::abs(volumes[0] - volumes[1]) > 0.01 * volumes[1])
        warn(body->get_section_name(), "Clip to grid",
             sentence("the particles left have a volume of ", volumes[0], ", and what the grid leaves of the body has ",
                      volumes[1],
                      ": a face of the grid runs through the particles' boxes. Move the face, the body or "
                      "its 'Lattice offset', so that the face lies midway between two rows of particles or on one; a "
                      "box may as well end at the face."));
    }
  }

  template <int dim>
  void Checks<dim>::check_pressures()
  {
    // A fluid under its own weight: its density may change by some percent.
    for (unsigned int b = 0; b < extents.size(); ++b)
    {
      const std::string material = "/Materials/" + model.material_names[model.bodies[b]->material];
      const double      c        = std::strtod(parameters.value(material, "Sound speed", "0").c_str(), nullptr);
      if (!(c > 0))
        continue;
      const Tensor<1, dim> g      = mean_pull(b);
      double               height = 0;
      for (unsigned int d = 0; d < dim; ++d)
        height += std::abs(g[d]) / std::max(g.norm(), 1e-300) * (extents[b].upper[d] - extents[b].lower[d]);
      const double change = g.norm() * height / (c * c);
      if (change > 0.1)
        warn(material, "Sound speed",
             sentence("it is ", c, ", and the weight of '", model.bodies[b]->name, "', ", height,
                      " high, alone would compress it by ", 100 * change, " %. Take at least ",
                      10 * std::sqrt(2 * g.norm() * height), ", ten times the speed of falling that far."));
    }
  }

  template <int dim>
  void Checks<dim>::check_loads()
  {
    for (unsigned int b = 0; b < extents.size(); ++b)
    {
      const std::string section = model.bodies[b]->get_section_name();
      if (parameters.value(section, "Initial stress", "none") == "uniform" && !parameters.is_set(section, "Stress"))
        warn(section, "Stress", "the initial stress is zero: it has no effect.");
    }
    for (const auto &load : model.tractions.loads)
    {
      const std::string section = load->get_section_name();
      const std::string type    = parameters.value(section, "Type", "traction");
      const std::string entry   = type == "traction" ? "Traction" : type == "force" ? "Force" : "Pressure";
      if (!parameters.is_set(section, entry))
        continue; // said before
      std::string text = parameters.value(section, entry, "0");
      if (type == "pressure")
        for (unsigned int d = 1; d < dim; ++d)
          text += "; " + parameters.value(section, entry, "0");
      ParsedVector<dim> function;
      function.initialize(text, section, entry);
      // At many times, and many places of the grid.
      constexpr unsigned int n_times = 100, n_places = 5;
      const unsigned int     n       = std::pow(n_places, dim);
      bool                   is_zero = true;
      for (unsigned int place = 0; is_zero && place < (function.depends_on_space() ? n : 1); ++place)
      {
        Point<dim>   x;
        unsigned int rest = place;
        for (unsigned int d = 0; d < dim; ++d, rest /= n_places)
          x[d] = model.grid.lower[d] + (model.grid.upper[d] - model.grid.lower[d]) * (rest % n_places + 0.3) / n_places;
        for (unsigned int k = 0; is_zero && k <= n_times; ++k)
          is_zero = function.evaluate(x, end_time * k / n_times).norm() == 0;
      }
      if (is_zero)
        warn(section, entry,
             sentence("the load is zero at all times up to the end, ", end_time, ": it has no effect."));
    }
  }

#define INSTANTIATE(dim)                                                                                               \
  template void Checks<dim>::check_filling();                                                                          \
  template void Checks<dim>::check_clipping();                                                                         \
  template void Checks<dim>::check_pressures();                                                                        \
  template void Checks<dim>::check_loads();
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Talus

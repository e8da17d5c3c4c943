#include <talus/simulation/checks.h>

#include <limits>
#include <unordered_map>
#include <sstream>

namespace Talus
{
  using namespace dealii;
  using internal::axes;
  using internal::sentence;

  namespace
  {
    std::array<double, 6> stress_at(const MaterialRange &range, const unsigned int p)
    {
      std::array<double, 6> stress{};
      for (unsigned int c = 0; c < 6; ++c)
        if (range.stress[c] != nullptr)
          stress[c] = range.stress[c][p];
      return stress;
    }

    /** The stress that a law makes of a particle's own when nothing deforms it: another one, if it cannot bear it. */
    std::array<double, 6> stress_at_rest(const Material &material, const MaterialRange &range, const unsigned int p)
    {
      MaterialRange       one = range;
      std::vector<double> numbers(9 + 9 + 6 + 2 + MaterialRange::max_states, 0.);
      double             *next = numbers.data();
      const auto          copy = [&](auto &array) {
        if (array == nullptr)
          return;
        *next = array[p];
        array = next++;
      };
      for (auto &array : one.grad_v)
        copy(array);
      std::fill(numbers.data(), next, 0.);
      for (auto &array : one.F)
        copy(array);
      for (auto &array : one.stress)
        copy(array);
      copy(one.mass);
      copy(one.volume);
      for (auto &array : one.state)
        copy(array);
      one.begin    = 0;
      one.end      = 1;
      one.is_plain = true;
      material.update(one);
      return stress_at(one, 0);
    }
  } // namespace

  template <int dim>
  Checks<dim>::Checks(Parameters &parameters, Model<dim> &model, const double begin_time, const double end_time) :
    parameters(parameters), model(model), begin_time(begin_time), end_time(end_time)
  {
  }

  template <int dim>
  void Checks<dim>::run(const double step_size, const double signal_speed, const unsigned int max_steps)
  {
    for (const auto &condition : model.boundary.conditions)
      condition->check_before_start(model.grid, end_time);
    find_extents();
    check_sizes();
    check_layers();
    check_yield();
    check_materials();
    check_idle_entries();
    check_filling();
    check_clipping();
    check_pressures();
    check_loads();
    check_intervals();
    check_overridden();
    check_edges();
    check_floor();
    check_obstacles();
    check_steps(step_size, signal_speed, max_steps);
  }

  template <int dim>
  void Checks<dim>::find_extents()
  {
    const auto                                    &particles = model.particles;
    constexpr double                               infinity  = std::numeric_limits<double>::infinity();
    const unsigned int                             n_bodies  = model.bodies.size();
    std::unordered_map<std::size_t, unsigned char> in_cell;
    // Particles of a cell and material stand together: the map is asked once for all of them.
    std::size_t    cell   = 0;
    unsigned char *n      = nullptr;
    const auto     around = [&](const unsigned int p) -> unsigned char     &{
      const std::size_t number = model.grid.cell_number(Point<dim>(particles.vector(particles.position, p)));
      if (n == nullptr || number != cell)
        n = &in_cell[number];
      cell = number;
      return *n;
    };
    for (unsigned int p = 0; p < particles.size(); ++p)
      if (auto &number = around(p); number < 2)
        ++number;

    // Lower corners, and upper corners with the other sign, so that all are minima.
    std::vector<double>        corners(2 * dim * n_bodies, infinity);
    std::vector<std::uint64_t> counts(2 * n_bodies, 0);
    for (unsigned int p = 0; p < particles.size(); ++p)
    {
      const unsigned int b    = particles.body[p];
      const double       half = 0.5 * std::pow(particles.component(particles.volume, 0)[p], 1. / dim);
      ++counts[2 * b];
      counts[2 * b + 1] += around(p) == 1;
      for (unsigned int d = 0; d < dim; ++d)
      {
        const double x   = particles.component(particles.position, d)[p];
        double      &low = corners[2 * (dim * b + d)], &high = corners[2 * (dim * b + d) + 1];
        low  = std::min(low, x - half);
        high = std::min(high, -x - half);
      }
    }
    Utilities::MPI::min(corners, model.grid.communicator, corners);
    Utilities::MPI::sum(counts, model.grid.communicator, counts);
    extents.resize(n_bodies);
    for (unsigned int b = 0; b < n_bodies; ++b)
    {
      extents[b].n       = counts[2 * b];
      extents[b].n_alone = counts[2 * b + 1];
      for (unsigned int d = 0; d < dim; ++d)
      {
        extents[b].lower[d] = corners[2 * (dim * b + d)];
        extents[b].upper[d] = -corners[2 * (dim * b + d) + 1];
      }
    }
  }

  template <int dim>
  void Checks<dim>::check_sizes()
  {
    for (unsigned int b = 0; b < extents.size(); ++b)
    {
      const Extent    &extent = extents[b];
      const Body<dim> &body   = *model.bodies[b];
      if (extent.n < 2)
        continue; // a tracer
      unsigned int thin    = 0;
      double       n_cells = 3 - 1e-6;
      bool         is_thin = false;
      for (unsigned int d = 0; d < dim; ++d)
      {
        const double across = (extent.upper[d] - extent.lower[d]) * model.grid.inverse_spacing[d];
        // What reaches from wall to wall is meant to be the same all along.
        const bool fills_grid = extent.lower[d] <= model.grid.lower[d] + 0.5 * model.grid.spacing[d] &&
                                extent.upper[d] >= model.grid.upper[d] - 0.5 * model.grid.spacing[d];
        if (!fills_grid && across < n_cells)
        {
          thin    = d;
          n_cells = across;
          is_thin = true;
        }
      }
      if (is_thin)
        warn(body.get_section_name(), body.shape->position_entry(),
             sentence("the body is ", n_cells, " cells across along ", axes[thin],
                      ", fewer than 3: its particles move nearly as one. Take a smaller spacing."));
      if (extent.n >= 10 && extent.n_alone > 0.3 * extent.n)
      {
        warn(body.get_section_name(), body.shape->density_entry(),
             sentence(100 * extent.n_alone / extent.n,
                      " % of the body's particles are alone in their cell: the body is too "
                      "thin for this grid and may fall apart. Take more particles, or a larger spacing."));
      }
    }
  }

  template <int dim>
  void Checks<dim>::check_layers()
  {
    for (unsigned int b = 0; b < extents.size(); ++b)
    {
      const Body<dim> &body  = *model.bodies[b];
      const auto       layer = body.layer();
      if (!layer)
        continue;
      const unsigned int up     = layer->axis;
      const double       bottom = extents[b].lower[up], top = extents[b].upper[up];
      const double       round_off = 1e-6 * model.grid.spacing[up];
      const auto         middle    = extents[b].lower + (extents[b].upper - extents[b].lower) / 2;
      // Gravity must act from the start: a ramp would let the layer go at once.
      const double      g      = 0 - model.acceleration.value(Point<dim>(middle), 0.)[up]; // 0, not -0
      const double      weight = model.materials[body.material]->density * g;
      const double      stress = layer->unit_weight * std::max(0., layer->surface_level - bottom);
      const std::string column =
        sentence("At the body's base, ", axes[up], " = ", bottom, ", the initial stress is ", stress,
                 ", and the weight of the body above it ", weight * (top - bottom), ".");
      if (!(std::abs(layer->unit_weight - weight) <= 0.02 * std::abs(weight)))
        warn(body.get_section_name(), "Unit weight",
             sentence("it is ", layer->unit_weight, ", but density times body force is ", weight,
                      " at the start: the body will not be at rest. ", column));
      if (layer->surface_level < top - round_off)
        warn(body.get_section_name(), "Surface level",
             sentence("it is ", layer->surface_level, ", but the body reaches up to ", axes[up], " = ", top,
                      ": what lies above the level begins without stress. ", column));
      // What lies above presses: another body, or a load.
      bool is_loaded = !model.tractions.loads.empty();
      for (const auto &other : extents)
        is_loaded = is_loaded || other.upper[up] > top + round_off;
      const double above = layer->surface_level - top;
      if (!is_loaded && above > model.grid.spacing[up] &&
          weight * above > 0.02 * weight * (layer->surface_level - bottom))
        warn(body.get_section_name(), "Surface level",
             sentence("it is ", layer->surface_level, ", but nothing lies above the body, which ends at ", axes[up],
                      " = ", top, ": there the initial stress is ", layer->unit_weight * above,
                      ", and nothing bears it. ", column));
    }
  }

  template <int dim>
  void Checks<dim>::check_yield()
  {
    const auto                        &particles = model.particles;
    const auto                         ranges    = material_ranges(model.particles, /* dt = */ 0.);
    std::vector<double>                changes(extents.size(), 0.); // largest change over the stress
    std::vector<std::array<double, 6>> now(extents.size()), then(extents.size());
    for (unsigned int m = 0; m < ranges.size(); ++m)
      for (unsigned int p = ranges[m].begin; p < ranges[m].end; ++p)
      {
        const unsigned int b = particles.body[p];
        if (!model.bodies[b]->has_initial_stress())
          continue;
        const auto before = stress_at(ranges[m], p), after = stress_at_rest(*model.materials[m], ranges[m], p);
        double     change = 0, size = 0;
        for (unsigned int c = 0; c < 6; ++c)
        {
          change = std::max(change, std::abs(after[c] - before[c]));
          size   = std::max(size, std::abs(before[c]));
        }
        if (size > 0 && change / size > changes[b])
        {
          changes[b] = change / size;
          now[b]     = before;
          then[b]    = after;
        }
      }
    using Greatest = std::tuple<double, std::array<double, 6>, std::array<double, 6>>;
    for (unsigned int b = 0; b < changes.size(); ++b)
    {
      Greatest greatest(changes[b], now[b], then[b]);
      for (const auto &other : Utilities::MPI::all_gather(model.grid.communicator, greatest))
        if (std::get<0>(other) > std::get<0>(greatest))
          greatest = other;
      const auto &[change, before, after] = greatest;
      // The shape of a cone that is matched to another law leaves a few percent open.
      if (change > 0.05)
        warn(model.bodies[b]->get_section_name(), "Initial stress",
             sentence("it lies outside the yield surface of '", model.material_names[model.bodies[b]->material],
                      "': the first step takes (xx, yy, zz) = (", before[0], ", ", before[1], ", ", before[2], ") to (",
                      after[0], ", ", after[1], ", ", after[2], "). Change the ratio of rest, or the strength."));
    }
  }

  template <int dim>
  void Checks<dim>::check_materials()
  {
    for (unsigned int m = 0; m < model.materials.size(); ++m)
    {
      bool is_used = false;
      for (const auto &body : model.bodies)
        is_used = is_used || body->material == m;
      // Another stage may have a body of it.
      if (!is_used && !parameters.has_section("Stages"))
        warn("/Materials", "Names", "no body is made of '" + model.material_names[m] + "': it has no effect.");
      for (const auto &doubt : model.materials[m]->doubts())
        parameters.warn(doubt);
    }
  }

  template class Checks<2>;
  template class Checks<3>;
} // namespace Talus

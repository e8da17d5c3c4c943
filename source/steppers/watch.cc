#include <talus/core/exceptions.h>
#include <talus/particles/batch_access.h>
#include <talus/steppers/remedy.h>
#include <talus/steppers/watch.h>

#include <algorithm>
#include <iomanip>
#include <limits>
#include <numeric>
#include <sstream>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    constexpr double largest_increment = 0.5;

    template <class Number>
    double greatest(const Number &value)
    {
      return *std::max_element(value.data(), value.data() + Number::n_lanes);
    }

    template <class Number>
    double sum(const Number &value)
    {
      return std::accumulate(value.data(), value.data() + Number::n_lanes, 0.);
    }
  } // namespace

  std::string Moment::text() const
  {
    std::ostringstream text;
    text << " in step " << step << ", t = " << time << ", dt = " << dt;
    return text.str();
  }

  template <int dim>
  void Watch<dim>::start(const std::vector<MaterialRange> &ranges, const double time, const double dt)
  {
    this->ranges = &ranges;
    this->time   = time;
    this->dt     = dt;

    const WorkingSet<dim> &particles = model.particles;
    x = particles.template components<dim>(model.acceleration.is_of_initial_position() ? particles.initial_position :
                                                                                         particles.position);
    position       = particles.template components<dim>(particles.position);
    start_position = particles.template components<dim>(particles.initial_position);
    v              = particles.template components<dim>(particles.velocity);
    F              = particles.template components<dim * dim>(particles.F);
    grad_v         = particles.template components<dim * dim>(particles.grad_v);
    stress         = particles.template components<WorkingSet<dim>::n_stress>(particles.stress);
    mass           = particles.component(particles.mass, 0);

    b                 = model.acceleration.uniform_value(time);
    sums.signal_speed = sums.mass = sums.kinetic_energy = 0.;
    sums.moment                                         = Tensor<1, dim, Number>();
    body_force_power                                    = 0;
    failed                                              = Particles<dim>::none;
  }

  template <int dim>
  void Watch<dim>::look_at(const unsigned int begin, const unsigned int end)
  {
    speeds.resize(end - begin);
    for (unsigned int m = 0; m < ranges->size(); ++m)
    {
      const MaterialRange range = intersection((*ranges)[m], begin, end);
      if (range.begin == range.end)
        continue;
      model.materials[m]->wave_speeds(range, speeds.data() + (range.begin - begin));
      const double largest = model.materials[m]->largest_volume_ratio();
      add_up(range.begin, range.end, speeds.data() - begin, largest);
    }

    if (model.acceleration.depends_on_space())
      for (unsigned int p = begin; p < end; ++p)
      {
        const SingleBatch    one{p};
        const Tensor<1, dim> v_p = load_vector<dim>(one, v);
        Point<dim>           x_p(load_vector<dim>(one, x));
        // In the middle of its way: with the force at its end, work drifts from the potential energy by a share of the
        // phase that a swing makes in a step.
        if (!model.acceleration.is_of_initial_position())
          x_p -= 0.5 * dt * v_p;
        body_force_power += mass[p] * (model.acceleration.value(x_p, time) * v_p);
      }
  }

  template <int dim>
  void Watch<dim>::add_up(const unsigned int begin, const unsigned int end, const double *speeds,
                          const double largest_volume_ratio)
  {
    Sums here      = sums; // in registers
    auto is_broken = Number(1.) < Number(0.);
    for_each_batch(begin, end, [&](const auto batch) {
      const auto   v_p = load_vector<dim>(batch, v);
      const Number m = batch.load(mass), squares = v_p.norm_square(), counted_mass = batch.used_lanes(m);
      here.signal_speed = max(here.signal_speed, batch.load(speeds) + sqrt(squares));
      here.mass += counted_mass;
      here.kinetic_energy += 0.5 * counted_mass * squares;
      for (unsigned int d = 0; d < dim; ++d)
        here.moment[d] += counted_mass * (batch.load(position[d]) - batch.load(start_position[d]));
      is_broken = is_broken | !limits(batch, squares, largest_volume_ratio).are_kept();
    });
    sums = here;
    if (any(is_broken))
      for_each_batch(begin, end, [&](const auto batch) {
        const Limits kept = limits(batch, load_vector<dim>(batch, v).norm_square(), largest_volume_ratio);
        for (unsigned int l = 0; l < batch.size(); ++l)
          if (!kept.are_kept()[l])
            note(batch.p + l, !kept.is_finite[l] ? Limit::finite :
                              !kept.is_open[l]   ? Limit::volume_ratio :
                                                   Limit::increment);
      });
  }

  template <int dim>
  template <class Batch>
  typename Watch<dim>::Limits Watch<dim>::limits(const Batch &batch, const Number &square_of_velocity,
                                                 const double largest_volume_ratio) const
  {
    Number magnitude = square_of_velocity, increment = 0.;
    for (const double *column : stress)
      magnitude += abs(batch.load(column));
    for (const double *column : grad_v)
    {
      const Number g = batch.load(column);
      increment += g * g;
    }
    const Number J = determinant(load_matrix<dim>(batch, F));
    // Comparisons are written so that NaN fails them.
    return {magnitude <= Number(std::numeric_limits<double>::max()),
            (J > Number(0.)) & (J <= Number(largest_volume_ratio)),
            dt * dt * increment <= Number(largest_increment * largest_increment)};
  }

  template <int dim>
  void Watch<dim>::note(const unsigned int p, const Limit limit)
  {
    const auto &id = model.particles.id;
    if (failed != Particles<dim>::none && id[failed] < id[p])
      return;
    failed = p;
    broken = limit;
  }

  template <int dim>
  Report Watch<dim>::finish(const double displacement, const Report *before)
  {
    const auto &particles = model.particles;
    if (particles.outside != particles.none && particles.outside != failed)
      note(particles.outside, Limit::grid);

    Report report;
    report.signal_speed     = greatest(sums.signal_speed);
    report.displacement     = displacement;
    report.n_particles      = particles.size();
    report.most_particles   = particles.size();
    report.needs_migration  = particles.needs_synchronise;
    report.needs_activation = particles.needs_activation;
    report.has_failed       = failed != particles.none;
    report.mass             = sum(sums.mass);
    report.kinetic_energy   = sum(sums.kinetic_energy);
    report.body_force_power = body_force_power;
    for (unsigned int d = 0; d < dim; ++d)
      report.moment[d] = sum(sums.moment[d]);

    // One message for all global numbers of a step.
    Reduction reduction;
    report.add_to(reduction);
    model.add_to(reduction);
    reduction.run(model.grid.communicator);
    // Force times way, and not times the particles' velocities: beyond mirrors, and with CPLS, these move elsewhere.
    if (before != nullptr && dt > 0 && !model.acceleration.depends_on_space())
      for (unsigned int d = 0; d < dim; ++d)
        report.body_force_power += b[d] * (report.moment[d] - before->moment[d]) / dt;
    if (report.has_failed)
      describe_failure(report);
    return report;
  }

  template <int dim>
  void Watch<dim>::describe_failure(Report &report) const
  {
    const auto &particles = model.particles;
    // Its number, whether it left the grid, its place, and what happened to it.
    using Failure = std::tuple<types::particle_index, bool, std::array<double, dim>, std::string>;
    Failure first(std::numeric_limits<types::particle_index>::max(), false, {}, "");
    if (failed != particles.none)
    {
      const auto              x = particles.vector(particles.position, failed);
      std::array<double, dim> place;
      for (unsigned int d = 0; d < dim; ++d)
        place[d] = x[d];
      std::ostringstream what;
      what << "Particle " << particles.id[failed] << ' ' << describe(failed, broken) << ", at " << to_text(x);
      first = {particles.id[failed], broken == Limit::grid && !model.grid.contains(x), place, what.str()};
    }
    for (const auto &other : Utilities::MPI::all_gather(model.grid.communicator, first))
      if (std::get<0>(other) < std::get<0>(first))
        first = other;
    Tensor<1, dim> x;
    for (unsigned int d = 0; d < dim; ++d)
      x[d] = std::get<2>(first)[d];
    report.failure = std::get<3>(first);
    report.remedy  = std::get<1>(first) ? remedy_of_exit(model, x) : remedy_of_instability(model) + lone_particles();
  }

  template <int dim>
  std::string Watch<dim>::lone_particles() const
  {
    const auto limit = model.lone_particle_limit(model.transfer->stiffness_factors());
    if (!limit)
      return "";
    std::ostringstream text;
    text << " Lone particles need a Courant number of at most " << std::setprecision(3)
         << *limit * model.material_factor() << " with this kernel, transfer and material.";
    return text.str();
  }

  template <int dim>
  std::string Watch<dim>::describe(const unsigned int p, const Limit limit) const
  {
    const auto        &particles = model.particles;
    std::ostringstream text;
    switch (limit)
    {
      case Limit::finite:
        text << "has a velocity or stress that is not a finite number";
        break;
      case Limit::volume_ratio:
        text << "has the volume ratio J = " << determinant(particles.matrix(particles.F, p)) << ", outside (0, "
             << model.materials[particles.material_of(p)]->largest_volume_ratio() << "]";
        break;
      case Limit::increment:
        text << "deforms by |grad v| dt = " << dt * particles.matrix(particles.grad_v, p).norm()
             << " in one step, more than " << largest_increment;
        break;
      case Limit::grid:
        text << (model.grid.contains(particles.vector(particles.position, p)) ?
                   "has a domain that reaches beyond the grid" :
                   "left the grid");
        break;
    }
    return text.str();
  }

  template class Watch<2>;
  template class Watch<3>;
} // namespace Talus

#include <talus/core/exceptions.h>
#include <talus/core/reduction.h>
#include <talus/particles/batch_access.h>
#include <talus/steppers/survey.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <sstream>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    /** A number that is finite only if velocity and stress of the particle are. */
    template <int dim>
    double magnitude(const WorkingSet<dim> &particles, const unsigned int p)
    {
      double sum = 0;
      for (unsigned int d = 0; d < dim; ++d)
        sum += std::abs(particles.component(particles.velocity, d)[p]);
      for (unsigned int c = 0; c < particles.n_stress; ++c)
        sum += std::abs(particles.component(particles.stress, c)[p]);
      return sum;
    }

    // Comparisons are written so that NaN fails them.
    bool             is_finite(const double x) { return x <= std::numeric_limits<double>::max(); }
    constexpr double largest_increment = 0.5;
    bool             is_valid_volume_ratio(const double J, const double largest) { return J > 0 && J <= largest; }
    bool             is_valid_increment(const double grad_v_dt) { return grad_v_dt <= largest_increment; }
  } // namespace

  template <int dim>
  Surveyor<dim>::Surveyor(Model<dim> &model, const std::vector<MaterialRange> &ranges, const double time,
                          const double dt) :
    model(model),
    ranges(ranges), time(time), dt(dt), b(model.acceleration.uniform_value(time))
  {
    const WorkingSet<dim> &particles = model.particles;

    place = particles.template components<dim>(
      model.acceleration.is_of_initial_position() ? particles.initial_position : particles.position);
    v        = particles.template components<dim>(particles.velocity);
    F        = particles.template components<dim * dim>(particles.F);
    grad_v   = particles.template components<dim * dim>(particles.grad_v);
    stress   = particles.template components<WorkingSet<dim>::n_stress>(particles.stress);
    mass     = particles.component(particles.mass, 0);
    volume   = particles.component(particles.volume, 0);
    is_valid = Number(0.) == Number(0.);
  }

  template <int dim>
  void Surveyor<dim>::look_at(const unsigned int begin, const unsigned int end)
  {
    speeds.resize(end - begin);
    for (unsigned int m = 0; m < ranges.size(); ++m)
    {
      const MaterialRange range = intersection(ranges[m], begin, end);
      if (range.begin == range.end)
        continue;
      model.materials[m]->wave_speeds(range, speeds.data() + (range.begin - begin));
      const double largest = model.materials[m]->largest_volume_ratio();
      for_each_batch(range.begin, range.end, [&](const auto batch) { look_at(batch, speeds.data() - begin, largest); });
    }

    if (model.acceleration.depends_on_space())
      for (unsigned int p = begin; p < end; ++p)
      {
        const SingleBatch one{p};
        const auto        b_p = model.acceleration.value(Point<dim>(load_vector<dim>(one, place)), time);
        body_force_power += mass[p] * (b_p * load_vector<dim>(one, v));
      }
  }

  template <int dim>
  template <class Batch>
  void Surveyor<dim>::look_at(const Batch &batch, const double *speeds, const double largest_volume_ratio)
  {
    const auto   v_p = load_vector<dim>(batch, v);
    const Number m = batch.load(mass), squares = v_p.norm_square(), counted_mass = batch.used_lanes(m);
    signal_speed = max(signal_speed, batch.load(speeds) + sqrt(squares));
    total_mass += counted_mass;
    kinetic_energy += 0.5 * counted_mass * squares;
    momentum += counted_mass * v_p;

    // Comparisons are written so that NaN fails them.
    Number magnitude = squares, increment = 0.;
    for (const double *column : stress)
      magnitude += abs(batch.load(column));
    for (const double *column : grad_v)
    {
      const Number g = batch.load(column);
      increment += g * g;
    }
    const Number J = determinant(load_matrix<dim>(batch, F));
    is_valid       = is_valid & (magnitude <= Number(std::numeric_limits<double>::max())) & (J > Number(0.)) &
               (J <= Number(largest_volume_ratio)) &
               (dt * dt * increment <= Number(largest_increment * largest_increment));
  }

  template <int dim>
  Survey<dim> Surveyor<dim>::finish(const double displacement)
  {
    const auto greatest = [](const Number &value) {
      return *std::max_element(value.data(), value.data() + Number::n_lanes);
    };
    const auto sum = [](const Number &value) {
      return std::accumulate(value.data(), value.data() + Number::n_lanes, 0.);
    };
    const auto  &particles  = model.particles;
    const double power      = model.acceleration.depends_on_space() ? body_force_power : [&] {
      double result = 0;
      for (unsigned int d = 0; d < dim; ++d)
        result += b[d] * sum(momentum[d]);
      return result;
    }();
    const bool   has_failed = any(!is_valid) || particles.outside != particles.none;

    std::vector<double> maxima = {greatest(signal_speed), static_cast<double>(particles.needs_synchronise),
                                  static_cast<double>(has_failed), displacement,
                                  static_cast<double>(particles.needs_activation)};
    std::vector<double> sums   = {sum(total_mass), sum(kinetic_energy), power};
    sums.insert(sums.end(), model.grid.lost_momentum.begin_raw(), model.grid.lost_momentum.end_raw());
    for (const auto &condition : model.boundary.conditions)
    {
      sums.insert(sums.end(), condition->reaction.begin_raw(), condition->reaction.end_raw());
      sums.insert(sums.end(), condition->nodal_force.begin_raw(), condition->nodal_force.end_raw());
      sums.push_back(condition->work);
    }
    sums.push_back(-model.boundary.damping.work);
    for (const auto &traction : model.tractions.loads)
    {
      sums.insert(sums.end(), traction->force.begin_raw(), traction->force.end_raw());
      sums.push_back(traction->work);
    }
    reduce(maxima, sums, model.grid.communicator);

    Survey<dim> result;
    result.signal_speed      = maxima[0];
    result.needs_synchronise = maxima[1] > 0;
    result.has_failed        = maxima[2] > 0;
    result.displacement      = maxima[3];
    result.needs_activation  = maxima[4] > 0;
    result.mass              = sums[0];
    result.kinetic_energy    = sums[1];
    result.body_force_power  = sums[2];
    auto next                = sums.begin() + 3;
    for (unsigned int d = 0; d < dim; ++d)
      result.lost_momentum[d] = *next++;
    const auto next_vector = [&] {
      Tensor<1, dim> vector;
      for (unsigned int d = 0; d < dim; ++d)
        vector[d] = *next++;
      return vector;
    };
    for (unsigned int c = 0; c < model.boundary.conditions.size(); ++c)
    {
      result.reactions.push_back(next_vector());
      result.nodal_forces.push_back(next_vector());
      result.works.push_back(*next++);
    }
    result.damping_energy = *next++;
    for (unsigned int l = 0; l < model.tractions.loads.size(); ++l)
    {
      result.traction_forces.push_back(next_vector());
      result.traction_work += *next++;
    }
    return result;
  }

  template <int dim>
  Survey<dim> survey(Model<dim> &model, const double time, const double dt)
  {
    const auto    ranges = material_ranges(model.particles, model.materials, dt);
    Surveyor<dim> surveyor(model, ranges, time, dt);
    surveyor.look_at(0, model.particles.size());
    return surveyor.finish(/* displacement = */ 0.);
  }

  template <int dim>
  [[noreturn]] void report_failure(Model<dim> &model, const unsigned int step, const double time, const double dt)
  {
    const Particles<dim> &particles = model.particles;
    using Report                    = std::pair<types::particle_index, std::string>;
    Report       first(std::numeric_limits<types::particle_index>::max(), "");
    unsigned int m = 0; // material of p
    for (unsigned int p = 0; p < particles.size(); ++p)
    {
      while (p >= particles.material_begin[m + 1])
        ++m;
      const double       largest    = model.materials[m]->largest_volume_ratio();
      const double       J          = determinant(particles.matrix(particles.F, p));
      const double       increment  = dt * particles.matrix(particles.grad_v, p).norm();
      bool               is_outside = false;
      std::ostringstream what;
      for (unsigned int d = 0; d < dim; ++d)
        is_outside =
          is_outside || !model.grid.lattice.is_inside(
                          model.grid.lattice.coordinate(particles.component(particles.position, d)[p], d), d);
      if (!is_finite(magnitude(particles, p)))
        what << "has a velocity or stress that is not a finite number";
      else if (!is_valid_volume_ratio(J, largest))
        what << "has the volume ratio J = " << J << ", outside (0, " << largest << "]";
      else if (!is_valid_increment(increment))
        what << "deforms by |grad v| dt = " << increment << " in one step, more than 0.5";
      else if (is_outside)
        what << "left the grid";
      else
        continue;
      if (particles.id[p] >= first.first)
        continue;
      what << ", at " << to_text(particles.vector(particles.position, p)) << " in step " << step << ", t = " << time
           << ", dt = " << dt << ". "
           << (is_outside ? "Enlarge the grid, or lower the Courant number." :
                            "Lower the Courant number, or correct the kernels near the boundary.");
      first = {particles.id[p], what.str()};
    }
    for (const auto &other : Utilities::MPI::all_gather(model.grid.communicator, first))
      first = std::min(first, other);
    throw RunError("Particle " + std::to_string(first.first) + " " + first.second);
  }

  namespace
  {
    /** The particle for which values[p] is greatest: number, place, and the value under its name. Collective. */
    template <int dim>
    std::string describe_greatest(const Model<dim> &model, const std::string &name, const std::vector<double> &values)
    {
      const Particles<dim>          &particles = model.particles;
      std::pair<double, std::string> greatest(-1., "");
      if (!values.empty())
      {
        const unsigned int p = std::max_element(values.begin(), values.end()) - values.begin();
        std::ostringstream text;
        text << "particle " << particles.id[p] << " at " << to_text(particles.vector(particles.position, p)) << " with "
             << name << " " << values[p];
        greatest = {values[p], text.str()};
      }
      for (const auto &other : Utilities::MPI::all_gather(model.grid.communicator, greatest))
        greatest = std::max(greatest, other);
      return greatest.second;
    }

    /** Elastic energy of each particle. */
    template <int dim>
    std::vector<double> strain_energies(const Model<dim> &model)
    {
      std::vector<double> energies(model.particles.size());
      const double       *volume = model.particles.component(model.particles.volume, 0);
      const auto          ranges = material_ranges(model.particles, model.materials, /* dt = */ 0.);
      for (unsigned int m = 0; m < ranges.size(); ++m)
        model.materials[m]->strain_energy_densities(ranges[m], energies.data() + ranges[m].begin);
      for (unsigned int p = 0; p < energies.size(); ++p)
        energies[p] *= volume[p];
      return energies;
    }
  } // namespace

  template <int dim>
  void EnergyWatch<dim>::start(const Survey<dim> &first, const double strain_energy)
  {
    initial_energy = first.kinetic_energy + strain_energy;
    // Round-off of a body at rest: velocities of a millionth of the wave speed.
    floor = 1e-12 * first.mass * first.signal_speed * first.signal_speed;
  }

  template <int dim>
  void EnergyWatch<dim>::check(const Model<dim> &model, const Survey<dim> &survey, const unsigned int step,
                               const double time, const double dt)
  {
    body_force_work += dt * survey.body_force_power;
    for (const double work : survey.works)
      condition_work += work;
    traction_work += survey.traction_work;
    damping_energy += survey.damping_energy;
    compare("kinetic energy", survey.kinetic_energy, step, time, dt, [&] {
      std::vector<double> speeds(model.particles.size());
      for (unsigned int p = 0; p < speeds.size(); ++p)
        speeds[p] = model.particles.vector(model.particles.velocity, p).norm();
      return "Fastest is " + describe_greatest(model, "speed", speeds);
    });
  }

  template <int dim>
  void EnergyWatch<dim>::check_total(const Model<dim> &model, const Survey<dim> &survey, const double strain_energy,
                                     const unsigned int step, const double time, const double dt) const
  {
    compare("kinetic and elastic energy", survey.kinetic_energy + strain_energy, step, time, dt, [&] {
      auto energies = strain_energies(model);
      for (unsigned int p = 0; p < energies.size(); ++p)
        energies[p] += 0.5 * model.particles.component(model.particles.mass, 0)[p] *
                       model.particles.vector(model.particles.velocity, p).norm_square();
      return "Most of it has " + describe_greatest(model, "energy", energies);
    });
  }

  template <int dim>
  void EnergyWatch<dim>::compare(const std::string &name, const double energy, const unsigned int step,
                                 const double time, const double dt, const std::function<std::string()> &culprit) const
  {
    // Not less what damping took: where little is left, the errors of what was put in would count.
    const double available = initial_energy + body_force_work + condition_work + traction_work;
    if (energy <= 2 * std::max(available, 0.) + floor)
      return;
    std::ostringstream message;
    message << "The " << name << " " << energy << " in step " << step << ", t = " << time << ", dt = " << dt
            << " is more than twice the " << available
            << " that initial state, body force, tractions and conditions account for: the run is unstable. "
            << culprit() << ". Lower the Courant number, or correct the kernels near the boundary.";
    throw RunError(message.str());
  }

#define INSTANTIATE(dim)                                                                                               \
  template class Surveyor<dim>;                                                                                        \
  template Survey<dim> survey(Model<dim> &, const double, const double);                                               \
  template void        report_failure(Model<dim> &, const unsigned int, const double, const double);                   \
  template class EnergyWatch<dim>;
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Talus

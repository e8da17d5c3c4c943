#include <talus/core/exceptions.h>
#include <talus/core/reduction.h>
#include <talus/steppers/survey.h>

#include <limits>
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
    bool is_finite(const double x) { return x <= std::numeric_limits<double>::max(); }
    bool is_valid_volume_ratio(const double J) { return J > 0 && J <= 10; }
    bool is_valid_increment(const double grad_v_dt) { return grad_v_dt <= 0.5; }
  } // namespace

  template <int dim>
  Survey<dim> survey(Model<dim> &model, const double time, const double dt)
  {
    Particles<dim>     &particles = model.particles;
    Survey<dim>         result;
    std::vector<double> maxima(3, 0.), sums(3 + dim, 0.);
    const auto          mass     = particles.component(particles.mass, 0);
    const auto          volume   = particles.component(particles.volume, 0);
    const auto          x        = particles.template components<dim>(particles.position);
    const auto          v        = particles.template components<dim>(particles.velocity);
    auto                b        = model.acceleration.value({}, time);
    bool                is_valid = particles.outside == particles.none;

    for (unsigned int m = 0; m + 1 < particles.material_begin.size(); ++m)
      for (unsigned int p = particles.material_begin[m]; p < particles.material_begin[m + 1]; ++p)
      {
        Tensor<1, dim> v_p;
        Point<dim>     x_p;
        for (unsigned int d = 0; d < dim; ++d)
        {
          v_p[d] = v[d][p];
          x_p[d] = x[d][p];
        }
        if (model.acceleration.depends_on_space())
          b = model.acceleration.value(x_p, time);
        maxima[0] = std::max(maxima[0], model.materials[m]->wave_speed(mass[p] / volume[p]) + v_p.norm());
        sums[0] += mass[p];
        sums[1] += 0.5 * mass[p] * v_p.norm_square();
        sums[2] += mass[p] * (b * v_p);
        is_valid = is_valid && is_finite(magnitude(particles, p)) &&
                   is_valid_volume_ratio(determinant(particles.matrix(particles.F, p))) &&
                   is_valid_increment(dt * particles.matrix(particles.grad_v, p).norm());
      }
    maxima[1] = particles.needs_synchronise;
    maxima[2] = !is_valid;
    for (unsigned int d = 0; d < dim; ++d)
      sums[3 + d] = model.grid.lost_momentum[d];
    for (const auto &condition : model.boundary.conditions)
    {
      sums.insert(sums.end(), condition->reaction.begin_raw(), condition->reaction.end_raw());
      sums.push_back(condition->work);
    }
    reduce(maxima, sums, model.grid.communicator);

    result.signal_speed      = maxima[0];
    result.needs_synchronise = maxima[1] > 0;
    result.has_failed        = maxima[2] > 0;
    result.mass              = sums[0];
    result.kinetic_energy    = sums[1];
    result.body_force_power  = sums[2];
    auto next                = sums.begin() + 3;
    for (unsigned int d = 0; d < dim; ++d)
      result.lost_momentum[d] = *next++;
    for (unsigned int c = 0; c < model.boundary.conditions.size(); ++c)
    {
      Tensor<1, dim> reaction;
      for (unsigned int d = 0; d < dim; ++d)
        reaction[d] = *next++;
      result.reactions.push_back(reaction);
      result.works.push_back(*next++);
    }
    return result;
  }

  template <int dim>
  [[noreturn]] void report_failure(Model<dim> &model, const unsigned int step, const double time, const double dt)
  {
    const Particles<dim> &particles = model.particles;
    using Report                    = std::pair<types::particle_index, std::string>;
    Report first(std::numeric_limits<types::particle_index>::max(), "");
    for (unsigned int p = 0; p < particles.size(); ++p)
    {
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
      else if (!is_valid_volume_ratio(J))
        what << "has the volume ratio J = " << J << ", outside (0, 10]";
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
    /** The fastest of all particles, its speed and place. Collective. */
    template <int dim>
    std::string describe_fastest(const Model<dim> &model)
    {
      const Particles<dim>          &particles = model.particles;
      std::pair<double, std::string> fastest(-1., "");
      for (unsigned int p = 0; p < particles.size(); ++p)
      {
        double squares = 0;
        for (unsigned int d = 0; d < dim; ++d)
          squares += std::pow(particles.component(particles.velocity, d)[p], 2);
        if (squares <= fastest.first)
          continue;
        std::ostringstream text;
        text << "particle " << particles.id[p] << " at " << to_text(particles.vector(particles.position, p))
             << " with speed " << std::sqrt(squares);
        fastest = {squares, text.str()};
      }
      for (const auto &other : Utilities::MPI::all_gather(model.grid.communicator, fastest))
        fastest = std::max(fastest, other);
      return fastest.second;
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
    const double available = initial_energy + body_force_work + condition_work;
    if (survey.kinetic_energy > 2 * std::max(available, 0.) + floor)
    {
      std::ostringstream message;
      message << "The kinetic energy " << survey.kinetic_energy << " in step " << step << ", t = " << time
              << ", dt = " << dt << " is more than twice the " << available
              << " that initial state, body force and conditions account for: the run is unstable. Fastest is "
              << describe_fastest(model) << ". Lower the Courant number, or correct the kernels near the boundary.";
      throw RunError(message.str());
    }
  }

#define INSTANTIATE(dim)                                                                                               \
  template Survey<dim> survey(Model<dim> &, const double, const double);                                               \
  template void        report_failure(Model<dim> &, const unsigned int, const double, const double);                   \
  template class EnergyWatch<dim>;
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Talus

#include <talus/core/exceptions.h>
#include <talus/core/tensors.h>
#include <talus/steppers/failure.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <limits>
#include <sstream>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    std::string describe(const Model<dim> &model, const Failure &failure, const double dt)
    {
      const Particles<dim> &particles = model.particles;
      const unsigned int    p         = failure.p;
      std::ostringstream    text;
      switch (failure.limit)
      {
        case Limit::finite:
          text << "has a velocity or stress that is not a finite number";
          break;
        case Limit::volume_ratio:
        {
          unsigned int m = 0;
          while (p >= particles.material_begin[m + 1])
            ++m;
          text << "has the volume ratio J = " << determinant(particles.matrix(particles.F, p)) << ", outside (0, "
               << model.materials[m]->largest_volume_ratio() << "]";
          break;
        }
        case Limit::increment:
          text << "deforms by |grad v| dt = " << dt * particles.matrix(particles.grad_v, p).norm()
               << " in one step, more than " << largest_increment;
          break;
        case Limit::inside:
          text << "left the grid";
          break;
      }
      return text.str();
    }
  } // namespace

  template <int dim>
  [[noreturn]] void report_failure(const Model<dim> &model, const std::vector<Failure> &failures,
                                   const unsigned int step, const double time, const double dt)
  {
    const Particles<dim> &particles = model.particles;
    auto                  all       = failures;
    for (const unsigned int p : particles.outside)
      all.push_back({p, Limit::inside});

    using Report = std::pair<types::particle_index, std::string>;
    Report first(std::numeric_limits<types::particle_index>::max(), "");
    if (!all.empty())
    {
      const Failure     &failure = *std::min_element(all.begin(), all.end(), [&](const Failure &a, const Failure &b) {
        return std::make_pair(particles.id[a.p], a.limit) < std::make_pair(particles.id[b.p], b.limit);
      });
      std::ostringstream text;
      text << describe(model, failure, dt) << ", at " << to_text(particles.vector(particles.position, failure.p))
           << " in step " << step << ", t = " << time << ", dt = " << dt << ". "
           << (failure.limit == Limit::inside ? "Enlarge the grid, or lower the Courant number." :
                                                "Lower the Courant number, or correct the kernels near the boundary.");
      first = {particles.id[failure.p], text.str()};
    }
    for (const auto &other : Utilities::MPI::all_gather(model.grid.communicator, first))
      first = std::min(first, other);
    throw RunError("Particle " + std::to_string(first.first) + " " + first.second);
  }

#define INSTANTIATE(dim)                                                                                               \
  template void report_failure(const Model<dim> &, const std::vector<Failure> &, const unsigned int, const double,     \
                               const double);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Talus

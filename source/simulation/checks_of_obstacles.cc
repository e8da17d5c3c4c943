#include <talus/simulation/checks.h>

namespace Talus
{
  using namespace dealii;
  using internal::sentence;

  template <int dim>
  std::pair<std::uint64_t, std::string> particles_in(const Obstacle<dim> &obstacle, const Model<dim> &model,
                                                     const double time, const double depth)
  {
    const auto                    &particles = model.particles;
    std::uint64_t                  n         = 0;
    std::pair<double, std::string> deepest{depth, ""};
    for (unsigned int p = 0; p < particles.size(); ++p)
    {
      const Point<dim> x(particles.vector(particles.position, p));
      const double     here = obstacle.depth(x, time);
      n += here > depth;
      if (here > deepest.first)
        deepest = {here, sentence("particle ", particles.id[p], " at ", to_text<dim>(x), " by ", here)};
    }
    for (const auto &of_rank : Utilities::MPI::all_gather(model.grid.communicator, deepest))
      deepest = std::max(deepest, of_rank);
    return {Utilities::MPI::sum(n, model.grid.communicator), deepest.second};
  }

  template <int dim>
  void Checks<dim>::check_obstacles()
  {
    for (const auto &obstacle : model.boundary.obstacles)
      if (const auto [n, deepest] = particles_in(*obstacle, model, begin_time, 1e-6 * model.grid.smallest_spacing);
          n > 0)
        throw EntryError(obstacle->get_section_name(), "Surface",
                         sentence(n, " particle(s) lie in the obstacle, the deepest of them, ", deepest,
                                  ". Move the obstacle, or the body."));
  }

#define INSTANTIATE(dim)                                                                                               \
  template std::pair<std::uint64_t, std::string> particles_in(const Obstacle<dim> &, const Model<dim> &, const double, \
                                                              const double);                                           \
  template void                                  Checks<dim>::check_obstacles();
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Talus

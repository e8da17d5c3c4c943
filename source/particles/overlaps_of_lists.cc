#include <talus/particles/overlaps.h>

#include <algorithm>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    /**
     * Lists of points that fill the same space: the volumes of all lists, spread to the nodes as quadratic splines do,
     * exceed those of the cells. Of equal points that fill a cell it is exactly one.
     */
    template <int dim>
    class Filling
    {
    public:
      Filling(const Particles<dim> &particles, const std::vector<bool> &is_list, const BoxGrid<dim> &grid) : grid(grid)
      {
        nodes.reinit(grid.nodes);
        for (unsigned int p = 0; p < particles.size(); ++p)
          if (is_list[particles.body[p]])
            spread(particles.vector(particles.position, p), particles.component(particles.volume, 0)[p],
                   particles.body[p]);
        nodes.add_copies_to_owners();
      }

      /** The owned node with most that has points of several bodies, and how often it is filled. */
      std::pair<double, Tensor<1, dim>> fullest() const
      {
        std::pair<double, Tensor<1, dim>> result;
        double                            cell = 1;
        for (const double h : grid.spacing)
          cell *= h;
        for (unsigned int i = 0; i < nodes.n_owned(); ++i)
        {
          const double V = nodes[i][0], mean = nodes[i][1] / V, square = nodes[i][2] / V;
          if (square - mean * mean > 0.05 && V / cell > result.first)
            result = {V / cell, grid.node_position(i)};
        }
        return result;
      }

    private:
      void spread(const Tensor<1, dim> &x, const double volume, const unsigned int body)
      {
        grid.for_each_around(x, [&](const unsigned int node, const double weight) {
          const double w = volume * weight;
          nodes[node][0] += w;
          nodes[node][1] += w * body;
          nodes[node][2] += w * body * body;
        });
      }

      const BoxGrid<dim> &grid;
      NodalArray<4>       nodes; // volume, times body, times its square
    };

    /** Names of the lists that have points within a spacing and a half of x. */
    template <int dim>
    std::vector<unsigned int> lists_around(const Particles<dim> &particles, const std::vector<bool> &is_list,
                                           const Tensor<1, dim> &x, const Grid<dim> &grid)
    {
      std::vector<unsigned int> has_points(is_list.size(), 0);
      for (unsigned int p = 0; p < particles.size(); ++p)
        if ((particles.vector(particles.position, p) - x).norm() < 1.5 * grid.largest_spacing)
          has_points[particles.body[p]] = is_list[particles.body[p]];
      Utilities::MPI::max(has_points, grid.communicator, has_points);
      std::vector<unsigned int> bodies;
      for (unsigned int b = 0; b < has_points.size(); ++b)
        if (has_points[b] > 0)
          bodies.push_back(b);
      return bodies;
    }
  } // namespace

  template <int dim>
  void Overlaps<dim>::check_lists(const Particles<dim>                          &particles,
                                  const std::vector<std::unique_ptr<Body<dim>>> &bodies, const Grid<dim> &grid)
  {
    std::vector<bool> is_list;
    for (const auto &body : bodies)
      is_list.push_back(body->shape->is_list());
    // Sums at nodes of a box tell how full it is.
    const auto box = dynamic_cast<const BoxGrid<dim> *>(&grid);
    if (box == nullptr || std::count(is_list.begin(), is_list.end(), true) < 2)
      return;
    // A row of particles that two lists share fills nodes 1.4-fold, jitter and meshes 1.1-fold.
    constexpr double most    = 1.3;
    auto             fullest = Filling<dim>(particles, is_list, *box).fullest();
    for (const auto &other : Utilities::MPI::all_gather(grid.communicator, fullest))
      if (other.first > fullest.first)
        fullest = other;
    if (fullest.first <= most)
      return;
    const auto around = lists_around(particles, is_list, fullest.second, grid);
    if (around.size() > 1)
      refuse(*bodies[around[1]], "the bodies '" + bodies[around[0]]->name + "' and '" + bodies[around[1]]->name +
                                   "' overlap: their points fill the space around " + to_text(fullest.second) + " " +
                                   std::to_string(fullest.first) + "-fold.");
  }

  template void Overlaps<2>::check_lists(const Particles<2> &, const std::vector<std::unique_ptr<Body<2>>> &,
                                         const Grid<2> &);
  template void Overlaps<3>::check_lists(const Particles<3> &, const std::vector<std::unique_ptr<Body<3>>> &,
                                         const Grid<3> &);
} // namespace Talus

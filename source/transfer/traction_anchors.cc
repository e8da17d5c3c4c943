#include <talus/core/exceptions.h>
#include <talus/transfer/tractions.h>

#include <deal.II/numerics/rtree.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    /** A particle near a point: squared distance, id, position. */
    template <int dim>
    using Candidate = std::array<double, 2 + dim>;

    /** The particle of a body next to each point; of equally near ones that of lowest id, on any number of ranks. */
    template <int dim>
    std::vector<Candidate<dim>> nearest_particles(const std::vector<Point<dim>> &points,
                                                  const Particles<dim> &particles, const unsigned int body,
                                                  MPI_Comm communicator)
    {
      namespace bgi = boost::geometry::index;
      using Entry   = std::pair<Point<dim>, unsigned int>;
      std::vector<Entry> entries;
      for (unsigned int p = 0; p < particles.size(); ++p)
        if (particles.body[p] == body)
          entries.emplace_back(Point<dim>(particles.vector(particles.position, p)), p);
      const auto tree = pack_rtree(entries);

      std::vector<Candidate<dim>> best(points.size());
      for (unsigned int k = 0; k < points.size(); ++k)
      {
        best[k].fill(std::numeric_limits<double>::max());
        for (const Entry &entry : tree | bgi::adaptors::queried(bgi::nearest(points[k], 1u << (dim + 1))))
        {
          Candidate<dim> candidate;
          candidate[0] = (entry.first - points[k]).norm_square();
          candidate[1] = particles.id[entry.second];
          for (unsigned int d = 0; d < dim; ++d)
            candidate[2 + d] = entry.first[d];
          best[k] = std::min(best[k], candidate);
        }
      }
      for (const auto &others : Utilities::MPI::all_gather(communicator, best))
        for (unsigned int k = 0; k < points.size(); ++k)
          best[k] = std::min(best[k], others[k]);
      return best;
    }
  } // namespace

  template <int dim>
  void Traction<dim>::find_anchors(const Surface<dim> &surface, const Grid<dim> &grid, const unsigned int body,
                                   const Particles<dim> &particles)
  {
    std::vector<dealii::Point<dim>> middles;
    anchors.clear();
    for (const auto &point : surface)
      for (unsigned int k = 0; k < n_layers; ++k)
      {
        Anchor             anchor{0, point.x, Tensor<1, dim>(), point.area};
        dealii::Point<dim> middle = point.x;
        if (kind != "force")
        {
          const Tensor<1, dim> N   = point.area / point.area.norm();
          double               sum = 0;
          for (unsigned int d = 0; d < dim; ++d)
            sum += std::pow(N[d] * points_per_cell * grid.inverse_spacing[d], 2);
          const double thickness = 1 / std::sqrt(sum);
          anchor.arm             = thickness * (1 - (k + 0.5) / n_layers) * N;
          middle -= (k + 0.5) * thickness * N;
        }
        anchors.push_back(anchor);
        middles.push_back(middle);
      }

    const auto best = nearest_particles(middles, particles, body, grid.communicator);
    for (unsigned int a = 0; a < anchors.size(); ++a)
    {
      dealii::Point<dim> host;
      for (unsigned int d = 0; d < dim; ++d)
        host[d] = best[a][2 + d];
      anchors[a].host = static_cast<types::particle_index>(best[a][1]);
      anchors[a].offset -= host;
      anchors[a].arm += (middles[a] - host) / n_layers;
    }
    if (kind == "force" && best[0][0] > grid.diagonal_square())
      throw EntryError(get_section_name(), "Position",
                       "no particle of '" + body_name +
                         "' lies within a cell's diagonal of this point. Move it to the body.");
    std::stable_sort(anchors.begin(), anchors.end(), [](const Anchor &a, const Anchor &b) { return a.host < b.host; });
  }

  template <int dim>
  void Traction<dim>::find_local_hosts(const Particles<dim> &particles)
  {
    hosts.clear();
    for (unsigned int p = 0; p < particles.size(); ++p)
    {
      const auto begin = std::lower_bound(anchors.begin(), anchors.end(), particles.id[p],
                                          [](const Anchor &anchor, const auto id) { return anchor.host < id; });
      auto       end   = begin;
      while (end != anchors.end() && end->host == particles.id[p])
        ++end;
      if (begin == end)
        continue;
      Host host;
      host.p     = p;
      host.begin = begin - anchors.begin();
      host.end   = end - anchors.begin();
      hosts.push_back(host);
    }
    arrangement = particles.arrangement;
  }

#define INSTANTIATE(dim)                                                                                               \
  template void Traction<dim>::find_anchors(const Surface<dim> &, const Grid<dim> &, const unsigned int,               \
                                            const Particles<dim> &);                                                   \
  template void Traction<dim>::find_local_hosts(const Particles<dim> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Talus

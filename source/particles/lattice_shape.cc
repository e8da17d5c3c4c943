#include <talus/particles/lattice_shape.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cstdint>
#include <limits>

namespace Talus
{
  using namespace dealii;

  double hashed_jitter(const unsigned int seed, const std::uint64_t index, const unsigned int axis)
  {
    // Two rounds of the finaliser of SplitMix64 over the packed arguments.
    const auto mix = [](std::uint64_t z) {
      z += 0x9e3779b97f4a7c15ull;
      z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
      z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
      return z ^ (z >> 31);
    };
    const std::uint64_t hash = mix(mix((std::uint64_t(seed) << 34) ^ (std::uint64_t(axis) << 32)) ^ index);
    return static_cast<double>(hash >> 11) * 0x1p-52 - 1.;
  }

  namespace
  {
    // Ids travel between ranks, and into tables, as doubles: whole numbers are exact to here.
    constexpr double largest_number = 0x1p53;
  } // namespace

  template <int dim>
  LatticeShape<dim>::LatticeShape(std::unique_ptr<FilledRegion<dim>> filled) :
    Shape<dim>(filled->get_section_name()), region(std::move(filled))
  {
    this->add_parameter("Particles per cell and direction", points_per_cell,
                        "A cell receives this number to the power of the dimension.", this->prm,
                        Patterns::Integer(1, 16));
    this->add_parameter(
      "Lattice offset", offset,
      "Shift of the particle lattice in units of the particle distance, one number per direction [1].", this->prm,
      Patterns::List(Patterns::Double(-1, 1), dim, dim));
    this->add_parameter(
      "Jitter", jitter,
      "Greatest random shift of a particle along each axis in units of half the particle distance [1].", this->prm,
      Patterns::Double(0, 1));
    this->add_parameter("Seed", seed, "Seed of the jitter.", this->prm, Patterns::Integer(0));
    this->add_parameter("Edge volumes", edge_volumes,
                        "Volumes of particles at a surface that the lattice does not fit: 'sampled', that of the shape "
                        "around them; 'whole', that of their box in the lattice.",
                        this->prm, Patterns::Selection("sampled|whole"));
  }

  template <int dim>
  void LatticeShape<dim>::create(const std::array<double, dim> &h)
  {
    region->prepare();
    const auto corners = bounding_box().get_boundary_points();
    double     n       = 1;
    for (unsigned int d = 0; d < dim; ++d)
    {
      const double length = corners.second[d] - corners.first[d];
      if (!(length > 0))
        throw EntryError(this->get_section_name(), "Shape",
                         "the body is empty: it has no extent in direction " + std::string(1, "xyz"[d]) + ".");
      // Equal boxes that fill the length exactly, as near to h/n as possible.
      const double count = std::max(1., std::round(length * points_per_cell / h[d]));
      n *= count;
      if (!(count < std::numeric_limits<int>::max() && n < largest_number))
        throw EntryError(this->get_section_name(), "Particles per cell and direction",
                         "the body's lattice has more points than can be numbered, 2^31 along an axis and 2^53 in all. "
                         "Take fewer, a larger spacing or a smaller body.");
      counts[d]  = static_cast<int>(count);
      spacing[d] = length / counts[d];
      lower[d]   = corners.first[d] + offset[d] * spacing[d];
      // About a hundred samples across the shape, and an even number in a box: none in its middle.
      constexpr double across = dim == 2 ? 96 : 48;
      n_samples[d] = is_curved(d) ? 2 * static_cast<int>(std::clamp(across / (2 * count), dim == 2 ? 4. : 2., 8.)) : 1;
      if (is_curved(d) && offset[d] != 0)
      {
        ++counts[d];
        lower[d] -= offset[d] > 0 ? spacing[d] : 0;
      }
    }
    shares.clear();
  }

  template <int dim>
  std::uint64_t LatticeShape<dim>::n_indices() const
  {
    std::uint64_t n = 1;
    for (const int count : counts)
      n *= count;
    return n;
  }

  template <int dim>
  std::array<Tensor<1, dim>, dim> LatticeShape<dim>::half_edges(const Point<dim> &, const double volume) const
  {
    double box = 1;
    for (const double length : spacing)
      box *= length;
    const double                    scale = volume == box ? 1 : std::pow(volume / box, 1. / dim);
    std::array<Tensor<1, dim>, dim> edges;
    for (unsigned int d = 0; d < dim; ++d)
      edges[d][d] = 0.5 * scale * spacing[d];
    return edges;
  }

  template <int dim>
  bool LatticeShape<dim>::covers(const Point<dim> &x) const
  {
    // What round-off brings across a face from a neighbour's side is not inside.
    constexpr double margin = 1e-6;
    for (unsigned int d = 0; d < dim; ++d)
    {
      const double c = (x[d] - lower[d]) / spacing[d];
      if (!(c > margin && c < counts[d] - margin))
        return false;
    }
    return contains(x);
  }

  template <int dim>
  void LatticeShape<dim>::visit(const BoundingBox<dim> &box, const typename Shape<dim>::Visitor &visitor) const
  {
    const auto corners = box.get_boundary_points();
    Index      begin, end;
    for (unsigned int d = 0; d < dim; ++d)
    {
      // A point strays from the middle of its box by the jitter, and by round-off.
      const double stray = 0.5 * jitter + 1e-6;
      const double first = (corners.first[d] - lower[d]) / spacing[d] - 0.5 - stray;
      const double last  = (corners.second[d] - lower[d]) / spacing[d] - 0.5 + stray;
      begin[d]           = std::clamp<double>(std::ceil(first), 0, counts[d]);
      end[d]             = std::clamp<double>(std::floor(last) + 1, 0, counts[d]);
    }
    visit_range(begin, end, visitor);
  }

  template <int dim>
  void LatticeShape<dim>::visit_part(const unsigned int part, const unsigned int n_parts,
                                     const typename Shape<dim>::Visitor &visitor) const
  {
    Index begin = {}, end = counts;
    begin[dim - 1] = this->part_begin(counts[dim - 1], part, n_parts);
    end[dim - 1]   = this->part_begin(counts[dim - 1], part + 1, n_parts);
    visit_range(begin, end, visitor);
  }

  template <int dim>
  void LatticeShape<dim>::visit_range(const Index &begin, const Index &end,
                                      const typename Shape<dim>::Visitor &visitor) const
  {
    for (unsigned int d = 0; d < dim; ++d)
      if (begin[d] >= end[d])
        return;
    double volume = 1;
    for (unsigned int d = 0; d < dim; ++d)
      volume *= spacing[d];
    bool are_whole = true;
    for (unsigned int d = 0; d < dim; ++d)
      are_whole = are_whole && !is_curved(d);
    are_whole = are_whole || edge_volumes == "whole";

    for (auto k = begin; k[dim - 1] < end[dim - 1];)
    {
      std::uint64_t index = 0;
      Point<dim>    x;
      for (int d = dim - 1; d >= 0; --d)
      {
        index = index * counts[d] + k[d];
        x[d]  = lower[d] + (k[d] + 0.5) * spacing[d];
      }
      if (contains(x))
      {
        const double share = are_whole ? 1 : share_of_shape(k);
        if (jitter > 0)
          for (unsigned int d = 0; d < dim; ++d)
            x[d] += 0.5 * spacing[d] * jitter * hashed_jitter(seed, index, d);
        visitor(index, x, share * volume);
      }
      ++k[0];
      for (unsigned int d = 0; d + 1 < dim && k[d] == end[d]; ++d)
      {
        k[d] = begin[d];
        ++k[d + 1];
      }
    }
  }

  template <int dim>
  Point<dim> LatticeShape<dim>::position(const Index &k) const
  {
    Point<dim> x;
    for (unsigned int d = 0; d < dim; ++d)
      x[d] = lower[d] + (k[d] + 0.5) * spacing[d];
    return x;
  }

  template class LatticeShape<2>;
  template class LatticeShape<3>;
} // namespace Talus

#pragma once

#include <deal.II/base/point.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace Talus
{
  /** A set of faces of a box: bit 2 d is the lower, 2 d + 1 the upper one of axis d. */
  using BoxFaces = unsigned char;

  /** Calls `body(index)` for the n^dim lattice indices from `first` on, x running fastest. */
  template <std::size_t dim, class Body>
  void for_each_index(const std::array<int, dim> &first, const int n, const Body &body)
  {
    int size = 1;
    for (unsigned int d = 0; d < dim; ++d)
      size *= n;
    for (int k = 0; k < size; ++k)
    {
      std::array<int, dim> index = first;
      for (unsigned int d = 0, rest = k; d < dim; ++d, rest /= n)
        index[d] += rest % n;
      body(index);
    }
  }

  /**
   * The box grid as a regular lattice: where a point lies by arithmetic instead
   * of a search, and which local node sits at a lattice index.
   *
   * Node (I, J, K) is at origin + (I h_x, J h_y, K h_z), cell (I, J, K) spans
   * nodes I and I+1 of each axis. The tables cover the bounding box of what this
   * rank knows, padded so that the stencil of every particle in the domain can
   * be looked up without a bounds check; what is not there is `missing`.
   */
  template <int dim>
  struct Lattice
  {
    using Index = std::array<int, dim>;
    using Faces = BoxFaces;

    static constexpr unsigned int missing = static_cast<unsigned int>(-1);

    std::array<double, dim> origin, h, inverse_h;
    Index                   n_cells;
    int                     padding = 3; // entries around what this rank has of deal.II

    // The tables' box: its first lattice index, its extent, and the step from one entry to the next.
    Index first, extent, stride;

    std::vector<unsigned int> node;  // local index of the node at a lattice index
    std::vector<unsigned int> owner; // rank of the cell there, if this rank knows it

    std::vector<Faces> slip_faces;   // faces that a stencil reaches which begins there, if all its nodes on them slip
    std::vector<Faces> beyond;       // faces beyond which the index lies
    std::vector<unsigned int> image; // where there are any: the place of its mirror image in them, if a node is there

    /** Lattice coordinate of `x` along axis `d`: integer at nodes. */
    double coordinate(const double x, const unsigned int d) const { return (x - origin[d]) * inverse_h[d]; }

    double node_position(const int index, const unsigned int d) const { return origin[d] + index * h[d]; }

    /**
     * True where the lattice coordinate along `d` lies in the domain. The upper face belongs to it: enter() puts what
     * is on it into the last cell.
     */
    bool is_inside(const double coordinate, const unsigned int d) const
    {
      return coordinate >= 0 && coordinate <= n_cells[d];
    }

    /** Whether x lies in an interval that a user wrote: its ends have a tolerance of 1e-6 spacings. */
    bool is_between(const double x, const double lower, const double upper, const unsigned int d) const
    {
      const double tolerance = std::max(1e-6 * h[d], face_tolerance(d));
      return x >= lower - tolerance && x <= upper + tolerance;
    }

    /** How far beyond a face a position is still on it, by round-off: 1e-9 spacings, or the last 3 bits of it [length].
     */
    double face_tolerance(const unsigned int d) const
    {
      const double largest = std::max(std::abs(origin[d]), std::abs(node_position(n_cells[d], d)));
      return std::max(1e-9 * h[d], 8 * std::numeric_limits<double>::epsilon() * largest);
    }

    /** The largest position in the last cell: the upper face, but for one or two of its last bits [length]. */
    double upper_end(const unsigned int d) const
    {
      double x = node_position(n_cells[d], d);
      while (!(coordinate(x, d) < n_cells[d]))
        x = std::nextafter(x, origin[d]);
      return x;
    }

    /**
     * Puts x on the faces of the domain from which round-off has taken it: what lies beyond one, or on the upper one of
     * an axis, becomes the end of the axis' first or last cell. False where x lies farther out.
     */
    bool enter(dealii::Tensor<1, dim> &x) const
    {
      for (unsigned int d = 0; d < dim; ++d)
      {
        const double c = coordinate(x[d], d);
        if (c >= 0 && c < n_cells[d])
          continue;
        const double face = c < 0 ? origin[d] : node_position(n_cells[d], d);
        if (!(std::abs(x[d] - face) <= face_tolerance(d)))
          return false;
        x[d] = c < 0 ? origin[d] : upper_end(d);
      }
      return true;
    }

    /**
     * The share of a particle at `x` that lies in the domain, for a body that the domain's faces cut: half of it where
     * it sits on a face, a quarter on two; 0 outside. Moves x as enter() does.
     */
    double share_inside(dealii::Point<dim> &x) const
    {
      double share = 1;
      for (unsigned int d = 0; d < dim; ++d)
        for (const double face : {origin[d], node_position(n_cells[d], d)})
          if (std::abs(x[d] - face) <= face_tolerance(d))
            share *= 0.5;
      return enter(x) ? share : 0;
    }

    /** The cell that contains x, whether or not it exists. On a face between two it is the upper one; see enter(). */
    Index cell_index(const dealii::Point<dim> &x) const
    {
      Index index;
      for (unsigned int d = 0; d < dim; ++d)
        index[d] = static_cast<int>(std::floor(coordinate(x[d], d)));
      return index;
    }

    /** x, moved off the faces of its cell, on which deal.II may lose a particle. */
    dealii::Point<dim> inside_cell(const dealii::Point<dim> &x) const
    {
      constexpr double   margin = 1e-6;
      dealii::Point<dim> inside;
      const Index        cell = cell_index(x);
      for (unsigned int d = 0; d < dim; ++d)
      {
        const double local = coordinate(x[d], d) - cell[d];
        inside[d]          = origin[d] + h[d] * (cell[d] + std::min(std::max(local, margin), 1 - margin));
      }
      return inside;
    }

    bool is_in_table(const Index &index) const
    {
      for (unsigned int d = 0; d < dim; ++d)
        if (index[d] < first[d] || index[d] >= first[d] + extent[d])
          return false;
      return true;
    }

    /** Position of a lattice index in the tables. */
    int table_index(const Index &index) const
    {
      int position = 0;
      for (unsigned int d = 0; d < dim; ++d)
        position += (index[d] - first[d]) * stride[d];
      return position;
    }

    double smallest_spacing() const
    {
      double smallest = h[0];
      for (const double spacing : h)
        smallest = std::min(smallest, spacing);
      return smallest;
    }

    double largest_spacing() const
    {
      double largest = h[0];
      for (const double spacing : h)
        largest = std::max(largest, spacing);
      return largest;
    }

    /** Square of the length of a cell's diagonal. */
    double diagonal_square() const
    {
      double sum = 0;
      for (const double spacing : h)
        sum += spacing * spacing;
      return sum;
    }

    /**
     * Sets the box of the tables to [lower, upper] plus padding and clears them. Throws InputError where a place would
     * not fit into 31 bits.
     */
    void resize_tables(const Index &lower, const Index &upper);

    /** Sets the mirror images of what lies beyond the box. */
    void find_images();

    /** Sets `slip_faces` of stencils of n nodes per axis, from the faces on which each local node slips. */
    void find_slip_faces(const std::vector<Faces> &of_nodes, const int n);

    /** The node at a lattice index, or `missing`; any index. */
    unsigned int node_at(const Index &index) const;

    /** The lattice index of an entry of the tables. */
    Index table_entry(const int entry) const
    {
      Index index;
      for (unsigned int d = 0; d < dim; ++d)
        index[d] = first[d] + entry / stride[d] % extent[d];
      return index;
    }

    /**
     * For each lattice index b of the tables: whether all nodes of the domain in
     * [b, b + n - 1] of every axis are known to this rank, so that a particle with
     * this stencil can be kept here.
     */
    std::vector<char> coverage(const int n) const;
  };
} // namespace Talus
